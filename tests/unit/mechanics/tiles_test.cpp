#include "tessera/mechanics/tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

/// Every bond is in its particle's tile once, under the local numbers of both ends and with its own data.
TEST(Tiles, HoldEveryBondOnce) {
  const Discretization d = discretize(Method::consistent, box({1, 1, 1}), {5, 4, 6}, 0.25, 3, mixed);
  const Tiles t = make_tiles(d, {{0, d.particles(), 0}}, 17);
  ASSERT_EQ(t.size(), (d.particles() + 16) / 17);
  ASSERT_EQ(t.bonds, d.bonds.size());
  std::vector<int> seen(static_cast<std::size_t>(d.bonds.size()), 0);
  for (Index k = 0; k < t.size(); ++k) {
    const Tile& tile = t.tiles[static_cast<std::size_t>(k)];
    const auto global = [&](Index local) {
      return local < tile.size() ? tile.begin + local : t.rim[static_cast<std::size_t>(tile.rim + local - tile.size())];
    };
    const auto bonds_of = [&](Index a) { return d.bonds.end(a) - d.bonds.begin(a); };
    Offset slots = 0;
    for_each_slot(t, tile, bonds_of, [&](Offset slot, Index a, Index i) {
      const auto place = static_cast<std::size_t>(slot);
      const Index b = global(t.neighbour[place]);
      ++slots;
      if (i < 0) {  // padding: does nothing along a branch that does not vanish
        EXPECT_EQ(t.area_over_length[place], 0.0);
        EXPECT_EQ(t.B[place], Vec3{});
        EXPECT_NE(b, a);
        return;
      }
      const auto bond = static_cast<std::size_t>(d.bonds.begin(a) + i);
      EXPECT_EQ(b, d.bonds.neighbour[bond]);
      EXPECT_EQ(t.area_over_length[place], d.bonds.area_over_length[bond]);
      EXPECT_EQ(t.B[place], d.bonds.B_ab[bond]);
      ++seen[bond];
    });
    EXPECT_EQ(tile.slot + slots, t.end_of(k).slot);
  }
  EXPECT_EQ(seen, std::vector<int>(static_cast<std::size_t>(d.bonds.size()), 1));
}

/// A position in a rim is listed with the particle that is there.
TEST(Tiles, KnowWhereAParticleIsInTheRims) {
  const Discretization d = discretize(Method::consistent, box({1, 1, 1}), {5, 4, 6}, 0.25, 3, nothing);
  const Tiles t = make_tiles(d, {{0, d.particles(), 0}}, 17);
  ASSERT_FALSE(t.rim.empty());
  ASSERT_EQ(t.rim_place.size(), t.rim.size());
  for (Index a = 0; a < d.particles(); ++a)
    for (Offset i = t.rim_offset[static_cast<std::size_t>(a)]; i < t.rim_offset[static_cast<std::size_t>(a) + 1]; ++i)
      EXPECT_EQ(t.rim[static_cast<std::size_t>(t.rim_place[static_cast<std::size_t>(i)])], a);
}

TEST(Tiles, DoNotCrossMaterials) {
  const Discretization d = discretize(Method::consistent, box({1, 1, 1}), {4, 4, 4}, 0.25, 3, nothing);
  const Tiles t = make_tiles(d, {{0, 30, 0}, {30, 64, 1}}, 20);
  for (Index k = 0; k < t.size(); ++k) {
    const Tile& tile = t.tiles[static_cast<std::size_t>(k)];
    EXPECT_EQ(tile.material, tile.begin < 30 ? 0 : 1);
    EXPECT_TRUE(tile.end <= 30 || tile.begin >= 30);
  }
}

class TileSizes : public testing::TestWithParam<Kind> {};

/// Forces, stresses, reactions and sums are those of one tile that holds everything.
template <class Values>
bool same_bytes(const Values& a, const Values& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST_P(TileSizes, DoNotChangeWhatComesOut) {
  const Discretization d = discretize(GetParam(), box({1, 1, 1}), {4, 4, 4}, 0.1, 3, mixed);
  Material m = rubber();
  m.viscosity = {0.3, 0.2};
  const System one = system_of(d, m, d.particles()), many = system_of(d, m, 9);
  ASSERT_EQ(one.tiles.size(), 1);
  ASSERT_GT(many.tiles.size(), 6);
  const std::vector<Vec3> walls = walls_of(one, wavy);
  const auto evaluated = [&](const System& s, Forces& forces) {
    State state = reference_state(s);
    forces.evaluate(state, {walls, {}, {0.0, 0.0, -9.81}}, 0.0);
    Forces::Internal again = forces.internal(state);
    move(state, s, wavy);
    forces.evaluate(state, {walls, {}, {0.0, 0.0, -9.81}}, 1e-3);
    Forces::Internal internal = forces.internal(state);
    forces.find_internal(state, again);
    EXPECT_TRUE(same_bytes(again.force, internal.force) && same_bytes(again.P, internal.P));
    return internal;
  };
  Forces of_one(one), of_many(many);
  const Forces::Internal expected = evaluated(one, of_one), internal = evaluated(many, of_many);
  double f_scale = 0.0, P_scale = 0.0;
  for (std::size_t a = 0; a < d.X.size(); ++a) {
    f_scale = std::max(f_scale, norm(to_vec3(of_one.total()[a])));
    P_scale = std::max(P_scale, std::sqrt(contract(to_mat3(expected.P[a]), to_mat3(expected.P[a]))));
  }
  ASSERT_GT(f_scale, 0.0);
  for (std::size_t a = 0; a < d.X.size(); ++a) {
    EXPECT_LT(norm(to_vec3(of_many.total()[a] - of_one.total()[a])), 1e-13 * f_scale);
    EXPECT_LT(norm(to_vec3(internal.force[a] - expected.force[a])), 1e-13 * f_scale);
    const Mat3 difference = to_mat3(internal.P[a]) - to_mat3(expected.P[a]);
    EXPECT_LT(std::sqrt(contract(difference, difference)), 1e-13 * P_scale);
  }
  for (std::size_t f = 0; f < walls.size(); ++f)
    EXPECT_LT(norm(of_many.reactions()[f] - of_one.reactions()[f]), 1e-12 * f_scale);
  EXPECT_NEAR(of_many.sums().internal, of_one.sums().internal, 1e-13 * of_one.sums().internal);
  EXPECT_NEAR(of_many.sums().contact, of_one.sums().contact, 1e-13 * of_one.sums().contact);
  EXPECT_NEAR(of_many.sums().dissipated, of_one.sums().dissipated, 1e-13 * of_one.sums().dissipated);
  EXPECT_NEAR(of_many.sums().smallest_J, of_one.sums().smallest_J, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(All, TileSizes,
                         testing::Values(Kind{Method::delaunay}, Kind{Method::consistent}, Kind{Method::variational},
                                         Kind{Method::quasi_static}, Kind{Method::delaunay, Integration::cell},
                                         Kind{Method::consistent, Integration::cell},
                                         Kind{Method::variational, Integration::cell}),
                         [](const auto& method) { return name_of(method.param); });

/// Eight particles at once, where the processor can do that, have the same forces and stresses as four, for quads of
/// unequal lengths, a quad that is alone and one with padding.
TEST(ContactSweep, GivesTheSameBitsOnFourAndOnEightParticles) {
  for (const Index size : {64, 57, 11, 4, 1}) {
    const Discretization d = discretize(Method::consistent, box({1, 1, 1}), {4, 4, 4}, 0.25, 3, nothing);
    const System s = system_of(d, rubber(), size);
    State state = reference_state(s);
    move(state, s, wavy);
    Field<Tensor> F(d.X.size());
    Field<Double4> f(d.X.size()), f_of_four(d.X.size());
    TileScratch scratch(s), of_four(s);
    for (Index k = 0; k < s.tiles.size(); ++k) strain_sweep(s, k, state.x.data(), F.data(), scratch);
    double energy = 0.0;
    for (Index k = 0; k < s.tiles.size(); ++k) {
      const double by_four = contact_sweep_of_four(s, k, state.x.data(), F.data(), f_of_four.data(), of_four);
      EXPECT_NEAR(contact_sweep(s, k, state.x.data(), F.data(), f.data(), scratch), by_four, 1e-14 * by_four);
      energy += by_four;
      for (std::size_t a = 0; a < static_cast<std::size_t>(s.tiles.tiles[static_cast<std::size_t>(k)].size()); ++a)
        EXPECT_EQ(to_mat3(scratch.T[a]), to_mat3(of_four.T[a]));
    }
    EXPECT_GT(energy, 0.0);
    for (std::size_t a = 0; a < f.size(); ++a) EXPECT_EQ(to_vec3(f[a]), to_vec3(f_of_four[a]));
  }
}

/// A deformation that has lost all meaning is noticed wherever it is.
TEST(StressSums, NoticeWhatIsNotFiniteAndWhatIsInverted) {
  const System s = system_of(discretize(Method::consistent, box({1, 1, 1}), {4, 4, 4}, 0.1, 3, nothing), rubber());
  for (const std::size_t a : {std::size_t{0}, std::size_t{37}, s.d.X.size() - 1}) {
    Forces forces(s);
    State state = reference_state(s);
    state.x[a][1] = std::numeric_limits<double>::quiet_NaN();
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    EXPECT_FALSE(forces.sums().finite);

    state = reference_state(s);
    const Vec3 X_a = s.d.X[a];
    for (Double4& x : state.x)  // turns the neighbourhood inside out and leaves the rest alone
      if (norm(to_vec3(x) - X_a) < 0.6) x[2] = 2.0 * X_a.z - x[2];
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    EXPECT_TRUE(forces.sums().finite);
    EXPECT_LT(forces.sums().smallest_J, 0.0);
  }
}

}  // namespace
}  // namespace tessera::test
