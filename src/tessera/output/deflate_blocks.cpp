#include "tessera/output/deflate_blocks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "tessera/base/kernel.hpp"

namespace tessera {

namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::size_t literals = 256, end_of_block = 256, first_length = 257, symbols = 286;
constexpr int longest_code = 14;  // four of them fit into what BitWriter takes at once
constexpr int longest_length_code = 7;
constexpr std::size_t shortest_run = 3, longest_run = 258;
constexpr std::size_t few = 1024;  // a table of codes would hardly pay

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

/// Where the run that begins at `begin` ends.
std::size_t end_of_run(Bytes bytes, std::size_t begin) {
  const std::uint64_t repeated = 0x0101010101010101U * bytes[begin];
  const std::size_t most = std::min(bytes.size(), begin + 1 + longest_run);
  std::size_t end = begin + 1;
  for (; end + sizeof repeated <= most; end += sizeof repeated) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + end, sizeof word);
    if (word != repeated) return end + static_cast<std::size_t>(std::countr_zero(word ^ repeated)) / 8;
  }
  while (end < most && bytes[end] == bytes[begin]) ++end;
  return end;
}

std::vector<Run> runs_of(Bytes bytes) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t end = end_of_run(bytes, i);
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

/// Codes would hardly save more than an eighth: pairs among some of the bytes are equal less than twice as often as
/// they were if all values were equally likely.
bool is_noise(Bytes bytes) {
  constexpr std::size_t stride = 31;  // no multiple of the number of components, which take turns
  std::array<std::uint32_t, literals> counts{};
  for (std::size_t i = 0; i < bytes.size(); i += stride) ++counts[bytes[i]];
  const std::uint64_t samples = (bytes.size() + stride - 1) / stride;
  std::uint64_t equal = 0;
  for (const std::uint32_t count : counts) equal += std::uint64_t{count} * count;
  return literals * (equal - samples) < 2 * samples * (samples - 1);
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

/// A byte's code, and in the higher half its length.
using CodeTable = std::array<std::uint32_t, literals>;

CodeTable table_of(const HuffmanCode& code) {
  CodeTable table{};
  for (std::size_t s = 0; s < literals; ++s) table[s] = code.bits[s] | std::uint32_t{code.lengths[s]} << 16U;
  return table;
}

/// Appends the codes of whole groups of four bytes; returns how many bytes that are.
TESSERA_KERNEL std::size_t put_fours(BitWriter& out, Bytes bytes, const CodeTable& table) {
  BitWriter writer = out;  // its state stays in registers: out's might be what it writes
  std::size_t i = 0;
  for (; i + 4 <= bytes.size(); i += 4) {
    const std::uint32_t a = table[bytes[i]], b = table[bytes[i + 1]], c = table[bytes[i + 2]], d = table[bytes[i + 3]];
    const std::uint64_t first = (a & 0xffffU) | std::uint64_t{b & 0xffffU} << (a >> 16U);
    const std::uint64_t second = (c & 0xffffU) | std::uint64_t{d & 0xffffU} << (c >> 16U);
    const unsigned length = (a >> 16U) + (b >> 16U);
    writer.put(first | second << length, length + (c >> 16U) + (d >> 16U));
  }
  out = writer;
  return i;
}

void put_coded(BitWriter& out, Bytes bytes, const HuffmanCode& code) {
  put_head(out, code);
  for (std::size_t i = put_fours(out, bytes, table_of(code)); i < bytes.size(); ++i) code.put(out, bytes[i]);
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
  if (bytes.size() < few || is_noise(bytes)) return put_stored(out, bytes);
  const Counts counts = counts_of(bytes);
  if (*std::max_element(counts.begin(), counts.end()) > bytes.size() / 16 * 15) return put_runs(out, bytes);
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
