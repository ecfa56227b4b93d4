#include "tessera/output/huffman_code.hpp"

#include <algorithm>
#include <array>

namespace tessera {

namespace {

constexpr int longest_of_all = 15;

/// Symbols that occur, the rarest first.
std::vector<std::uint16_t> by_count(std::span<const std::uint32_t> counts) {
  std::vector<std::uint32_t> keys;  // count and symbol in one number: sorts fast, and equal counts in order
  for (std::size_t s = 0; s < counts.size(); ++s)
    if (counts[s] > 0) keys.push_back(counts[s] << 9U | static_cast<std::uint32_t>(s));
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint16_t> symbols;
  for (const std::uint32_t key : keys) symbols.push_back(static_cast<std::uint16_t>(key & 511U));
  return symbols;
}

/// Depths of the leaves, the rarest first, in the tree that joins the two rarest nodes again and again. Joined nodes
/// come out in the order of their counts, so two queues do.
std::vector<int> depths(std::span<const std::uint32_t> counts, std::span<const std::uint16_t> leaves) {
  const std::size_t n = leaves.size();
  std::vector<std::uint64_t> joined;           // counts of inner nodes
  std::vector<std::size_t> parent(2 * n - 1);  // leaves first, then inner nodes
  std::size_t leaf = 0, inner = 0;
  const auto rarest = [&](std::uint64_t& count) {
    const bool take_leaf = leaf < n && (inner == joined.size() || counts[leaves[leaf]] <= joined[inner]);
    count += take_leaf ? counts[leaves[leaf]] : joined[inner];
    return take_leaf ? leaf++ : n + inner++;
  };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    std::uint64_t count = 0;
    for (int child = 0; child < 2; ++child) parent[rarest(count)] = n + i;
    joined.push_back(count);
  }
  std::vector<int> depth(2 * n - 1, 0);
  for (std::size_t i = 2 * n - 2; i-- > 0;) depth[i] = depth[parent[i]] + 1;
  depth.resize(n);
  return depth;
}

/// The lengths of all symbols; flattens the counts until no code is too long.
std::vector<std::uint8_t> lengths_of(std::vector<std::uint32_t> counts, int longest) {
  for (;;) {
    const std::vector<std::uint16_t> leaves = by_count(counts);
    const std::vector<int> depth = depths(counts, leaves);
    std::vector<std::uint8_t> lengths(counts.size(), 0);
    for (std::size_t i = 0; i < leaves.size(); ++i) lengths[leaves[i]] = static_cast<std::uint8_t>(depth[i]);
    if (*std::max_element(depth.begin(), depth.end()) <= longest) return lengths;
    for (std::uint32_t& count : counts) count = (count + 1) / 2;
  }
}

std::uint16_t reversed(std::uint32_t bits, int count) {
  std::uint32_t result = 0;
  for (int i = 0; i < count; ++i) result |= (bits >> i & 1U) << (count - 1 - i);
  return static_cast<std::uint16_t>(result);
}

}  // namespace

HuffmanCode huffman_code(std::span<const std::uint32_t> counts, int longest) {
  HuffmanCode code{std::vector<std::uint16_t>(counts.size(), 0), lengths_of({counts.begin(), counts.end()}, longest)};
  std::array<std::uint32_t, longest_of_all + 2> next{};
  for (const std::uint8_t length : code.lengths)
    if (length > 0) ++next[length + 1U];
  for (std::size_t length = 1; length < next.size(); ++length) next[length] = (next[length - 1] + next[length]) << 1U;
  for (std::size_t s = 0; s < counts.size(); ++s)
    if (const int length = code.lengths[s]; length > 0)
      code.bits[s] = reversed(next[static_cast<std::size_t>(length)]++, length);
  return code;
}

}  // namespace tessera
