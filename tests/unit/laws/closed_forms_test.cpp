#include <gtest/gtest.h>

#include <random>

#include "tessera/laws/material.hpp"

namespace tessera {
namespace {

Mat3 cauchy(const Mat3& P, const Mat3& F) { return (1.0 / determinant(F)) * (P * transpose(F)); }

Mat3 shear(double gamma) { return identity() + gamma * outer({1, 0, 0}, {0, 1, 0}); }

/// Stretch l along x, the same volume.
Mat3 isochoric_uniaxial(double l) { return diagonal(l, 1.0 / std::sqrt(l), 1.0 / std::sqrt(l)); }
Mat3 isochoric_equibiaxial(double l) { return diagonal(l, l, 1.0 / (l * l)); }

constexpr std::array<double, 5> stretches{0.5, 0.8, 1.1, 1.7, 3.0};

TEST(SaintVenantKirchhoffLaw, HasTheClosedFormsOfHomogeneousDeformations) {
  const double young = 2e6, poisson = 0.3;
  const SaintVenantKirchhoff law = SaintVenantKirchhoff::from_young_poisson(young, poisson);
  for (const double l : {0.7, 0.9, 1.1, 1.3}) {
    const double E = 0.5 * (l * l - 1.0);
    const double thin = std::sqrt(1.0 - 2.0 * poisson * E),
                 thinner = std::sqrt(1.0 - 4.0 * poisson / (1 - poisson) * E);
    const Mat3 uniaxial = law.stress(diagonal(l, thin, thin)), biaxial = law.stress(diagonal(l, l, thinner));
    EXPECT_NEAR(uniaxial(0, 0), l * young * E, 1e-9 * young);
    EXPECT_NEAR(uniaxial(1, 1), 0.0, 1e-9 * young);
    EXPECT_NEAR(biaxial(0, 0), l * young / (1.0 - poisson) * E, 1e-9 * young);
    EXPECT_NEAR(biaxial(2, 2), 0.0, 1e-9 * young);
  }
  const double gamma = 0.8;
  const Mat3 P = law.stress(shear(gamma));
  EXPECT_NEAR(P(0, 1), law.mu * gamma + (0.5 * law.lambda + law.mu) * gamma * gamma * gamma, 1e-9 * young);
  EXPECT_NEAR(P(1, 0), law.mu * gamma, 1e-9 * young);
}

TEST(MooneyRivlinLaw, HasTheClosedFormsOfHomogeneousDeformations) {
  const double c10 = 3e5, c01 = 1e5, bulk = 5e6;
  const MooneyRivlin law{c10, c01, {bulk}};
  for (const double l : stretches) {
    const Mat3 U = isochoric_uniaxial(l), B = isochoric_equibiaxial(l);
    const Mat3 uniaxial = cauchy(law.stress(U), U), biaxial = cauchy(law.stress(B), B);
    EXPECT_NEAR(uniaxial(0, 0) - uniaxial(1, 1), 2.0 * (l * l - 1.0 / l) * (c10 + c01 / l), 1e-8 * bulk);
    EXPECT_NEAR(biaxial(0, 0) - biaxial(2, 2), 2.0 * (l * l - std::pow(l, -4)) * (c10 + c01 * l * l), 1e-8 * bulk);
    const Mat3 V = l * identity();
    const double J = l * l * l;
    EXPECT_NEAR(cauchy(law.stress(V), V)(1, 1), 0.5 * bulk * (J - 1.0 / J), 1e-9 * bulk * J);
  }
  const double gamma = 1.3;
  const Mat3 sigma = cauchy(law.stress(shear(gamma)), shear(gamma));
  EXPECT_NEAR(sigma(0, 1), 2.0 * (c10 + c01) * gamma, 1e-9 * bulk);
  EXPECT_NEAR(sigma(0, 0) - sigma(1, 1), 2.0 * (c10 + c01) * gamma * gamma, 1e-9 * bulk);
  EXPECT_NEAR(sigma(1, 1) - sigma(2, 2), -2.0 * c01 * gamma * gamma, 1e-9 * bulk);
}

TEST(OgdenLaw, HasTheClosedFormsOfHomogeneousDeformations) {
  const Ogden law{{{6.3e5, 1.3}, {1.2e3, 5.0}, {-1e4, -2.0}}, {2e7}};
  const auto sum = [&](auto&& of_exponent) {
    double s = 0.0;
    for (const OgdenTerm& t : law.terms) s += t.mu * of_exponent(t.alpha);
    return s;
  };
  EXPECT_NEAR(law.shear_modulus(), 0.5 * (6.3e5 * 1.3 + 1.2e3 * 5.0 + 1e4 * 2.0), 1e-9);
  for (const double l : stretches) {
    const Mat3 U = isochoric_uniaxial(l), B = isochoric_equibiaxial(l);
    const Mat3 uniaxial = cauchy(law.stress(U), U), biaxial = cauchy(law.stress(B), B);
    EXPECT_NEAR(uniaxial(0, 0) - uniaxial(1, 1), sum([&](double a) { return std::pow(l, a) - std::pow(l, -0.5 * a); }),
                1.0);
    EXPECT_NEAR(biaxial(0, 0) - biaxial(2, 2), sum([&](double a) { return std::pow(l, a) - std::pow(l, -2.0 * a); }),
                1.0);
  }
  const double gamma = 1.3, root = std::sqrt(gamma * gamma + 4.0), l = 0.5 * (gamma + root);
  EXPECT_NEAR(cauchy(law.stress(shear(gamma)), shear(gamma))(0, 1),
              sum([&](double a) { return (std::pow(l, a) - std::pow(l, -a)) / root; }), 1e-2);
}

/// A Mooney-Rivlin solid is the Ogden solid with the exponents 2 and -2.
TEST(OgdenLaw, ContainsMooneyRivlin) {
  const MooneyRivlin mooney{3e5, 1e5, {5e6}};
  const Ogden ogden{{{6e5, 2.0}, {-2e5, -2.0}}, {5e6}};
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  for (int sample = 0; sample < 20; ++sample) {
    Mat3 F = identity();
    for (double& v : F.m) v += uniform(random);
    const Mat3 P = mooney.stress(F), difference = P - ogden.stress(F);
    EXPECT_LT(std::sqrt(contract(difference, difference)), 1e-9 * 5e6);
    EXPECT_NEAR(mooney.energy(F), ogden.energy(F), 1e-9 * 5e6);
  }
}

/// A bar under uniaxial stress: the logarithmic strain e gives the Kirchhoff stress tau, and e_p across.
struct Bar {
  double young = 2e11, poisson = 0.3, yield_stress = 3e8, hardening = 5e9;
  J2Plasticity law() const { return J2Plasticity::from_young_poisson(young, poisson, yield_stress, hardening); }

  /// The deformation under the stress tau when alpha_p is the plastic strain along the bar.
  Mat3 deformation(double tau, double plastic) const {
    const double across = std::exp(-poisson * tau / young - 0.5 * plastic);
    return diagonal(std::exp(tau / young + plastic), across, across);
  }
};

TEST(J2PlasticityLaw, HardensLinearlyUnderUniaxialStress) {
  const Bar bar;
  for (const double strain : {1e-4, 0.01, 0.1, 0.5}) {
    const double tau = bar.yield_stress + bar.hardening * strain;
    const Mat3 F = bar.deformation(tau, strain);
    const J2Plasticity::Response r = bar.law().response(F, {});
    EXPECT_NEAR(r.stress(0, 0), tau / F(0, 0), 1e-6 * tau);
    EXPECT_NEAR(r.stress(1, 1), 0.0, 1e-6 * tau);
    EXPECT_NEAR(r.after.strain, strain, 1e-9);
    EXPECT_NEAR(r.dissipated, bar.yield_stress * strain, 1e-9 * bar.yield_stress);
    EXPECT_NEAR(r.energy, 0.5 * tau * tau / bar.young + 0.5 * bar.hardening * strain * strain, 1e-6 * tau);
  }
}

TEST(J2PlasticityLaw, UnloadsElasticallyAndYieldsAgainBothWays) {
  const Bar bar;
  const double strain = 0.1, limit = bar.yield_stress + bar.hardening * strain;
  const PlasticState before = bar.law().response(bar.deformation(limit, strain), {}).after;
  for (const double share : {0.999, 0.5, 0.0, -0.5, -0.999}) {
    const Mat3 F = bar.deformation(share * limit, strain);
    const J2Plasticity::Response r = bar.law().response(F, before);
    EXPECT_NEAR(r.stress(0, 0), share * limit / F(0, 0), 1e-6 * limit);
    EXPECT_EQ(r.after, before);
    EXPECT_EQ(r.dissipated, 0.0);
  }
  for (const double sign : {1.0, -1.0}) {
    const double more = 0.05, tau = limit + bar.hardening * more;
    const Mat3 F = bar.deformation(sign * tau, strain + sign * more);
    const J2Plasticity::Response r = bar.law().response(F, before);
    EXPECT_NEAR(r.stress(0, 0), sign * tau / F(0, 0), 1e-6 * tau);
    EXPECT_NEAR(r.after.strain, strain + more, 1e-9);
  }
}

/// Simple shear at small strain: tau_12 = sigma_y / sqrt 3 where nothing hardens.
TEST(J2PlasticityLaw, YieldsInShearAtItsRootOfThree) {
  const J2Plasticity law = J2Plasticity::from_young_poisson(2e11, 0.3, 3e8, 0.0);
  const Mat3 F = shear(0.005);
  EXPECT_NEAR(cauchy(law.stress(F), F)(0, 1), 3e8 / std::sqrt(3.0), 0.005 * 3e8);
  const Mat3 sigma = cauchy(law.stress(F), F), s = sigma - (trace(sigma) / 3.0) * identity();
  EXPECT_NEAR(std::sqrt(1.5 * contract(s, s)), 3e8, 1e-6 * 3e8);
}

/// Over a long random path flow keeps the volume, the stress stays inside the yield surface, the plastic strain and
/// what is dissipated only grow, and the stress is the derivative of the incremental potential all the way.
TEST(J2PlasticityLaw, KeepsTheVolumeAndItsPotentialOnAnyPath) {
  const J2Plasticity law = J2Plasticity::from_young_poisson(1e6, 0.3, 1e4, 2e4);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-0.03, 0.03);
  Mat3 F = identity();
  PlasticState state;
  int flowing = 0;
  for (int step = 0; step < 200; ++step) {
    Mat3 turn = identity();
    for (double& v : turn.m) v += uniform(random);
    F = turn * F;
    F = std::cbrt(1.0 / determinant(F)) * F;
    const J2Plasticity::Response r = law.response(F, state);
    EXPECT_GE(r.dissipated, 0.0);
    EXPECT_GE(r.after.strain, state.strain);
    if (r.after.strain > state.strain) {
      ++flowing;
      EXPECT_NEAR(determinant(r.after.tensor()), 1.0, 1e-11);
    }
    const Mat3 tau = r.stress * transpose(F), s = tau - (trace(tau) / 3.0) * identity();
    EXPECT_LE(std::sqrt(1.5 * contract(s, s)), (1e4 + 2e4 * r.after.strain) * (1.0 + 1e-9));
    EXPECT_LT(std::abs(tau(0, 1) - tau(1, 0)), 1e-8 * 1e6);
    for (std::size_t i = 0; i < 9; ++i) {
      const double h = 1e-6;
      Mat3 plus = F, minus = F;
      plus.m[i] += h;
      minus.m[i] -= h;
      EXPECT_NEAR(r.stress.m[i], (law.energy(plus, state) - law.energy(minus, state)) / (2.0 * h), 1e-5 * 1e6);
    }
    state = r.after;
  }
  EXPECT_GT(flowing, 100);
}

/// What has flowed is seen from no frame: the same turned deformation, the same history.
TEST(J2PlasticityLaw, HistoryIsObjective) {
  const J2Plasticity law = J2Plasticity::from_young_poisson(1e6, 0.3, 1e4, 2e4);
  const Mat3 F = diagonal(1.4, 0.8, 0.95) * shear(0.3), Q{{0, -1, 0, 1, 0, 0, 0, 0, 1}};
  const PlasticState first = law.response(F, {}).after, second = law.response(Q * F, {}).after;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(first.Cp_inverse[i], second.Cp_inverse[i], 1e-14);
  EXPECT_NEAR(first.strain, second.strain, 1e-14);
}

/// Held, the same solid is elastic about what has flowed.
TEST(J2PlasticityLaw, HeldDoesNotFlow) {
  const Bar bar;
  const PlasticState before = bar.law().response(bar.deformation(8e8, 0.1), {}).after;
  const double tau = 5e9;  // far beyond the yield stress
  const Mat3 F = bar.deformation(tau, 0.1);
  const J2Plasticity::Response r = bar.law().held().response(F, before);
  EXPECT_NEAR(r.stress(0, 0), tau / F(0, 0), 1e-6 * tau);
  EXPECT_EQ(r.after, before);
  EXPECT_TRUE(std::isfinite(r.energy));
}

}  // namespace
}  // namespace tessera
