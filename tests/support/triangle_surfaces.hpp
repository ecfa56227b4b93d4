#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "support/surfaces.hpp"

namespace tessera::test {

/// The boundary of a set of cells of a rectilinear grid, two triangles a rectangle; sides by direction.
inline TriangleSurface grid_surface(const std::array<std::vector<double>, 3>& planes,
                                    const std::function<bool(int, int, int)>& is_in) {
  TriangleSurface surface;
  surface.side_names = {"-x", "+x", "-y", "+y", "-z", "+z"};
  std::map<std::array<int, 3>, Index> number;
  const auto count = [&](std::size_t d) { return static_cast<int>(planes[d].size()) - 1; };
  const auto inside = [&](const std::array<int, 3>& c) {
    for (std::size_t d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] >= count(d)) return false;
    return is_in(c[0], c[1], c[2]);
  };
  const auto vertex = [&](const std::array<int, 3>& v) {
    const auto [it, is_new] = number.try_emplace(v, static_cast<Index>(surface.vertices.size()));
    const auto at = [&](std::size_t d) { return planes[d][static_cast<std::size_t>(v[d])]; };
    if (is_new) surface.vertices.push_back({at(0), at(1), at(2)});
    return it->second;
  };
  for (int i = 0; i < count(0); ++i)
    for (int j = 0; j < count(1); ++j)
      for (int k = 0; k < count(2); ++k)
        for (std::size_t d = 0; d < 3; ++d)
          for (const int step : {-1, 1}) {
            const std::array<int, 3> cell{i, j, k};
            std::array<int, 3> next = cell;
            next[d] += step;
            if (!inside(cell) || inside(next)) continue;
            std::array<int, 3> v = cell;
            if (step > 0) ++v[d];
            const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
            std::array<Index, 4> quad{};
            quad[0] = vertex(v);
            ++v[step > 0 ? e : f];
            quad[1] = vertex(v);
            ++v[step > 0 ? f : e];
            quad[2] = vertex(v);
            --v[step > 0 ? e : f];
            quad[3] = vertex(v);
            surface.triangles.push_back({quad[0], quad[1], quad[2]});
            surface.triangles.push_back({quad[0], quad[2], quad[3]});
            for (int t = 0; t < 2; ++t) surface.side.push_back(static_cast<Index>(2 * d) + (step > 0 ? 1 : 0));
          }
  return surface;
}

/// A ring around the z axis between heights 0 and `height`, whose outer radius has `teeth`.
inline TriangleSurface gear_surface(int teeth, double inner, double root, double tip, double height) {
  TriangleSurface surface;
  surface.side_names = {"bore", "teeth", "bottom", "top"};
  const int n = 4 * teeth;
  for (int i = 0; i < n; ++i) {
    const double phi = 2.0 * std::numbers::pi * i / n, outer = i % 4 < 2 ? tip : root;
    for (const double r : {inner, outer})
      for (const double z : {0.0, height}) surface.vertices.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  const auto quad = [&](Index a, Index b, Index c, Index d, Index side) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
    surface.side.push_back(side);
    surface.side.push_back(side);
  };
  for (int i = 0; i < n; ++i) {
    const Index a = 4 * i, b = 4 * ((i + 1) % n);  // + 0: inner bottom, 1: inner top, 2: outer bottom, 3: outer top
    quad(b, a, a + 1, b + 1, 0);
    quad(a + 2, b + 2, b + 3, a + 3, 1);
    quad(a, b, b + 2, a + 2, 2);
    quad(a + 1, a + 3, b + 3, b + 1, 3);
  }
  return surface;
}

/// Every point turned about an oblique axis and moved.
inline TriangleSurface turned(TriangleSurface surface, double angle, const Vec3& move = {}) {
  const Vec3 axis = normalized({1.0, 2.0, 3.0});
  for (Vec3& X : surface.vertices)
    X = move + std::cos(angle) * X + std::sin(angle) * cross(axis, X) + (1.0 - std::cos(angle)) * dot(axis, X) * axis;
  return surface;
}

}  // namespace tessera::test
