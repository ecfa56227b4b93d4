#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "tessera/geometry/triangle_surface.hpp"

namespace tessera::test {

/// Gives every triangle the side 0, called "all".
inline TriangleSurface with_one_side(TriangleSurface surface) {
  surface.side.assign(surface.triangles.size(), 0);
  surface.side_names = {"all"};
  return surface;
}

/// An axis-parallel box of twelve triangles with the sides "-x", "+x", ... "+z".
inline TriangleSurface box_surface(const Vec3& lower, const Vec3& upper) {
  TriangleSurface box;
  for (int i = 0; i < 8; ++i)
    box.vertices.push_back({(i & 1) ? upper.x : lower.x, (i & 2) ? upper.y : lower.y, (i & 4) ? upper.z : lower.z});
  box.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  box.side = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
  box.side_names = {"-x", "+x", "-y", "+y", "-z", "+z"};
  return box;
}

/// Vertices (r cos, r sin, z) in rings from the lowest to the highest, closed by two poles.
template <class Radius>
TriangleSurface star_surface(int rings, int sectors, Radius radius) {
  TriangleSurface star;
  const auto place = [&](int i, int j) {
    const double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * j / sectors;
    const double r = radius(i, j);
    return Vec3{r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), -r * std::cos(theta)};
  };
  star.vertices.push_back(place(0, 0));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) star.vertices.push_back(place(i, j));
  star.vertices.push_back(place(rings, 0));
  star.vertices.front().x = star.vertices.front().y = star.vertices.back().x = star.vertices.back().y = 0;
  const auto number = [&](int i, int j) {
    if (i == 0) return Index{0};
    return i == rings ? static_cast<Index>(star.vertices.size()) - 1
                      : static_cast<Index>(1 + (i - 1) * sectors + j % sectors);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      if (i > 0) star.triangles.push_back({number(i, j), number(i, j + 1), number(i + 1, j)});
      if (i + 1 < rings) star.triangles.push_back({number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)});
    }
  return with_one_side(std::move(star));
}

/// A ball with vertices on the sphere around the origin.
inline TriangleSurface ball_surface(double radius, int rings, int sectors) {
  return star_surface(rings, sectors, [radius](int, int) { return radius; });
}

/// A star with a random radius at every vertex: spikes, valleys, thin needles.
inline TriangleSurface spiky_surface(unsigned seed, int rings, int sectors, double least_radius) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(least_radius, 1.0);
  return star_surface(rings, sectors, [&](int, int) { return any(random); });
}

/// A torus around the z axis.
inline TriangleSurface torus_surface(double radius, double tube_radius, int around, int along_tube) {
  TriangleSurface torus;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along_tube; ++j) {
      const double phi = 2 * std::numbers::pi * i / around, psi = 2 * std::numbers::pi * j / along_tube;
      const double r = radius + tube_radius * std::cos(psi);
      torus.vertices.push_back({r * std::cos(phi), r * std::sin(phi), tube_radius * std::sin(psi)});
    }
  const auto number = [=](int i, int j) { return static_cast<Index>((i % around) * along_tube + j % along_tube); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along_tube; ++j) {
      torus.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      torus.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return with_one_side(std::move(torus));
}

/// Every edge, run along as often as against: is the surface closed and oriented?
inline bool is_closed(const TriangleSurface& surface) {
  std::map<std::pair<Index, Index>, int> balance;
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  for (const auto& [edge, sum] : balance)
    if (sum != 0) return false;
  return true;
}

}  // namespace tessera::test
