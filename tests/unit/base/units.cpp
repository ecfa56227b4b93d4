#include "tessera/base/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace tessera {
namespace {

struct Good {
  const char* text;
  double value;
  Dimension dimension;
};

class GoodQuantity : public testing::TestWithParam<Good> {};

TEST_P(GoodQuantity, IsReadInSiUnits) {
  const auto result = read_quantity(GetParam().text);
  ASSERT_TRUE(result.quantity) << result.fault;
  EXPECT_EQ(result.quantity->value, GetParam().value);  // the very number that one would write in SI units
  EXPECT_EQ(result.quantity->dimension, GetParam().dimension);
}

INSTANTIATE_TEST_SUITE_P(
    Units, GoodQuantity,
    testing::Values(Good{"17 MPa", 17e6, dimension::pressure}, Good{"0.1 mm/s", 1e-4, dimension::velocity},
                    Good{"1000 kg/m3", 1000, dimension::density}, Good{"7.85 g/cm^3", 7850, dimension::density},
                    Good{"7.85e-9 t/mm3", 7850, dimension::density}, Good{"5 ms", 5e-3, dimension::time},
                    Good{"2 N/mm2", 2e6, dimension::pressure}, Good{"3 N/m\u00b2", 3, dimension::pressure},
                    Good{"1.5 bar", 1.5e5, dimension::pressure}, Good{"20 mbar", 2e3, dimension::pressure},
                    Good{"10 1/s", 10, dimension::rate}, Good{"10/s", 10, dimension::rate},
                    Good{"10 s^-1", 10, dimension::rate}, Good{"2 kHz", 2e3, dimension::rate},
                    Good{"9.81 m/s2", 9.81, dimension::acceleration}, Good{"9.81 m s-2", 9.81, dimension::acceleration},
                    Good{"9.81 m*s^-2", 9.81, dimension::acceleration}, Good{"3 kg/(m s2)", 3, dimension::pressure},
                    Good{"2 min", 120, dimension::time}, Good{"1 h", 3600, dimension::time},
                    Good{"5 um", 5e-6, dimension::length}, Good{"5 \u00b5m", 5e-6, dimension::length},
                    Good{"5 \u03bcm", 5e-6, dimension::length}, Good{"1e3mm", 1.0, dimension::length},
                    Good{"-.5 m", -0.5, dimension::length}, Good{"+5. m", 5, dimension::length},
                    Good{" 7 km ", 7e3, dimension::length}, Good{"180 deg", std::numbers::pi, dimension::none},
                    Good{"50 %", 0.5, dimension::none}, Good{"0.25", 0.25, dimension::none},
                    Good{"2 J/m3", 2, dimension::pressure}, Good{"3 MW", 3e6, Dimension{2, 1, -3}},
                    Good{"1e-400 m", 0.0, dimension::length}, Good{"1e-99999999999 m", 0.0, dimension::length}));

struct Bad {
  const char* text;
  std::size_t position;
  const char* fault;
};

class BadQuantity : public testing::TestWithParam<Bad> {};

TEST_P(BadQuantity, SaysWhereAndWhy) {
  const auto result = read_quantity(GetParam().text);
  ASSERT_FALSE(result.quantity);
  EXPECT_EQ(result.position, GetParam().position);
  EXPECT_NE(result.fault.find(GetParam().fault), std::string::npos) << result.fault;
}

INSTANTIATE_TEST_SUITE_P(Units, BadQuantity,
                         testing::Values(Bad{"", 0, "empty"}, Bad{"m", 0, "a number is expected"},
                                         Bad{"five m", 0, "a number is expected"}, Bad{"--5 m", 0, "a number"},
                                         Bad{"1.2.3 m", 0, "a number"}, Bad{"5 mmm", 2, "unknown unit \"mmm\""},
                                         Bad{"5 kmin", 2, "unknown unit \"kmin\""}, Bad{"5 m/", 4, "too early"},
                                         Bad{"5 m^x", 4, "a power"}, Bad{"5 m^12", 4, "a power"},
                                         Bad{"5 (m", 4, "parenthesis"}, Bad{"5 m)", 3, "unexpected \")\""},
                                         Bad{"1 1 1", 2, "unexpected \"1 1\""}, Bad{"5 1", 2, "unexpected \"1\""},
                                         Bad{"5 kg / parsec", 7, "unknown unit \"parsec\"; known"},
                                         Bad{"5 Mpa", 2, "unknown unit \"Mpa\" (did you mean \"MPa\"?)"},
                                         Bad{"5 KN/M2", 2, "did you mean \"kN\"?"}, Bad{"1e400 m", 0, "too large"},
                                         Bad{"1e99999999999 m", 0, "too large"}));

TEST(LooksLikeQuantity, TellsUnitsFromFormulas) {
  for (const char* text : {"5 mm", "5mm", "-2 MPa", "10 1/s", "3 nonsense", "50 %", "1 s"})
    EXPECT_TRUE(looks_like_quantity(text)) << text;
  for (const char* text : {"5", "2*X", "X", "-0.1*t", "1/3", "3 / 4", "", "1e-4*X", "2 + t", "free"})
    EXPECT_FALSE(looks_like_quantity(text)) << text;
}

TEST(Dimension, HasANameAndAUnit) {
  EXPECT_EQ(name_of(dimension::pressure), "pressure");
  EXPECT_EQ(si_unit(dimension::density), "kg/m3");
  EXPECT_EQ(si_unit(Dimension{0, 1, -3}), "kg s-3");
  EXPECT_EQ(si_unit(dimension::none), "");
  EXPECT_EQ(name_of(Dimension{0, 1, -3}), "quantity");
  EXPECT_EQ(examples_of(dimension::length), "\"10 mm\" or 0.01");
  EXPECT_EQ(examples_of(Dimension{0, 1, -3}), "\"1 kg s-3\"");
}

}  // namespace
}  // namespace tessera
