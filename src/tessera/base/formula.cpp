#include "tessera/base/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "tessera/base/text.hpp"
#include "tessera/base/units.hpp"

namespace tessera {

namespace {

struct NamedFunction {
  const char* name;
  double (*function)(double);
};

// `log` is the natural logarithm here, whatever the parser's own default.
constexpr NamedFunction functions[] = {
    {"sin", [](double x) { return std::sin(x); }},     {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},     {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},   {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},   {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},   {"exp", [](double x) { return std::exp(x); }},
    {"log", [](double x) { return std::log(x); }},     {"log10", [](double x) { return std::log10(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},   {"abs", [](double x) { return std::fabs(x); }},
    {"floor", [](double x) { return std::floor(x); }}, {"ceil", [](double x) { return std::ceil(x); }},
};

double smallest(const double* values, int n) { return *std::min_element(values, values + n); }
double largest(const double* values, int n) { return *std::max_element(values, values + n); }
double power(double x, double y) { return std::pow(x, y); }
double angle(double y, double x) { return std::atan2(y, x); }

std::vector<std::string> variable_names(FormulaNames names) {
  if (names == FormulaNames::face) return {"t", "X", "Y", "Z", "nx", "ny", "nz", "pi"};
  return {"t", "X", "Y", "Z", "pi"};
}

std::vector<std::string> function_names() {
  std::vector<std::string> names = {"min", "max", "pow", "atan2"};
  for (const NamedFunction& f : functions) names.emplace_back(f.name);
  return names;
}

// The parser would read "X = 1" as an assignment, which nobody means in a formula.
std::size_t find_assignment(const std::string& text) {
  for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
    const char before = i > 0 ? text[i - 1] : ' ';
    if (before == '<' || before == '>' || before == '!') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    return i;
  }
  return std::string::npos;
}

[[noreturn]] void fail(const std::string& text, const Origin& origin, int position, const std::string& what) {
  Origin place = origin;
  const int at = std::clamp(position, 0, static_cast<int>(text.size()));
  // A string's column is that of its opening quote.
  if (place.line > 0) place.column += 1 + at;
  throw InputError(place, fmt::format("formula {}, character {}: {}", quoted(text), at + 1, what));
}

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool continues_name(char c) { return starts_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

// The end of the number that starts at `i`, its exponent included.
std::size_t end_of_number(const std::string& text, std::size_t i) {
  char* end = nullptr;
  std::strtod(text.c_str() + i, &end);
  return std::max(i + 1, static_cast<std::size_t>(end - text.c_str()));
}

// A unit behind a number, as in "0.3 m"?
bool is_unit_of_number(const std::string& text, std::size_t begin, const std::string& name) {
  const std::size_t before = begin == 0 ? std::string::npos : text.find_last_not_of(' ', begin - 1);
  return before != std::string::npos &&
         (std::isdigit(static_cast<unsigned char>(text[before])) || text[before] == '.') && is_unit(name);
}

void check_name(const std::string& text, const Origin& origin, FormulaNames known, std::size_t begin, std::size_t end) {
  const std::string name = text.substr(begin, end - begin);
  const int position = static_cast<int>(begin);
  const auto variables = variable_names(known);
  if (std::find(variables.begin(), variables.end(), name) != variables.end()) return;
  const auto calls = function_names();
  if (std::find(calls.begin(), calls.end(), name) == calls.end()) {
    if (is_unit_of_number(text, begin, name))
      fail(text, origin, position,
           fmt::format("unknown name {}; numbers in formulas are in SI units and have none behind them", quoted(name)));
    auto names = variables;
    names.insert(names.end(), calls.begin(), calls.end());
    fail(text, origin, position,
         fmt::format("unknown name {}{}; known are {} and the functions {}", quoted(name), did_you_mean(name, names),
                     fmt::join(variables, ", "), fmt::join(calls, " ")));
  }
  const auto next = text.find_first_not_of(" \t", end);
  if (next == std::string::npos || text[next] != '(')
    fail(text, origin, position, fmt::format("the function {} needs its argument in parentheses", name));
}

// Names are checked before parsing, because the parser says less about them.
void check_names(const std::string& text, const Origin& origin, FormulaNames known) {
  for (std::size_t i = 0; i < text.size();) {
    const bool number = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    std::size_t end = i + 1;
    if (number) end = end_of_number(text, i);
    if (starts_name(text[i])) {
      while (end < text.size() && continues_name(text[end])) ++end;
      check_name(text, origin, known, i, end);
    }
    i = end;
  }
}

std::string explain(const mu::ParserError& error, const std::string& text) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early";
    case mu::ecUNEXPECTED_PARENS:
      return fmt::format("unexpected parenthesis {}", quoted(error.GetToken()));
    case mu::ecMISSING_PARENS:
      return "a closing parenthesis is missing";
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("too few arguments for {}", error.GetToken());
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("too many arguments for {}", error.GetToken());
    case mu::ecUNEXPECTED_ARG_SEP:
      return "a comma is allowed only between the arguments of a function";
    case mu::ecUNASSIGNABLE_TOKEN:
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
    case mu::ecUNEXPECTED_OPERATOR:
      return fmt::format("unexpected {}", quoted(trimmed(error.GetToken())));
    default: {
      const auto at = static_cast<std::size_t>(std::max(error.GetPos(), 0));
      return at < text.size() ? fmt::format("cannot be read from {} on", quoted(text.substr(at))) : "cannot be read";
    }
  }
}

}  // namespace

struct Formula::Impl {
  std::string text;
  Origin origin;
  FormulaNames names = FormulaNames::point;
  double value = 0.0;  // of a constant
  bool uses_time = false;
  bool uses_position = false;
  mutable double t = 0.0;
  mutable Vec3 X, N;
  mu::Parser parser;

  explicit Impl(double constant) : text(fmt::format("{}", constant)), value(constant) {}

  Impl(const std::string& formula, const Origin& where, FormulaNames known)
      : text(formula), origin(where), names(known) {
    define_names();
    parse();
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool constant() const { return !uses_time && !uses_position; }

  /// What has no value before the first step is the case's fault, later the run's.
  [[noreturn]] void refuse(double found) const {
    const std::string what =
        fmt::format("formula {} is {} at t = {} s, X = ({}, {}, {}) m", quoted(text), found, t, X.x, X.y, X.z);
    if (t == 0.0) throw InputError(origin, what);
    throw RunError(describe(origin) + what);
  }

 private:
  void define_names() {
    parser.ClearFun();
    parser.ClearConst();
    for (const NamedFunction& f : functions) parser.DefineFun(f.name, f.function);
    parser.DefineFun("min", smallest);
    parser.DefineFun("max", largest);
    parser.DefineFun("pow", power);
    parser.DefineFun("atan2", angle);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineVar("t", &t);
    parser.DefineVar("X", &X.x);
    parser.DefineVar("Y", &X.y);
    parser.DefineVar("Z", &X.z);
    if (names == FormulaNames::point) return;
    parser.DefineVar("nx", &N.x);
    parser.DefineVar("ny", &N.y);
    parser.DefineVar("nz", &N.z);
  }

  void parse() {
    if (trimmed(text).empty()) fail(text, origin, 0, "it is empty");
    if (const auto at = find_assignment(text); at != std::string::npos)
      fail(text, origin, static_cast<int>(at), "a single \"=\" is no comparison; write \"==\"");
    check_names(text, origin, names);
    try {
      parser.SetExpr(text);
      for (const auto& [name, address] : parser.GetUsedVar()) (name == "t" ? uses_time : uses_position) = true;
      value = parser.Eval();
      if (parser.GetNumResults() != 1)
        fail(text, origin, static_cast<int>(text.find(',')), "one value is expected, not several");
    } catch (const mu::ParserError& error) {
      fail(text, origin, error.GetPos(), explain(error, text));
    }
    if (constant() && !std::isfinite(value)) fail(text, origin, 0, fmt::format("its value is {}", value));
  }
};

Formula::Formula() : Formula(0.0) {}
Formula::Formula(double value) : impl_(std::make_unique<Impl>(value)) {}
Formula::Formula(const std::string& text, const Origin& origin, FormulaNames names)
    : impl_(std::make_unique<Impl>(text, origin, names)) {}

// The parser keeps addresses of its variables, so a copy parses again.
Formula::Formula(const Formula& other)
    : impl_(other.impl_->constant()
                ? std::make_unique<Impl>(other.impl_->value)
                : std::make_unique<Impl>(other.impl_->text, other.impl_->origin, other.impl_->names)) {
  impl_->text = other.impl_->text;
  impl_->origin = other.impl_->origin;
}

Formula::Formula(Formula&&) noexcept = default;

Formula& Formula::operator=(const Formula& other) {
  if (this != &other) *this = Formula(other);
  return *this;
}

Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::operator()(double t, const Vec3& X, const Vec3& N) const {
  if (impl_->constant()) return impl_->value;
  impl_->t = t;
  impl_->X = X;
  impl_->N = N;
  const double value = impl_->parser.Eval();
  if (!std::isfinite(value)) impl_->refuse(value);
  return value;
}

bool Formula::depends_on_time() const { return impl_->uses_time; }
bool Formula::depends_on_position() const { return impl_->uses_position; }
const std::string& Formula::text() const { return impl_->text; }

}  // namespace tessera
