#include "tessera/output/deflate_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera {

namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::size_t literals = 256, end_of_block = 256, first_length = 257, symbols = 286;
constexpr int longest_code = 15, longest_length_code = 7;
constexpr std::size_t shortest_run = 3, longest_run = 258;
constexpr std::size_t few = 1024;  // a table of codes would hardly pay
constexpr double noise = 7.5;      // bits a byte above which codes would save less than a sixteenth

/// RFC 1951, 3.2.5: lengths of runs from which the codes 257, 258 .. count on, and the bits that tell how far.
constexpr std::array<std::uint16_t, 29> run_base = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                                    31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<std::uint8_t, 29> run_bits = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                   2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
/// RFC 1951, 3.2.7: the order in which the lengths of the code for code lengths come.
constexpr std::array<std::uint8_t, 19> length_order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                       11, 4,  12, 3, 13, 2, 14, 1, 15};

std::size_t code_of_run(std::size_t length) {
  return static_cast<std::size_t>(std::upper_bound(run_base.begin(), run_base.end(), length) - run_base.begin()) - 1;
}

/// A byte and how many more of it follow.
struct Run {
  unsigned char byte;
  std::uint16_t repeated;  // 0, or shortest_run .. longest_run
};

std::vector<Run> runs_of(Bytes bytes) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t end = i + 1;
    while (end < bytes.size() && end - i <= longest_run && bytes[end] == bytes[i]) ++end;
    if (end - i <= shortest_run) end = i + 1;
    runs.push_back({bytes[i], static_cast<std::uint16_t>(end - i - 1)});
    i = end;
  }
  return runs;
}

using Counts = std::array<std::uint32_t, symbols>;

/// How often each byte occurs. Four tables, because increments of one entry would wait for each other.
Counts counts_of(Bytes bytes) {
  std::array<std::array<std::uint32_t, literals>, 4> part{};
  std::size_t i = 0;
  for (; i + 4 <= bytes.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) ++part[k][bytes[i + k]];
  for (; i < bytes.size(); ++i) ++part[0][bytes[i]];
  Counts counts{};
  for (std::size_t s = 0; s < literals; ++s) counts[s] = part[0][s] + part[1][s] + part[2][s] + part[3][s];
  counts[end_of_block] = 1;
  return counts;
}

Counts counts_of(std::span<const Run> runs) {
  Counts counts{};
  for (const Run& run : runs) {
    ++counts[run.byte];
    if (run.repeated > 0) ++counts[first_length + code_of_run(run.repeated)];
  }
  counts[end_of_block] = 1;
  return counts;
}

/// Of the bytes' distribution, from some of them [bits].
double entropy(Bytes bytes) {
  constexpr std::size_t stride = 8;
  std::array<std::uint32_t, literals> counts{};
  for (std::size_t i = 0; i < bytes.size(); i += stride) ++counts[bytes[i]];
  const double all = static_cast<double>((bytes.size() + stride - 1) / stride);
  double sum = 0.0;
  for (const std::uint32_t count : counts)
    if (count > 0) sum -= count / all * std::log2(count / all);
  return sum;
}

/// The lengths of a block's codes in the alphabet that tells them: a length, or 18 or 17 for many or few absent
/// symbols.
struct Lengths {
  std::vector<std::uint8_t> symbol, absent;  // absent: how many, beyond the least
};

Lengths packed(std::span<const std::uint8_t> lengths) {
  Lengths result;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t end = i;
    while (end < lengths.size() && end - i < 138 && lengths[end] == 0) ++end;
    const std::size_t zeros = end - i;
    result.symbol.push_back(zeros >= 11 ? 18 : zeros >= 3 ? 17 : lengths[i]);
    result.absent.push_back(static_cast<std::uint8_t>(zeros >= 11 ? zeros - 11 : zeros >= 3 ? zeros - 3 : 0));
    i = zeros >= 3 ? end : i + 1;
  }
  return result;
}

/// RFC 1951, 3.2.7: the head of a block with codes of its own. There is one distance, 1, for runs.
void put_head(BitWriter& out, const HuffmanCode& code) {
  std::vector<std::uint8_t> lengths = code.lengths;
  lengths.push_back(1);
  const Lengths all = packed(lengths);
  std::array<std::uint32_t, length_order.size()> counts{};
  for (const std::uint8_t symbol : all.symbol) ++counts[symbol];
  const HuffmanCode lengths_code = huffman_code(counts, longest_length_code);
  out.put(0, 1);  // not the last block
  out.put(2, 2);  // codes of its own
  out.put(symbols - first_length, 5);
  out.put(0, 5);  // one distance
  out.put(length_order.size() - 4, 4);
  for (const std::uint8_t symbol : length_order) out.put(lengths_code.lengths[symbol], 3);
  for (std::size_t i = 0; i < all.symbol.size(); ++i) {
    lengths_code.put(out, all.symbol[i]);
    if (all.symbol[i] == 18) out.put(all.absent[i], 7);
    if (all.symbol[i] == 17) out.put(all.absent[i], 3);
  }
}

std::size_t coded_size(const Counts& counts, const HuffmanCode& code) {
  std::size_t bits = 0;
  for (std::size_t s = 0; s < symbols; ++s) bits += std::size_t{counts[s]} * code.lengths[s];
  return bits / 8;
}

void put_coded(BitWriter& out, Bytes bytes, const HuffmanCode& code) {
  put_head(out, code);
  struct Entry {
    std::uint32_t bits, length;
  };
  std::array<Entry, literals> table{};  // what is needed of a byte in one place
  for (std::size_t s = 0; s < literals; ++s) table[s] = {code.bits[s], code.lengths[s]};
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3) {
    const Entry a = table[bytes[i]], b = table[bytes[i + 1]], c = table[bytes[i + 2]];
    const std::uint64_t bits =
        a.bits | std::uint64_t{b.bits} << a.length | std::uint64_t{c.bits} << (a.length + b.length);
    out.put(bits, a.length + b.length + c.length);
  }
  for (; i < bytes.size(); ++i) code.put(out, bytes[i]);
  code.put(out, end_of_block);
}

void put_runs(BitWriter& out, Bytes bytes) {
  const std::vector<Run> runs = runs_of(bytes);
  const HuffmanCode code = huffman_code(counts_of(runs), longest_code);
  put_head(out, code);
  for (const Run& run : runs) {
    code.put(out, run.byte);
    if (run.repeated == 0) continue;
    const std::size_t k = code_of_run(run.repeated);
    code.put(out, first_length + k);
    out.put(run.repeated - std::uint64_t{run_base[k]}, run_bits[k]);
    out.put(0, 1);  // the one distance
  }
  code.put(out, end_of_block);
}

void put_stored(BitWriter& out, Bytes bytes) {
  constexpr std::size_t most = 65535;
  for (std::size_t begin = 0; begin < bytes.size(); begin += most) {
    const Bytes block = bytes.subspan(begin, std::min(most, bytes.size() - begin));
    out.put(0, 3);  // not the last block, stored
    out.align();
    out.put(block.size() | (~block.size() & most) << 16U, 32);
    out.copy(block);
  }
}

}  // namespace

void put_block(BitWriter& out, std::span<const unsigned char> bytes) {
  if (bytes.size() < few || entropy(bytes) > noise) return put_stored(out, bytes);
  const Counts counts = counts_of(bytes);
  if (*std::max_element(counts.begin(), counts.end()) > bytes.size() / 2) return put_runs(out, bytes);
  const HuffmanCode code = huffman_code(counts, longest_code);
  if (coded_size(counts, code) >= bytes.size()) return put_stored(out, bytes);
  put_coded(out, bytes, code);
}

void put_last_block(BitWriter& out) {
  constexpr std::uint64_t empty = 0xffff0000U;
  out.put(1, 3);  // the last block, stored
  out.align();
  out.put(empty, 32);
}

}  // namespace tessera
