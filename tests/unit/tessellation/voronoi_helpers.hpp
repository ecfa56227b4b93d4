#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../geometry/shapes.hpp"
#include "tessera/base/mat3.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera::test {

struct SolidCase {
  std::string name;
  Shape shape;
  double spacing;
};

/// The last polygon bulges, so that the jitter of a lattice inside cannot leave it.
inline Shape hole() { return difference_of({box({0, 0, 0}, {1, 1, 1}), box({0.3, 0.3, -1}, {0.6, 0.7, 2}, "hole")}); }
inline Shape cavity() { return difference_of({box({0, 0, 0}, {1, 1, 1}), box({0.3, 0.3, 0.4}, {0.6, 0.7, 0.6})}); }
inline Shape star() { return polygon({{0, 0}, {4, 0.3}, {5, 3}, {3, 1.5}, {2.5, 4}, {1, 1.2}, {-1, 3}}, 1.1, -0.5); }

inline std::vector<Vec3> points_of(const ParticleSpec& spec, const Solid& solid) {
  return place_particles(spec, solid, Placement::cell_centres).points;
}

/// Points of a jittered lattice that are inside: unlike place_particles, leaves out those that jitter moves outside.
inline std::vector<Vec3> points_inside(const Solid& solid, double spacing, double jitter, std::uint64_t seed) {
  const Vec3 margin{spacing, spacing, spacing};
  const Solid around = build_solid(box(solid.lower - margin, solid.upper + margin));
  std::vector<Vec3> points = points_of(lattice(spacing, jitter, seed), around);
  std::erase_if(points, [&](const Vec3& X) { return !solid.contains(X, -1e-6 * spacing); });
  return points;
}

/// The largest violations of the identities that closed cells obey, over all cells.
struct Residuals {
  double closure = 0.0;       // |sum A| / sum |A|
  double volume = 0.0;        // |sum C.A / 3 - V| / V
  double first_moment = 0.0;  // largest component of |sum C (x) A - V I| / V
  double total = 0.0;         // |sum V - volume of the solid| / volume of the solid
  std::vector<int> faces;     // per cell
};

inline Residuals residuals(const Cells& cells, const std::vector<Vec3>& points, const Solid& solid) {
  const std::size_t n = points.size();
  std::vector<Vec3> area(n);
  std::vector<double> surface(n, 0.0);
  std::vector<Mat3> moment(n);
  Residuals r;
  r.faces.assign(n, 0);
  const auto add = [&](Index cell, const Vec3& A, const Vec3& C) {
    const auto a = static_cast<std::size_t>(cell);
    area[a] += A;
    surface[a] += norm(A);
    moment[a] += outer(C - points[a], A);
    ++r.faces[a];
  };
  for (const InteriorFace& f : cells.interior) add(f.a, f.area, f.centroid), add(f.b, -f.area, f.centroid);
  for (const BoundaryFace& f : cells.boundary) add(f.owner, f.area, f.centroid);
  long double total = 0.0;
  for (std::size_t a = 0; a < n; ++a) {
    const double V = cells.volume[a];
    total += static_cast<long double>(V);
    r.closure = std::max(r.closure, norm(area[a]) / surface[a]);
    r.volume = std::max(r.volume, std::abs(trace(moment[a]) / 3.0 - V) / V);
    for (const double m : (moment[a] - V * identity()).m) r.first_moment = std::max(r.first_moment, std::abs(m) / V);
  }
  r.total = static_cast<double>(std::abs(total - static_cast<long double>(solid.volume))) / solid.volume;
  return r;
}

/// `noise` is what the faces of a set may be off by, relative to the surface, because of coincidences within round-off.
inline void expect_closed(const Cells& cells, const std::vector<Vec3>& points, const Solid& solid, double noise = 0.0) {
  const Residuals r = residuals(cells, points, solid);
  EXPECT_LE(r.closure, 1e-14 + noise);
  EXPECT_LE(r.volume, 1e-14);
  EXPECT_LE(r.first_moment, 1e-13 + 10 * noise);
  EXPECT_LE(r.total, 1e-13);
}

}  // namespace tessera::test
