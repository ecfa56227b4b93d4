#include "tessera/geometry/surface_primitives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/geometry/surface_transform.hpp"

namespace tessera {
namespace {

constexpr double kMostTriangles = 1e7;
constexpr Index kMantle = 2;  // its number among the sides "bottom", "top", "mantle"

void refuse_unless_positive(std::string_view what, double length) {
  if (!(length > 0) || !std::isfinite(length))
    throw GeometryError(fmt::format("the {} must be a positive length, not {} m", what, length));
}

void refuse_too_many(double triangles, double tolerance) {
  if (triangles > kMostTriangles)
    throw GeometryError(fmt::format("a tolerance of {} m takes {:.2g} triangles, more than {:.2g}: allow a larger one",
                                    tolerance, triangles, kMostTriangles));
}

/// The fewest chords of a circle, at least `least`, that stay within `tolerance` of it: r (1 - cos(pi / n)) is enough.
/// Above four a multiple of four, so that the circle reaches its extremes along both axes.
double chords(double radius, double tolerance, double least) {
  if (tolerance >= radius) return least;
  const double n = std::max(least, std::ceil(std::numbers::pi / std::acos(1 - tolerance / radius)));
  return n > 4 ? 4 * std::ceil(n / 4) : n;
}

Vec3 on_circle(double radius, Index i, Index n, double z) {
  const double angle = 2 * std::numbers::pi * i / n;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

void add(TriangleSurface& surface, const Triangle& triangle, Index side) {
  surface.triangles.push_back(triangle);
  surface.side.push_back(side);
}

/// A ring of n vertices, or the tip when the radius is zero; gives the first one's number.
Index add_ring(TriangleSurface& surface, double radius, Index n, double z) {
  const auto first = static_cast<Index>(surface.vertices.size());
  if (radius == 0)
    surface.vertices.push_back({0, 0, z});
  else
    for (Index i = 0; i < n; ++i) surface.vertices.push_back(on_circle(radius, i, n, z));
  return first;
}

/// The icosahedron's corners on the unit sphere and its faces.
struct Icosahedron {
  std::array<Vec3, 12> corners;
  std::array<Triangle, 20> faces{{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

  Icosahedron() {
    const double t = std::numbers::phi;
    corners = {{{-1, t, 0},
                {1, t, 0},
                {-1, -t, 0},
                {1, -t, 0},
                {0, -1, t},
                {0, 1, t},
                {0, -1, -t},
                {0, 1, -t},
                {t, 0, -1},
                {t, 0, 1},
                {-t, 0, -1},
                {-t, 0, 1}}};
    for (Vec3& X : corners) X = normalized(X);
  }
};

/// The unit sphere: every edge of an icosahedron divided into n.
TriangleSurface unit_sphere(Index n) {
  const Icosahedron ico;
  TriangleSurface sphere;
  sphere.side_names = {"mantle"};
  // A vertex by how many parts it has of each corner; those that are zero left out, so that faces share edges.
  std::map<std::array<std::pair<Index, Index>, 3>, Index> numbers;
  const auto vertex = [&](const Triangle& face, const std::array<Index, 3>& parts) {
    std::array<std::pair<Index, Index>, 3> key{};
    for (std::size_t i = 0; i < 3; ++i) key[i] = parts[i] > 0 ? std::pair{face[i], parts[i]} : std::pair{-1, 0};
    std::sort(key.begin(), key.end());
    const auto [entry, is_new] = numbers.try_emplace(key, static_cast<Index>(sphere.vertices.size()));
    if (is_new) {
      Vec3 X;
      for (const auto& [corner, part] : key)
        if (part > 0) X += static_cast<double>(part) * ico.corners[static_cast<std::size_t>(corner)];
      sphere.vertices.push_back(normalized(X));
    }
    return entry->second;
  };
  for (const Triangle& face : ico.faces)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n - i; ++j) {
        const Index k = n - i - j;
        const Index a = vertex(face, {k, i, j}), b = vertex(face, {k - 1, i + 1, j}),
                    c = vertex(face, {k - 1, i, j + 1});
        add(sphere, {a, b, c}, 0);
        if (k > 1) add(sphere, {b, vertex(face, {k - 2, i + 1, j + 1}), c}, 0);
      }
  return sphere;
}

/// How far a triangle with corners on the unit sphere goes away from it: at its circumcentre, which lies within these
/// nearly equilateral ones.
double depth(const TriangleSurface& sphere) {
  double deepest = 0.0;
  for (Index t = 0; t < sphere.size(); ++t)
    deepest = std::max(deepest, 1 - std::abs(dot(sphere.corners(t)[0], normalized(area_vector(sphere, t)))));
  return deepest;
}

TriangleSurface unit_sphere_within(double tolerance, double tolerance_in_metres) {
  // The largest triangles are those in the middle of the icosahedron's faces: depth 0.292 / n^2 for many of them.
  const double about = std::max(1.0, std::floor(0.95 * std::sqrt(0.292 / tolerance)));
  refuse_too_many(20 * about * about, tolerance_in_metres);
  for (auto n = static_cast<Index>(about);; ++n) {
    TriangleSurface sphere = unit_sphere(n);
    if (depth(sphere) <= tolerance) return sphere;
  }
}

}  // namespace

TriangleSurface cone_surface(double bottom_radius, double top_radius, double height, double tolerance) {
  if (bottom_radius != 0) refuse_unless_positive("bottom radius", bottom_radius);
  if (bottom_radius == 0 || top_radius != 0) refuse_unless_positive("top radius", top_radius);
  refuse_unless_positive("height", height);
  refuse_unless_positive("tolerance", tolerance);
  const double sectors = chords(std::max(bottom_radius, top_radius), tolerance, 3);
  refuse_too_many(4 * sectors, tolerance);
  const auto n = static_cast<Index>(sectors);

  TriangleSurface cone;
  cone.side_names = {"bottom", "top", "mantle"};
  const Index bottom = add_ring(cone, bottom_radius, n, 0.0), top = add_ring(cone, top_radius, n, height);
  const auto low = [&](Index i) { return bottom_radius == 0 ? bottom : bottom + i % n; };
  const auto high = [&](Index i) { return top_radius == 0 ? top : top + i % n; };
  for (Index i = 0; i < n; ++i) {
    if (bottom_radius != 0) add(cone, {low(i), low(i + 1), high(i + 1)}, kMantle);
    if (top_radius != 0) add(cone, {low(i), high(i + 1), high(i)}, kMantle);
  }
  const auto add_lid = [&](double z, Index side, auto&& ring) {
    const Index center = add_ring(cone, 0.0, n, z);
    for (Index i = 0; i < n; ++i)
      add(cone, side == 0 ? Triangle{center, ring(i + 1), ring(i)} : Triangle{center, ring(i), ring(i + 1)}, side);
  };
  if (bottom_radius != 0) add_lid(0.0, 0, low);
  if (top_radius != 0) add_lid(height, 1, high);
  remove_unused_sides(cone);
  return cone;
}

TriangleSurface cone_surface(const Vec3& from, const Vec3& to, double bottom_radius, double top_radius,
                             double tolerance) {
  const double height = norm(to - from);
  TriangleSurface cone = cone_surface(bottom_radius, top_radius, height, tolerance);
  const Mat3 frame = frame_along(to - from);
  for (Vec3& X : cone.vertices) X = (X.z == 0 ? from : to) + frame * Vec3{X.x, X.y, 0};
  return cone;
}

TriangleSurface cylinder_surface(double radius, double height, double tolerance) {
  refuse_unless_positive("radius", radius);
  return cone_surface(radius, radius, height, tolerance);
}

TriangleSurface ellipsoid_surface(const Vec3& semi_axes, double tolerance) {
  for (int d = 0; d < 3; ++d) refuse_unless_positive("semi-axis", semi_axes[d]);
  refuse_unless_positive("tolerance", tolerance);
  // Stretching the unit sphere stretches distances by the longest semi-axis at most.
  const double longest = std::max({semi_axes.x, semi_axes.y, semi_axes.z});
  TriangleSurface surface = unit_sphere_within(tolerance / longest, tolerance);
  return transformed(std::move(surface), diagonal(semi_axes.x, semi_axes.y, semi_axes.z), {});
}

TriangleSurface sphere_surface(double radius, double tolerance) {
  refuse_unless_positive("radius", radius);
  return ellipsoid_surface({radius, radius, radius}, tolerance);
}

TriangleSurface torus_surface(double radius, double tube_radius, double tolerance) {
  refuse_unless_positive("radius", radius);
  refuse_unless_positive("tube radius", tube_radius);
  refuse_unless_positive("tolerance", tolerance);
  if (tube_radius >= radius)
    throw GeometryError(fmt::format("the tube radius {} m must be smaller than the radius {} m", tube_radius, radius));
  // The chords around and along the tube each take half of the tolerance.
  const double around = chords(radius + tube_radius, tolerance / 2, 4), along = chords(tube_radius, tolerance / 2, 4);
  refuse_too_many(2 * around * along, tolerance);
  const auto n = static_cast<Index>(around), m = static_cast<Index>(along);

  TriangleSurface torus;
  torus.side_names = {"mantle"};
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < m; ++j) {
      const Vec3 tube = on_circle(tube_radius, j, m, 0.0);
      torus.vertices.push_back(on_circle(radius + tube.x, i, n, tube.y));
    }
  const auto number = [=](Index i, Index j) { return (i % n) * m + j % m; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < m; ++j) {
      add(torus, {number(i, j), number(i + 1, j), number(i + 1, j + 1)}, 0);
      add(torus, {number(i, j), number(i + 1, j + 1), number(i, j + 1)}, 0);
    }
  return torus;
}

}  // namespace tessera
