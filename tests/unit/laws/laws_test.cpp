#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tessera/laws/bond_law.hpp"
#include "tessera/laws/law_lanes.hpp"
#include "tessera/laws/material.hpp"
#include "tessera/laws/viscosity.hpp"

namespace tessera {
namespace {

using Law = decltype(Material::law);

/// A sample of every alternative of the variant: a new law that has none does not compile.
template <class T>
std::vector<T> samples();

template <>
std::vector<NeoHookean> samples<NeoHookean>() {
  return {NeoHookean::from_young_poisson(1e6, 0.3), NeoHookean::from_young_poisson(1e6, 0.49),
          NeoHookean::from_young_poisson(1e6, 0.0), NeoHookean::from_young_poisson(1e6, -0.4)};
}

template <>
std::vector<SaintVenantKirchhoff> samples<SaintVenantKirchhoff>() {
  return {SaintVenantKirchhoff::from_young_poisson(1e6, 0.3), SaintVenantKirchhoff::from_young_poisson(1e6, 0.0)};
}

template <>
std::vector<MooneyRivlin> samples<MooneyRivlin>() {
  return {{2e5, 1e5, {1e6}}, {3e5, 0.0, {1e7}}};
}

template <>
std::vector<Ogden> samples<Ogden>() {
  // The second are Ogden's numbers for rubber, ten times stiffer and less bulky.
  return {{{{4e5, 2.0}}, {1e6}}, {{{6.3e5 * 10, 1.3}, {0.012e5 * 10, 5.0}, {-0.1e5 * 10, -2.0}}, {2e7}}};
}

template <>
std::vector<J2Plasticity> samples<J2Plasticity>() {
  return {J2Plasticity::from_young_poisson(1e6, 0.3, 1e4, 1e5), J2Plasticity::from_young_poisson(1e6, 0.45, 5e3, 0.0),
          J2Plasticity::from_young_poisson(1e6, 0.3, 1e9, 0.0)};
}

template <std::size_t... I>
std::vector<Law> all_laws(std::index_sequence<I...>) {
  std::vector<Law> laws;
  const auto add = [&](const auto& list) { laws.insert(laws.end(), list.begin(), list.end()); };
  (add(samples<std::variant_alternative_t<I, Law>>()), ...);
  return laws;
}

std::vector<Law> all_laws() { return all_laws(std::make_index_sequence<std::variant_size_v<Law>>()); }

double energy(const Law& law, const Mat3& F) {
  return std::visit([&](const auto& l) { return l.energy(F); }, law);
}
Mat3 stress(const Law& law, const Mat3& F) {
  return std::visit([&](const auto& l) { return l.stress(F); }, law);
}

double size_of(const Mat3& m) { return std::sqrt(contract(m, m)); }

/// Random deformations between moderate and extreme, all with J > 0.
std::vector<Mat3> deformations() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Mat3> all{identity(), diagonal(0.2, 1.5, 1.1), diagonal(3.0, 0.7, 0.9)};
  while (all.size() < 20) {
    Mat3 F = identity();
    for (double& v : F.m) v += 0.6 * uniform(random);
    if (determinant(F) > 0.2) all.push_back(F);
  }
  return all;
}

Mat3 rotation(double angle, const Vec3& direction) {
  const Vec3 n = normalized(direction);
  const Mat3 spin{{0, -n.z, n.y, n.z, 0, -n.x, -n.y, n.x, 0}};
  return identity() + std::sin(angle) * spin + (1.0 - std::cos(angle)) * (spin * spin);
}

TEST(Laws, StressIsTheDerivativeOfTheEnergy) {
  for (const Law& law : all_laws())
    for (const Mat3& F : deformations()) {
      const Mat3 P = stress(law, F);
      const double scale = std::max(size_of(P), 1e6);
      for (std::size_t i = 0; i < 9; ++i) {
        // Fourth-order central difference.
        const auto at = [&](double step) {
          Mat3 moved = F;
          moved.m[i] += step;
          return energy(law, moved);
        };
        const double h = 1e-3;
        const double slope = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
        EXPECT_NEAR(P.m[i], slope, 1e-7 * scale);
      }
    }
}

TEST(Laws, AreAtRestInTheReferenceAndObjective) {
  for (const Law& law : all_laws()) {
    EXPECT_EQ(energy(law, identity()), 0.0);
    EXPECT_LT(size_of(stress(law, identity())), 1e-9);
    const Mat3 Q = rotation(2.0, {1, -2, 0.5});
    for (const Mat3& F : deformations()) {
      EXPECT_NEAR(energy(law, Q * F), energy(law, F), 1e-12 * std::max(1e6, energy(law, F)));
      EXPECT_LT(size_of(stress(law, Q * F) - Q * stress(law, F)), 1e-12 * std::max(1e6, size_of(stress(law, F))));
      EXPECT_GE(energy(law, F), 0.0);
    }
  }
}

/// sigma = lambda tr(eps) I + 2 mu eps for small strains; the plane-wave modulus is its stiffness along one axis.
TEST(Laws, AreLinearlyElasticForSmallStrains) {
  const double young = 1e6, poisson = 0.3, strain = 1e-6;
  const NeoHookean law = NeoHookean::from_young_poisson(young, poisson);
  const Mat3 P = law.stress(diagonal(1.0 + strain, 1.0 - poisson * strain, 1.0 - poisson * strain));
  EXPECT_NEAR(P(0, 0), young * strain, 1e-5 * young * strain);
  EXPECT_NEAR(P(1, 1), 0.0, 1e-5 * young * strain);
  for (const Law& l : all_laws()) {
    const double modulus = std::visit([](const auto& m) { return m.plane_wave_modulus(); }, l);
    EXPECT_NEAR(stress(l, diagonal(1.0 + strain, 1, 1))(0, 0), modulus * strain, 1e-5 * modulus * strain);
  }
}

TEST(MaterialNumbers, FollowFromYoungPoissonAndDensity) {
  Material m;
  m.young = 17e6;
  m.poisson = 0.3;
  m.density = 1100;
  m.law = NeoHookean::from_young_poisson(m.young, m.poisson);
  EXPECT_NEAR(m.shear_modulus(), 17e6 / 2.6, 1e-3);
  const double lambda = 0.3 * 17e6 / (1.3 * 0.4);
  EXPECT_NEAR(m.wave_speed(), std::sqrt((lambda + 2.0 * 17e6 / 2.6) / 1100.0), 1e-9);  // [D 55]
}

double bond_energy(double Kn, double Kt, const Vec3& x, const Vec3& y) {
  const Vec3 n = normalized(x), u = x - y, u_n = dot(u, n) * n;
  return 0.5 * Kn * norm2(u_n) + 0.5 * Kt * norm2(u - u_n);  // [D 56]
}

/// [D 56-58] by differences, for stiffer normals, stiffer tangents and equal ones.
TEST(BondLaw, ForcesAreDerivativesOfTheEnergy) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& [Kn, Kt] : std::vector<std::pair<double, double>>{{3, 1}, {1, 3}, {2, 2}, {2, 0}, {0, 2}})
    for (int sample = 0; sample < 20; ++sample) {
      const Vec3 x{1.0 + uniform(random), uniform(random), uniform(random)};
      const Vec3 y = x + 0.8 * Vec3{uniform(random), uniform(random), uniform(random)};
      const BondResponse r = bond_response(Kn, Kt, x, y);
      EXPECT_NEAR(r.energy, bond_energy(Kn, Kt, x, y), 1e-14);
      const double h = 1e-6 * norm(x);
      for (int i = 0; i < 3; ++i) {
        Vec3 d;
        d[i] = h;
        EXPECT_NEAR(r.dU_dx[i], (bond_energy(Kn, Kt, x + d, y) - bond_energy(Kn, Kt, x - d, y)) / (2 * h), 2e-7);
        EXPECT_NEAR(r.dU_dy[i], (bond_energy(Kn, Kt, x, y + d) - bond_energy(Kn, Kt, x, y - d)) / (2 * h), 2e-7);
      }
    }
}

/// [D 59], and no force where the local displacement vanishes.
TEST(BondLaw, WithEqualStiffnessIsASpring) {
  const Vec3 x{1, 2, -1}, y{0.7, 2.2, -1.3};
  const BondResponse r = bond_response(5, 5, x, y);
  EXPECT_LT(norm(r.dU_dx - 5.0 * (x - y)), 1e-15);
  EXPECT_EQ(r.dU_dx, -r.dU_dy);
  const BondResponse rest = bond_response(3, 1, x, x);
  EXPECT_EQ(rest.energy, 0.0);
  EXPECT_EQ(rest.dU_dx, Vec3{});
}

/// Turning both vectors turns the forces; x x dU/dx + y x dU/dy = 0 is the balance of moments.
TEST(BondLaw, IsObjectiveAndBalancesMoments) {
  const Vec3 x{1, 0.3, -0.4}, y{0.8, 0.5, -0.1};
  const Mat3 Q = rotation(1.1, {0.2, 1, 3});
  const BondResponse r = bond_response(3, 1, x, y), turned = bond_response(3, 1, Q * x, Q * y);
  EXPECT_NEAR(turned.energy, r.energy, 1e-15);
  EXPECT_LT(norm(turned.dU_dx - Q * r.dU_dx), 1e-15);
  EXPECT_LT(norm(cross(x, r.dU_dx) + cross(y, r.dU_dy)), 1e-15);
}

Material viscous_material() {
  Material m;
  m.young = 1e6;
  m.poisson = 0.45;
  m.density = 1000;
  m.viscosity = {0.1, 0.3};
  m.law = NeoHookean::from_young_poisson(m.young, m.poisson);
  return m;
}

/// [D 61, 62] as they stand: J sigma F^-T with sigma = rho (c1 c_p h + c2 h^2 |tr d|) d.
TEST(Viscosity, IsThatOfThePaper) {
  const Material m = viscous_material();
  const double h = 0.02;
  const ViscosityLaw law = viscosity_law(m, h);
  for (const Mat3& F : deformations()) {
    const Mat3 rate{{3, -1, 2, 0.5, -4, 1, 0, 2, 1.5}};
    const Mat3 l = rate * inverse(F), d = 0.5 * (l + transpose(l));
    const double factor = m.density * (0.1 * m.wave_speed() * h + 0.3 * h * h * std::abs(trace(d)));
    const Mat3 expected = (determinant(F) * factor) * (d * transpose(inverse(F)));
    EXPECT_LT(size_of(viscous_stress(law, F, rate) - expected), 1e-12 * size_of(expected));
  }
}

/// P : F_dot >= 0, sigma symmetric, no stress from spin, and P(QF, QF_dot + WQF) = Q P.
TEST(Viscosity, DissipatesAndIsObjective) {
  const ViscosityLaw law = viscosity_law(viscous_material(), 0.02);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-5.0, 5.0);
  const Mat3 Q = rotation(0.9, {1, 1, -2});
  const Mat3 spin{{0, -2, 1, 2, 0, -3, -1, 3, 0}};
  for (const Mat3& F : deformations()) {
    Mat3 rate;
    for (double& v : rate.m) v = uniform(random);
    const Mat3 P = viscous_stress(law, F, rate);
    EXPECT_GT(contract(P, rate), 0.0);
    const Mat3 kirchhoff = P * transpose(F);
    EXPECT_LT(size_of(kirchhoff - transpose(kirchhoff)), 1e-12 * size_of(kirchhoff));
    EXPECT_LT(size_of(viscous_stress(law, F, spin * F)), 1e-9);
    const Mat3 turned = viscous_stress(law, Q * F, Q * rate + spin * (Q * F));
    EXPECT_LT(size_of(turned - Q * P), 1e-12 * size_of(P));
  }
}

/// Histories of four points that have flowed already.
std::array<PlasticState, 4> some_histories(const Law& law) {
  std::array<PlasticState, 4> histories{};
  if (const auto* j2 = std::get_if<J2Plasticity>(&law))
    for (std::size_t k = 0; k < 4; ++k) histories[k] = j2->response(deformations()[2 + 3 * k], {}).after;
  return histories;
}

/// Four deformations at once give what one at a time does.
TEST(Lanes, AgreeWithOneAtATime) {
  const std::vector<Mat3> all = deformations();
  for (const Law& any : all_laws()) {
    const std::array<PlasticState, 4> before = some_histories(any);
    std::array<PlasticState, 4> after{}, expected_after{};
    for (std::size_t i = 0; i + 4 <= all.size(); ++i)
      std::visit(
          [&](const auto& law) {
            Lanes9 F, P;
            LanesHistory history;
            for (std::size_t k = 0; k < 4; ++k) {
              set_tensor(F, static_cast<int>(k), all[i + k]);
              history.before[k] = &before[k];
              history.after[k] = &after[k];
            }
            const LanesResponse r = response(law, F, history);
            const LanesResponse expected = one_by_one(
                law, F,
                {history.before, {&expected_after[0], &expected_after[1], &expected_after[2], &expected_after[3]}});
            const double modulus = law.plane_wave_modulus();
            for (int k = 0; k < 4; ++k) {
              const Mat3 stress = tensor_of(expected.stress, k);
              EXPECT_NEAR(r.energy[k], expected.energy[k], 1e-13 * (modulus + expected.energy[k]));
              EXPECT_EQ(r.dissipated[k], expected.dissipated[k]);
              EXPECT_NEAR(r.J[k], expected.J[k], 1e-14);
              EXPECT_LT(size_of(tensor_of(r.stress, k) - stress), 1e-13 * (size_of(stress) + modulus));
            }
            EXPECT_EQ(after, expected_after);
          },
          any);
  }
}

/// rho c^2 of waves a (x) N by differences of the stress: none is above the bound, and the fastest of a uniaxial strain
/// reaches it.
TEST(WaveModulus, IsABoundOfAllPlaneWaves) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto direction = [&] { return normalized({uniform(random), uniform(random), uniform(random)}); };
  const auto modulus = [](const Law& law, const Mat3& F, const Vec3& a, const Vec3& N) {
    const double h = 1e-6;
    const Mat3 H = outer(a, N);
    return contract(H, stress(law, F + h * H) - stress(law, F - h * H)) / (2.0 * h);
  };
  for (const Law& law : all_laws()) {
    const auto bound = [&](const Mat3& F) { return std::visit([&](const auto& l) { return l.wave_modulus(F); }, law); };
    for (const Mat3& F : deformations())
      for (int i = 0; i < 50; ++i) EXPECT_LT(modulus(law, F, direction(), direction()), bound(F) * (1.0 + 1e-6));
    EXPECT_NEAR(modulus(law, identity(), {0, 1, 0}, {0, 1, 0}) / bound(identity()), 1.0, 1e-6);
    if (const Mat3 F = diagonal(1, 0.5, 1); std::holds_alternative<NeoHookean>(law)) {
      EXPECT_NEAR(modulus(law, F, {0, 1, 0}, {0, 1, 0}) / bound(F), 1.0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace tessera
