#include "tessera/geometry/surface_mend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "support/surfaces.hpp"
#include "tessera/base/error.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_primitives.hpp"
#include "tessera/geometry/surface_transform.hpp"
#include "tessera/geometry/triangle_meeting.hpp"

namespace tessera {
namespace {

/// Does to a sound surface what programs do that write surfaces carelessly.
class Vandal {
 public:
  Vandal(const TriangleSurface& surface, unsigned seed) : surface_(surface), random_(seed) {}

  /// A triangle learns of a point on one of its edges, of which its neighbour does not know.
  void split_on_one_side() {
    const std::size_t t = any_triangle();
    const Triangle old = surface_.triangles[t];
    const double s = std::uniform_real_distribution<double>(0.2, 0.8)(random_);
    const auto v = static_cast<Index>(surface_.vertices.size());
    surface_.vertices.push_back((1 - s) * surface_.vertex(old[0]) + s * surface_.vertex(old[1]));
    surface_.triangles[t] = {old[0], v, old[2]};
    add({v, old[1], old[2]}, surface_.side[t]);
  }
  /// The same, with a flat triangle to fill the gap.
  void split_with_flat_triangle() {
    const Triangle& last = (split_on_one_side(), surface_.triangles.back());
    const Index v = last[0], b = last[1];
    const auto beside = std::find_if(surface_.triangles.begin(), surface_.triangles.end() - 1,
                                     [v](const Triangle& t) { return t[1] == v; });
    add({(*beside)[0], b, v}, surface_.side.back());
  }
  void double_triangle() {
    const std::size_t t = any_triangle();
    const Triangle& old = surface_.triangles[t];
    add({old[1], old[2], old[0]}, surface_.side[t]);
  }
  void turn_triangle() {
    Triangle& t = surface_.triangles[any_triangle()];
    std::swap(t[0], t[1]);
  }
  /// As STL: every triangle has its own vertices, shuffled, in single precision.
  void make_soup() {
    std::vector<std::size_t> order(surface_.triangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random_);
    TriangleSurface soup;
    soup.side_names = surface_.side_names;
    for (const std::size_t t : order) {
      const auto first = static_cast<Index>(soup.vertices.size());
      for (const Vec3& X : surface_.corners(static_cast<Index>(t)))
        soup.vertices.push_back({single(X.x), single(X.y), single(X.z)});
      soup.triangles.push_back({first, first + 1, first + 2});
      soup.side.push_back(surface_.side[t]);
    }
    surface_ = std::move(soup);
  }
  void remove_triangle() {
    const auto t = static_cast<std::ptrdiff_t>(any_triangle());
    surface_.triangles.erase(surface_.triangles.begin() + t);
    surface_.side.erase(surface_.side.begin() + t);
  }

  const TriangleSurface& surface() const { return surface_; }

 private:
  static double single(double x) { return static_cast<double>(static_cast<float>(x)); }
  std::size_t any_triangle() { return random_() % surface_.triangles.size(); }
  void add(const Triangle& t, Index side) {
    surface_.triangles.push_back(t);
    surface_.side.push_back(side);
  }

  TriangleSurface surface_;
  std::mt19937 random_;
};

std::vector<TriangleSurface> solids() {
  return {transformed(test::box_surface({0, 0, 0}, {3, 2, 1}), rotation({1, 2, 3}, 40), {7, -3, 2}),
          cylinder_surface(0.3, 2, 0.005), test::ball_surface(1, 12, 20), test::torus_surface(2, 0.5, 20, 12),
          test::spiky_surface(11, 14, 22, 0.2)};
}

TEST(SurfaceMend, ManySmallDefectsAreMended) {
  Index doubled = 0;
  for (const TriangleSurface& sound : solids())
    for (unsigned seed = 0; seed < 20; ++seed) {
      Vandal vandal(sound, seed);
      const Index defects = 1 + sound.size() / 40;
      for (Index i = 0; i < defects; ++i) {
        vandal.split_on_one_side();
        vandal.split_with_flat_triangle();
      }
      for (Index i = 0; i < defects; ++i) vandal.double_triangle();
      vandal.turn_triangle();
      vandal.make_soup();
      CheckedSurface checked;
      ASSERT_NO_THROW(checked = check_surface({"damaged", PlaceUnit::line, vandal.surface(), {}})) << seed;
      EXPECT_TRUE(test::is_closed(checked.surface));
      EXPECT_FALSE(find_wrong_meeting(checked.surface));
      EXPECT_TRUE(checked.repairs.any());
      EXPECT_GT(checked.repairs.split_triangles, 0);
      EXPECT_GT(checked.repairs.flat_triangles, 0);
      doubled += checked.repairs.doubled_triangles;  // those of flat ones count as flat
      EXPECT_NEAR(volume(checked.surface), volume(sound), 3 * checked.repairs.tolerance * area(sound));
      EXPECT_NEAR(area(checked.surface), area(sound), 1e-4 * area(sound));
    }
  EXPECT_GT(doubled, 500);
}

TEST(SurfaceMend, NoHoleIsOverlooked) {
  for (const TriangleSurface& sound : solids())
    for (unsigned seed = 0; seed < 10; ++seed) {
      Vandal vandal(sound, seed);
      vandal.split_on_one_side();
      vandal.remove_triangle();
      vandal.make_soup();
      EXPECT_THROW(check_surface({"damaged", PlaceUnit::line, vandal.surface(), {}}), GeometryError);
    }
}

TEST(SurfaceMend, MendingTwiceChangesNothing) {
  for (const TriangleSurface& sound : solids()) {
    Vandal vandal(sound, 5);
    for (int i = 0; i < 4; ++i) vandal.split_on_one_side();
    vandal.make_soup();
    const CheckedSurface once = check_surface({"damaged", PlaceUnit::line, vandal.surface(), {}});
    const CheckedSurface twice = check_surface({"mended", PlaceUnit::line, once.surface, {}});
    EXPECT_FALSE(twice.repairs.any());
    EXPECT_EQ(twice.surface.vertices, once.surface.vertices);
    EXPECT_EQ(twice.surface.triangles, once.surface.triangles);
  }
}

TEST(SurfaceMend, FarFromTheOriginTheSizeLimitsWelding) {
  // A cube of 1 m at 5000 km, as maps have them, in double precision.
  const TriangleSurface cube = test::box_surface({5e6, 5e6, 5e6}, {5e6 + 1, 5e6 + 1, 5e6 + 1});
  const CheckedSurface checked = check_surface({"map", PlaceUnit::line, cube, {}});
  EXPECT_FALSE(checked.repairs.any());
  EXPECT_DOUBLE_EQ(volume(checked.surface), 1);
}

}  // namespace
}  // namespace tessera
