#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "tessera/mechanics/averaged_cubature.hpp"

namespace tessera::test {
namespace {

/// A body whose cells have deformations and variations of their own, whatever a motion would allow.
class PointsWithMeanVolume : public testing::Test {
 protected:
  explicit PointsWithMeanVolume(const Material& m = rubber(1e6, 0.49))
      : s(system_of(discretize(Method::consistent, box({1, 1, 1}), {3, 3, 2}, 0.25, 5, nothing, Integration::cell), m,
                    small_tiles, Volumetric::averaged)),
        F(s.d.X.size()),
        E(s.d.X.size()) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.06, 0.06);
    const auto tensor = [&] {
      Mat3 t;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) t(i, j) = uniform(random);
      return t;
    };
    for (std::size_t a = 0; a < F.size(); ++a) {
      F[a] = to_tensor(identity() + tensor());
      for (int q = 0; q < 3; ++q) E[a].k[q] = to_kernel(tensor());
    }
  }

  double energy(const Field<Tensor>& F_of, Field<ThreeTensors> E_of) const {
    return AveragedCubature(s).evaluate(F_of.data(), E_of.data(), {}, {}).internal;
  }

  const System s;
  Field<Tensor> F;
  Field<ThreeTensors> E;
};

/// P_a and Z_aq are the derivatives by F_a, per volume, and by E_aq.
TEST_F(PointsWithMeanVolume, HaveTheDerivativesOfTheirEnergy) {
  AveragedCubature cubature(s);
  Field<ThreeTensors> Z = E;
  cubature.evaluate(F.data(), Z.data(), {}, {});
  const double h = 1e-5;
  for (std::size_t a = 0; a < F.size(); a += 5) {
    for (std::size_t i = 0; i < 9; ++i) {
      Field<Tensor> plus = F, minus = F;
      plus[a].m[i] += h, minus[a].m[i] -= h;
      EXPECT_NEAR(s.d.volume[a] * cubature.P()[a].m[i], (energy(plus, E) - energy(minus, E)) / (2.0 * h), 2e-3) << a;
    }
    for (int q = 0; q < 3; ++q)
      for (int i = 0; i < 3; ++i) {
        Field<ThreeTensors> plus = E, minus = E;
        plus[a].k[q].c1[i] += h, minus[a].k[q].c1[i] -= h;
        EXPECT_NEAR(Z[a].k[q].c1[i], (energy(F, plus) - energy(F, minus)) / (2.0 * h), 2e-3) << a;
      }
  }
}

/// Without resistance to shear: the energy is that of one change of volume a cell, the mean of the points' J around it.
class PointsOfAFluid : public PointsWithMeanVolume {
 protected:
  PointsOfAFluid() : PointsWithMeanVolume(made_of(MooneyRivlin{0.0, 0.0, {8e5}})) {}
};

TEST_F(PointsOfAFluid, HaveOneChangeOfVolumeACell) {
  std::vector<double> J(F.size()), once(F.size()), Jbar(F.size());
  for (std::size_t a = 0; a < F.size(); ++a)
    for (int q = 0; q < 3; ++q)
      J[a] += (determinant(to_mat3(F[a]) + to_mat3(E[a].k[q])) + determinant(to_mat3(F[a]) - to_mat3(E[a].k[q]))) / 6.0;
  s.average->mean_twice(J, once, Jbar);
  double expected = 0.0;
  for (std::size_t a = 0; a < F.size(); ++a)
    expected += s.d.volume[a] * 8e5 / 4.0 * (Jbar[a] * Jbar[a] - 1.0 - 2.0 * std::log(Jbar[a]));
  EXPECT_NEAR(energy(F, E), expected, 1e-12 * expected);
}

}  // namespace
}  // namespace tessera::test
