#include "tessera/tessellation/vtu_stream.hpp"

namespace tessera {
namespace {

constexpr int padding = -1;

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// The value of a base64 digit; -2 for other characters.
int digit_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return c == '=' ? padding : -2;
}

}  // namespace

std::uint64_t VtuStream::room() const {
  return encoding_ == VtuEncoding::raw ? text_.size() : decoded_.size() + text_.size() / 4 * 3 + 3;
}

std::string VtuStream::read(std::uint64_t count) {
  if (count > room()) fail("the array's data end too early: the file is truncated; write it again");
  const auto n = static_cast<std::size_t>(count);
  std::string bytes;
  if (encoding_ == VtuEncoding::raw) {
    bytes = text_.substr(0, n);
    text_.remove_prefix(n);
    return bytes;
  }
  decoded_.reserve(n + 3);
  while (decoded_.size() < n) decode_group();
  bytes = decoded_.substr(0, n);
  decoded_.erase(0, n);
  return bytes;
}

int VtuStream::next_digit() {
  while (!text_.empty() && is_space(text_.front())) text_.remove_prefix(1);
  if (text_.empty() || text_.front() == '<')
    fail("the array's base64 data end too early: the file is truncated; write it again");
  const int digit = digit_of(text_.front());
  if (digit == -2) fail("the array's data hold a character that is not base64: the file is damaged; write it again");
  text_.remove_prefix(1);
  return digit;
}

void VtuStream::decode_group() {
  const int a = next_digit(), b = next_digit(), c = next_digit(), d = next_digit();
  if (a == padding || b == padding || (c == padding && d != padding))
    fail("the array's base64 data are padded in a wrong place: the file is damaged; write it again");
  decoded_.push_back(static_cast<char>(a << 2 | b >> 4));
  if (c != padding) decoded_.push_back(static_cast<char>((b & 15) << 4 | c >> 2));
  if (d != padding) decoded_.push_back(static_cast<char>((c & 3) << 6 | d));
}

}  // namespace tessera
