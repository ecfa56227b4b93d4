#include "tessera/base/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tessera {
namespace {

Double4 four(double a, double b, double c, double d) { return Double4{a, b, c, d}; }

TEST(Lanes, LogarithmIsExactToOneUnitInTheLastPlace) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> near_one(0.5, 2.0), exponent(-300.0, 300.0);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? near_one(random) : std::pow(10.0, exponent(random));
    const double y = i % 4 == 0 ? 1.0 + 1e-6 * (x - 1.0) : x;
    const Double4 ln = log(four(x, y, 1.0 / x, 1.0));
    const double last_place = std::abs(std::nextafter(std::log(x), 1e9) - std::log(x));
    EXPECT_LE(std::abs(ln[0] - std::log(x)), last_place) << x;
    EXPECT_LE(std::abs(ln[1] - std::log(y)), std::abs(std::nextafter(std::log(y), 1e9) - std::log(y))) << y;
    EXPECT_EQ(ln[3], 0.0);
  }
}

TEST(Lanes, ExponentialIsExactToOneUnitInTheLastPlace) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> near_zero(-1.0, 1.0), far(-700.0, 700.0);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? near_zero(random) : far(random);
    const Double4 power = exp(four(x, 1e-9 * x, 0.1 * x, 0.0));
    for (int k = 0; k < 3; ++k) {
      const double exact = std::exp((k == 0 ? 1.0 : (k == 1 ? 1e-9 : 0.1)) * x);
      EXPECT_LE(std::abs(power[k] - exact), std::nextafter(exact, 1e308) - exact) << x;
    }
    EXPECT_EQ(power[3], 1.0);
  }
}

TEST(Lanes, TransposesFourVectorsThereAndBack) {
  const Double4 a = four(1, 2, 3, 9), b = four(4, 5, 6, 9), c = four(7, 8, 9, 9), d = four(10, 11, 12, 9);
  const Lanes3 l = transposed(a, b, c, d);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(l.x[k], 1 + 3 * k);
    EXPECT_EQ(l.y[k], 2 + 3 * k);
    EXPECT_EQ(l.z[k], 3 + 3 * k);
  }
  const FourVectors back = transposed(l);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(back.v[k][i], 1 + i + 3 * k);
    EXPECT_EQ(back.v[k][3], 0);
  }
  EXPECT_EQ(sum(a), 15);
}

TEST(Lanes, LoadPairsFromFourRows) {
  const double rows[4][3] = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}, {0, 7, 8}};
  const TwoLanes pairs = load_pairs(rows[0] + 1, rows[1] + 1, rows[2] + 1, rows[3] + 1);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(pairs.first[k], 1 + 2 * k);
    EXPECT_EQ(pairs.second[k], 2 + 2 * k);
  }
}

TEST(Lanes, LoadFoursFromEightRows) {
  double rows[8][5];
  for (int r = 0; r < 8; ++r)
    for (int i = 0; i < 5; ++i) rows[r][i] = 10 * r + i;
  const double* const row[8] = {rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7]};
  const FourOfEight fours = load_fours(row, 1);
  for (int r = 0; r < 8; ++r) {
    EXPECT_EQ(fours.n0[r], 10 * r + 1);
    EXPECT_EQ(fours.n1[r], 10 * r + 2);
    EXPECT_EQ(fours.n2[r], 10 * r + 3);
    EXPECT_EQ(fours.n3[r], 10 * r + 4);
  }
}

}  // namespace
}  // namespace tessera
