#include "tessera/base/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace tessera {
namespace {

const Origin origin{"case.toml", 3, 10, "boundary.0.displacement.1"};
const Vec3 X{2.0, 3.0, 4.0};

struct Good {
  const char* text;
  double value;  // at t = 5, X = (2, 3, 4)
};

class GoodFormula : public testing::TestWithParam<Good> {};

TEST_P(GoodFormula, HasItsValue) {
  const Formula f(GetParam().text, origin);
  EXPECT_DOUBLE_EQ(f(5.0, X), GetParam().value);
  EXPECT_EQ(f.text(), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Formulas, GoodFormula,
    testing::Values(Good{"1e-4*X", 2e-4}, Good{"X + 10*Y + 100*Z + 1000*t", 5432}, Good{"pi", std::numbers::pi},
                    Good{"log(exp(2))", 2}, Good{"log10(1000)", 3}, Good{"sin(pi/6) + cos(0) + tan(0)", 1.5},
                    Good{"sqrt(abs(-9))", 3}, Good{"min(3, 1, 2)", 1}, Good{"max(t, 1)", 5}, Good{"pow(X, 3)", 8},
                    Good{"X^3", 8}, Good{"-2^2", -4}, Good{"2^3^2", 512}, Good{"max(2.5 - abs(t - 2.5), 0)", 0},
                    Good{"t < 10 && X == 2", 1}, Good{"t > 10 || X != 2", 0}, Good{"t >= 5 ? Y : Z", 3},
                    Good{"atan2(1, 0) + asin(0) + acos(1) + atan(0)", std::numbers::pi / 2},
                    Good{"tanh(0) + sinh(0) + cosh(0)", 1}, Good{"floor(2.7) + ceil(2.2)", 5}, Good{" 4 ", 4}));

struct Bad {
  const char* text;
  int position;  // of the fault, from zero
  const char* message;
};

class BadFormula : public testing::TestWithParam<Bad> {};

TEST_P(BadFormula, IsRefusedWithItsColumn) {
  try {
    const Formula f(GetParam().text, origin);
    FAIL() << "accepted with the value " << f(5.0, X);
  } catch (const InputError& error) {
    const std::string what = error.what();
    // The text starts one column after the quote, which is where the origin points.
    const std::string place =
        "case.toml:3:" + std::to_string(11 + GetParam().position) + ": boundary.0.displacement.1: ";
    EXPECT_EQ(what.substr(0, place.size()), place);
    EXPECT_NE(what.find(GetParam().message), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formulas, BadFormula,
    testing::Values(Bad{"", 0, "empty"}, Bad{"  ", 0, "empty"}, Bad{"2*sni(t)", 2, "did you mean \"sin\"?"},
                    Bad{"x + 1", 0, "unknown name \"x\" (did you mean \"X\"?)"}, Bad{"1 + ", 4, "too early"},
                    Bad{"2*(X+1", 6, "closing parenthesis"}, Bad{"X) + 1", 1, "unexpected parenthesis"},
                    Bad{"X = 1", 2, "write \"==\""}, Bad{"1, 2", 1, "not several"}, Bad{"X Y", 2, "unexpected \"Y\""},
                    Bad{"pow(1)", 5, "too few arguments"}, Bad{"pow(1, 2, 3)", 11, "too many arguments"},
                    Bad{"sin + 1", 0, "needs its argument in parentheses"}, Bad{"1..2", 2, "unexpected"},
                    Bad{"1/0", 0, "its value is inf"}, Bad{"sqrt(-1)", 0, "nan"},
                    Bad{"1 s", 2, "unknown name \"s\"; numbers in formulas are in SI units"},
                    Bad{"X + 0.3 mm", 8, "numbers in formulas are in SI units"}, Bad{"X*mm", 2, "known are"},
                    Bad{"X := 2", 3, "write \"==\""}, Bad{"rnd()", 0, "unknown name \"rnd\""},
                    Bad{"\"X\"\n", 3, "\\n"}));

TEST(Formula, ErrorsFromTheCommandLineHaveNoColumn) {
  try {
    const Formula f("1 +", {"command line", 0, 0, "boundary.0.pressure"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "command line: boundary.0.pressure: formula \"1 +\", character 4: it ends too early");
  }
}

TEST(Formula, KnowsWhatItDependsOn) {
  EXPECT_TRUE(Formula("2*t", origin).depends_on_time());
  EXPECT_FALSE(Formula("2*t", origin).depends_on_position());
  EXPECT_TRUE(Formula("Z", origin).depends_on_position());
  EXPECT_FALSE(Formula("Z", origin).depends_on_time());
  EXPECT_TRUE(Formula("2*pi", origin).is_constant());
  EXPECT_TRUE(Formula(3.0).is_constant());
  EXPECT_EQ(Formula()(1.0, X), 0.0);
}

TEST(Formula, PrintsConstantsSoThatTheyReadBack) {
  const double value = 0.1 + 0.2;
  EXPECT_EQ(std::stod(Formula(value).text()), value);
}

TEST(Formula, IsCopiedAndMoved) {
  Formula a("X + t", origin);
  Formula b = a;
  EXPECT_EQ(a(1.0, X), 3.0);
  EXPECT_EQ(b(2.0, X), 4.0);
  const Formula c = std::move(a);
  EXPECT_EQ(c(3.0, X), 5.0);
  b = c;
  EXPECT_EQ(b(0.0, X), 2.0);
  b = Formula("2*pi", origin);
  const Formula d = b;
  EXPECT_EQ(d.text(), "2*pi");
  EXPECT_DOUBLE_EQ(d(0.0, X), 2.0 * std::numbers::pi);
}

TEST(Formula, ReportsValuesThatAreNotFinite) {
  const Formula f("1/(X - 2)", origin);
  EXPECT_EQ(f(0.0, {3.0, 0.0, 0.0}), 1.0);
  try {
    f(0.5, X);
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()),
              "case.toml:3:10: boundary.0.displacement.1: formula \"1/(X - 2)\" is inf at t = 0.5 s, X = (2, 3, 4) m");
  }
  try {
    f(0.0, X);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "case.toml:3:10: boundary.0.displacement.1: formula \"1/(X - 2)\" is inf at t = 0 s, X = (2, 3, 4) m");
  }
}

}  // namespace
}  // namespace tessera
