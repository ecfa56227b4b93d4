#include "tessera/geometry/selection.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "tessera/base/formula.hpp"
#include "tessera/base/text.hpp"

namespace tessera {
namespace {

constexpr double kOnSide = 1e-9;  // of the body's size: how far x == min|max reaches

/// "x == min" and its like, as six bits: x min, x max, y min, ... z max.
using Extremes = unsigned;

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Could `item` be a misspelt side or surface ("-x", "top", "part1.+y") rather than a formula?
bool looks_like_name(const std::string& item) {
  const std::size_t first = item.find_first_not_of("+-");
  if (first > 1 || first == std::string::npos || !is_name_character(item[first]) || std::isdigit(item[first]))
    return false;
  return std::all_of(item.begin() + static_cast<std::ptrdiff_t>(first), item.end(),
                     [](char c) { return is_name_character(c) || c == '.' || c == '-' || c == '+'; });
}

[[noreturn]] void refuse_name(const std::string& item, std::span<const std::string> known, const Origin& origin) {
  if (known.empty())
    throw InputError(origin, quoted(item) + " is no name: this body has no named sides; use a formula in X, Y, Z");
  throw InputError(origin, "unknown side or surface " + quoted(item) + did_you_mean(item, known) + "; known are " +
                               list_of(known, "and"));
}

/// One stretch of text such as "x == min".
struct ExtremeTerm {
  std::size_t begin, length;
  int bit;
};

/// Finds an extreme term that begins at `begin`.
std::optional<ExtremeTerm> extreme_term(const std::string& text, std::size_t begin) {
  const std::size_t axis = std::string("xyz").find(text[begin]);
  if (axis == std::string::npos || (begin > 0 && is_name_character(text[begin - 1]))) return std::nullopt;
  const auto skip_blanks = [&](std::size_t i) { return std::min(text.find_first_not_of(" \t", i), text.size()); };
  const std::size_t equals = skip_blanks(begin + 1);
  if (text.compare(equals, 2, "==") != 0) return std::nullopt;
  const std::size_t word = skip_blanks(equals + 2);
  const bool is_max = text.compare(word, 3, "max") == 0;
  if (!is_max && text.compare(word, 3, "min") != 0) return std::nullopt;
  const std::size_t end = word + 3;
  if (end < text.size() && (is_name_character(text[end]) || text[skip_blanks(end)] == '(')) return std::nullopt;
  return ExtremeTerm{begin, end - begin, static_cast<int>(2 * axis) + (is_max ? 1 : 0)};
}

/// A formula in X, Y, Z in which "x == min" and its like take the place of a number. Such a term is known before the
/// formula is evaluated, so there is one formula for each set of true terms, in which "1" or "0" and blanks stand for
/// them: the columns in messages stay those of the user.
class SiteFormula {
 public:
  SiteFormula(std::string text, const Origin& origin) : text_(std::move(text)), origin_(origin) {
    for (std::size_t i = 0; i < text_.size(); ++i)
      if (const auto term = extreme_term(text_, i)) {
        check_stands_alone(*term);
        terms_.push_back(*term);
      }
    for (std::size_t i = 0; i < text_.size(); ++i) check_coordinate(i);
    check_formula();
  }

  bool takes(const Vec3& X, Extremes extremes) { return formula_for(extremes)(0.0, X) != 0.0; }

 private:
  void check_stands_alone(const ExtremeTerm& term) const {
    const std::size_t before = term.begin == 0 ? std::string::npos : text_.find_last_not_of(" \t", term.begin - 1);
    const std::size_t after = text_.find_first_not_of(" \t", term.begin + term.length);
    const bool is_free = (before == std::string::npos || std::string("(&|").find(text_[before]) != std::string::npos) &&
                         (after == std::string::npos || std::string(")&|").find(text_[after]) != std::string::npos);
    if (is_free) return;
    throw InputError(place_of(term.begin), quoted(text_.substr(term.begin, term.length)) +
                                               " can only be combined by && and || and parentheses");
  }

  /// x, y and z are only known in extreme terms.
  void check_coordinate(std::size_t i) const {
    if (std::string("xyz").find(text_[i]) == std::string::npos) return;
    if ((i > 0 && is_name_character(text_[i - 1])) || (i + 1 < text_.size() && is_name_character(text_[i + 1]))) return;
    if (std::any_of(terms_.begin(), terms_.end(), [i](const ExtremeTerm& term) { return term.begin == i; })) return;
    const std::string small(1, text_[i]),
        large(1, static_cast<char>(std::toupper(static_cast<unsigned char>(text_[i]))));
    throw InputError(place_of(i), "formula " + quoted(text_) + ": " + quoted(small) + " is known in " +
                                      quoted(small + " == min") + " and " + quoted(small + " == max") +
                                      " only; the coordinate is " + quoted(large));
  }

  /// What the parser refuses is shown as the user wrote it.
  void check_formula() {
    try {
      if (!formula_for(0).depends_on_time()) return;
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::string parsed = quoted(with_terms(0));
      if (const std::size_t at = message.find(parsed); at != std::string::npos)
        message.replace(at, parsed.size(), quoted(text_));
      throw InputError({}, message);
    }
    throw InputError(origin_, quoted(text_) + " depends on t, but what is selected cannot change with time");
  }

  Origin place_of(std::size_t character) const {
    Origin place = origin_;
    if (place.line > 0) place.column += 1 + static_cast<int>(character);  // the column is that of the opening quote
    return place;
  }

  Formula& formula_for(Extremes extremes) {
    Extremes used = 0;
    for (const ExtremeTerm& term : terms_) used |= 1U << term.bit;
    const auto [it, is_new] = formulas_.try_emplace(extremes & used);
    if (is_new) it->second = Formula(with_terms(extremes), origin_);
    return it->second;
  }

  std::string with_terms(Extremes extremes) const {
    std::string text = text_;
    for (const ExtremeTerm& term : terms_) {
      text.replace(term.begin, term.length, term.length, ' ');
      text[term.begin] = (extremes >> term.bit) & 1U ? '1' : '0';
    }
    return text;
  }

  std::string text_;
  Origin origin_;
  std::vector<ExtremeTerm> terms_;
  std::map<Extremes, Formula> formulas_;
};

}  // namespace

struct Selection::Impl {
  std::vector<std::string> names;
  std::vector<SiteFormula> formulas;
  Vec3 lower, upper;
  double tolerance = 0.0;

  Extremes extremes_at(const Vec3& X) const {
    Extremes bits = 0;
    for (int d = 0; d < 3; ++d) {
      if (std::abs(X[d] - lower[d]) <= tolerance) bits |= 1U << (2 * d);
      if (std::abs(X[d] - upper[d]) <= tolerance) bits |= 2U << (2 * d);
    }
    return bits;
  }
};

Selection::Selection(const SelectionSpec& spec, std::span<const std::string> known_names, const Vec3& lower,
                     const Vec3& upper)
    : impl_(std::make_unique<Impl>()) {
  if (spec.items.empty()) throw InputError(spec.origin, "the selection is empty; give a side, a surface or a formula");
  impl_->lower = lower;
  impl_->upper = upper;
  const Vec3 size = upper - lower;
  impl_->tolerance = kOnSide * std::max({size.x, size.y, size.z});
  for (const std::string& item : spec.items) {
    if (std::find(known_names.begin(), known_names.end(), item) != known_names.end())
      impl_->names.push_back(item);
    else if (looks_like_name(item))
      refuse_name(item, known_names, spec.origin);
    else
      impl_->formulas.emplace_back(item, spec.origin);
  }
}

Selection::Selection(Selection&&) noexcept = default;
Selection& Selection::operator=(Selection&&) noexcept = default;
Selection::~Selection() = default;

bool Selection::takes(const Site& site) const {
  for (const std::string& name : impl_->names)
    if (std::find(site.names.begin(), site.names.end(), name) != site.names.end()) return true;
  const Extremes extremes = impl_->extremes_at(site.X);
  return std::any_of(impl_->formulas.begin(), impl_->formulas.end(),
                     [&](SiteFormula& formula) { return formula.takes(site.X, extremes); });
}

}  // namespace tessera
