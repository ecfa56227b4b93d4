#include "tessera/base/unit_reader.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "tessera/base/text.hpp"

namespace tessera {

namespace {

Unit power(const Unit& u, int n) {
  return {n * u.exponent, std::pow(u.factor, n), {n * u.dimension.length, n * u.dimension.mass, n * u.dimension.time}};
}

Unit product(const Unit& a, const Unit& b) {
  return {a.exponent + b.exponent,
          a.factor * b.factor,
          {a.dimension.length + b.dimension.length, a.dimension.mass + b.dimension.mass,
           a.dimension.time + b.dimension.time}};
}

/// Reads `unit {(blank | * | . | /) unit}` with `unit = 1 (before /) | name [power] | ( ... ) [power]`.
class UnitReader {
 public:
  UnitReader(std::string_view text, std::size_t position) : text_(text), at_(position) {}

  Unit read() {
    const Unit u = read_product();
    if (at_ < text_.size()) fail(fmt::format("unexpected {} in the unit", quoted(text_.substr(at_))));
    return u;
  }

 private:
  Unit read_product() {
    skip_blanks();
    Unit result;
    if (!next_is("/")) result = read_power();
    while (true) {
      skip_blanks();
      if (at_ >= text_.size() || next_is(")")) return result;
      const bool divide = next_is("/");
      for (const std::string_view sign : {"/", "*", ".", "\u00b7"}) {
        if (!next_is(sign)) continue;
        at_ += sign.size();
        break;
      }
      skip_blanks();
      result = product(result, power(read_power(), divide ? -1 : 1));
    }
  }

  Unit read_power() {
    Unit u;
    if (next_is("(")) {
      ++at_;
      u = read_product();
      if (!next_is(")")) fail("a closing parenthesis is missing in the unit");
      ++at_;
    } else if (is_one_over_something()) {
      ++at_;
    } else {
      u = read_name();
    }
    return power(u, read_exponent());
  }

  bool is_one_over_something() const {
    if (!next_is("1")) return false;
    const std::size_t next = text_.find_first_not_of(' ', at_ + 1);
    return next != std::string_view::npos && text_[next] == '/';
  }

  Unit read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(at_)) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    at_ = begin;
    if (name.empty())
      fail(at_ < text_.size() ? fmt::format("unexpected {} in the unit", quoted(text_.substr(at_)))
                              : std::string("the unit ends too early"));
    const auto u = find_unit(name);
    if (!u)
      fail(
          fmt::format("unknown unit {}{}; known are m g s N Pa J W Hz bar t min h rad deg % with SI prefixes, as in "
                      "\"MPa\" or \"kg/m3\"",
                      quoted(name), did_you_mean_unit(name)));
    at_ = begin + name.size();
    return *u;
  }

  int read_exponent() {
    for (const auto& [sign, value] : {std::pair<std::string_view, int>{"\u00b2", 2}, {"\u00b3", 3}}) {
      if (!next_is(sign)) continue;
      at_ += sign.size();
      return value;
    }
    const bool marked = next_is("^");
    if (marked) ++at_;
    int value = 1;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    const bool found = error == std::errc() && std::abs(value) <= 9;
    if (!found && (marked || error != std::errc::invalid_argument))
      fail("a power from -9 to 9 is expected in the unit");
    if (found) at_ = static_cast<std::size_t>(end - text_.data());
    return found ? value : 1;
  }

  // Bytes of superscripts and of the middle dot end a name; other bytes beyond ASCII (the micro sign) belong to it.
  bool is_letter(std::size_t i) const {
    const auto c = static_cast<unsigned char>(text_[i]);
    if (c == '%' || std::isalpha(c) != 0) return true;
    if (c < 0x80) return false;
    const std::string_view rest = text_.substr(i);
    return !rest.starts_with("\u00b2") && !rest.starts_with("\u00b3") && !rest.starts_with("\u00b7");
  }

  bool next_is(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  [[noreturn]] void fail(const std::string& what) const { throw UnitFault{at_, what}; }

  std::string_view text_;
  std::size_t at_;
};

}  // namespace

Unit read_unit(std::string_view text, std::size_t position) { return UnitReader(text, position).read(); }

}  // namespace tessera
