#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::test {
namespace {

struct Variant {
  Method method;
  Constrain constrain;
  std::string name;
  Integration integration = Integration::nodal;
};

class AveragedVolume : public testing::TestWithParam<Variant> {
 protected:
  System make(Volumetric volumetric, Index tile = small_tiles) const {
    return system_of(discretize(GetParam().method, box({1, 1, 1}), small_cube(GetParam().integration), 0.25, 5,
                                GetParam().constrain, GetParam().integration),
                     rubber(1e6, 0.49), tile, volumetric);
  }

  const System s = make(Volumetric::averaged);
  const std::vector<Vec3> walls = walls_of(s, wavy);
  State state = reference_state(s);
  Forces forces{s};
};

double largest(const Field<Double4>& f) {
  double scale = 0.0;
  for (const Double4& v : f) scale = std::max(scale, norm(to_vec3(v)));
  return scale;
}

/// Forces are minus the derivative of the mean energies of cells and the bonds' energies; nearly incompressible.
TEST_P(AveragedVolume, ForcesAgreeWithCentralDifferences) {
  move(state, s, wavy);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  const double scale = largest(forces.total()), h = 1e-5;
  const auto potential = [&](State moved) {
    Forces trial(s);
    trial.evaluate(moved, {walls, {}, {}}, 0.0);
    return trial.sums().internal + trial.sums().contact;
  };
  for (std::size_t a = 0; a < s.d.X.size(); ++a)
    for (int i = 0; i < 3; ++i) {
      State plus = state, minus = state;
      plus.x[a][i] += h;
      minus.x[a][i] -= h;
      EXPECT_NEAR(forces.total()[a][i], -(potential(plus) - potential(minus)) / (2.0 * h), 1e-7 * scale) << a;
    }
}

/// Where the change of volume is uniform, averages change nothing: linear motions, hence all patch tests.
TEST_P(AveragedVolume, KnowsNothingOfLinearMotions) {
  const auto linear = [](const Vec3& X) {
    return Vec3{1.1 * X.x + 0.2 * X.y, 0.9 * X.y - 0.1 * X.z, 0.1 * X.x + 1.2 * X.z};
  };
  const System standard = make(Volumetric::standard);
  Forces expected(standard);
  move(state, s, linear);
  State same = state;
  forces.evaluate(state, {walls_of(s, linear), {}, {}}, 0.0);
  expected.evaluate(same, {walls_of(standard, linear), {}, {}}, 0.0);
  const Forces::Internal P = forces.internal(state), P_expected = expected.internal(same);
  const double scale = largest(expected.total());
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    EXPECT_LT(norm(to_vec3(forces.total()[a] - expected.total()[a])), 1e-11 * scale);
    const Mat3 difference = to_mat3(P.P[a]) - to_mat3(P_expected.P[a]);
    EXPECT_LT(std::sqrt(contract(difference, difference)), 1e-12 * 1e8);
  }
  EXPECT_NEAR(forces.sums().internal / expected.sums().internal, 1.0, 1e-11);
}

/// The reaction on what holds a node is minus the derivative with respect to the wall's position.
TEST_P(AveragedVolume, ReactionsAreDerivativesWithRespectToWalls) {
  move(state, s, wavy);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  double scale = 0.0;
  for (const Vec3& R : forces.reactions()) scale = std::max(scale, norm(R));
  const double h = 1e-5;
  for (std::size_t f = 0; f < walls.size(); f += 4)
    for (int i = 0; i < 3; ++i) {
      const auto potential = [&](double shift) {
        std::vector<Vec3> shifted = walls;
        shifted[f][i] += shift;
        State same = state;
        Forces trial(s);
        trial.evaluate(same, {shifted, {}, {}}, 0.0);
        return trial.sums().internal + trial.sums().contact;
      };
      EXPECT_NEAR(forces.reactions()[f][i], -(potential(h) - potential(-h)) / (2.0 * h), 1e-7 * scale) << f;
    }
}

/// What a report says of internal forces and energies: with contact switched off the forces are the particles'.
TEST_P(AveragedVolume, IsReported) {
  Material m = rubber(1e6, 0.49);
  m.contact = {0.0, 0.0};
  const System quiet = system_of(discretize(GetParam().method, box({1, 1, 1}), small_cube(GetParam().integration), 0.25,
                                            5, GetParam().constrain, GetParam().integration),
                                 m, small_tiles, Volumetric::averaged);
  move(state, quiet, wavy);
  Forces f(quiet);
  f.evaluate(state, {walls, {}, {}}, 0.0);
  const Forces::Internal report = f.internal(state);
  const double scale = largest(f.total());
  for (std::size_t a = 0; a < s.d.X.size(); ++a)
    EXPECT_LT(norm(to_vec3(f.total()[a] - report.force[a])), 1e-12 * scale) << a;
  if (GetParam().integration == Integration::nodal) return;
  double energy = 0.0;
  for (std::size_t a = 0; a < s.d.X.size(); ++a) energy += quiet.d.volume[a] * report.energy[a];
  EXPECT_NEAR(energy, f.sums().internal, 1e-12 * energy);
  const std::vector<double> J = f.smallest_J(state);
  EXPECT_EQ(*std::min_element(J.begin(), J.end()), f.sums().smallest_J);
}

/// The same bits for any number of threads; what the tiles are is round-off.
TEST_P(AveragedVolume, DependsOnNeitherThreadsNorTiles) {
  move(state, s, wavy);
  State second = state, third = state;
  parallel::set_threads(1);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  parallel::set_threads(3);
  Forces again(s);
  again.evaluate(second, {walls, {}, {}}, 0.0);
  parallel::set_threads(2);
  const System one_tile = make(Volumetric::averaged, 1000);
  Forces other(one_tile);
  other.evaluate(third, {walls, {}, {}}, 0.0);
  EXPECT_EQ(forces.sums().internal, again.sums().internal);
  const double scale = largest(forces.total());
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    EXPECT_EQ(to_vec3(forces.total()[a]), to_vec3(again.total()[a]));
    EXPECT_LT(norm(to_vec3(forces.total()[a] - other.total()[a])), 1e-13 * scale);
  }
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const Integration i : {Integration::nodal, Integration::cell}) {
    for (const Method m : {Method::delaunay, Method::consistent}) {
      all.push_back({m, nothing, name_of(m) + "_free_" + name_of(i), i});
      all.push_back({m, mixed, name_of(m) + "_mixed_" + name_of(i), i});
    }
    all.push_back({Method::variational, nothing, "variational_free_" + name_of(i), i});
  }
  all.push_back({Method::consistent, nothing, "consistent_free_second_order", Integration::second_order});
  all.push_back({Method::consistent, mixed, "consistent_mixed_second_order", Integration::second_order});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, AveragedVolume, testing::ValuesIn(variants()),
                         [](const auto& variant) { return variant.param.name; });

/// Free bodies: forces and torques of any state add up to zero.
TEST(AveragedVolumeOfFreeBodies, ConservesMomenta) {
  for (const Kind& kind : std::vector<Kind>{{Method::delaunay},
                                            {Method::consistent},
                                            {Method::variational},
                                            {Method::delaunay, Integration::cell},
                                            {Method::consistent, Integration::cell},
                                            {Method::variational, Integration::cell},
                                            {Method::consistent, Integration::second_order}}) {
    SCOPED_TRACE(name_of(kind));
    const System s = system_of(discretize(kind, box({1, 1, 1}), small_cube(kind.integration), 0.3, 11, nothing),
                               rubber(1e6, 0.499), small_tiles, Volumetric::averaged);
    State state = reference_state(s);
    move(state, s, wavy);
    Forces forces(s);
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    Vec3 force, torque;
    double size = 0.0;
    for (std::size_t a = 0; a < s.d.X.size(); ++a) {
      const Vec3 f = to_vec3(forces.total()[a]);
      force += f;
      torque += cross(to_vec3(state.x[a]), f);
      size += norm(f);
    }
    EXPECT_LT(norm(force), 1e-13 * size);
    EXPECT_LT(norm(torque), 1e-13 * size);
  }
}

}  // namespace
}  // namespace tessera::test
