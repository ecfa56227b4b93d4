#include "tessera/tessellation/voronoi_convex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <voro++/voro++.hh>
#pragma GCC diagnostic pop

namespace tessera {
namespace {

constexpr double kParticlesPerBlock = 5.0;  // the optimum that voro++'s authors give
constexpr double kMostBlocksPerParticle = 8.0;

/// voro++ works in units of our choice but with a fixed tolerance: a vertex is on the bisector of points r apart when
/// (height * r) is below 1e-11. So the unit of length decides what the tolerance is in metres. A power of two leaves
/// the coordinates' digits as they are.
double units_per_metre(double tolerance, double spacing) {
  return std::exp2(std::floor(std::log2(std::sqrt(voro::tolerance / (tolerance * spacing)))));
}

struct Box {
  Vec3 lower, upper;
  std::array<int, 3> blocks{};
};

/// The solid's bounding box, enlarged so that no face of it is a face of a cell in the solid, and its search grid.
Box enlarged_box(const Solid& solid, double spacing, std::size_t particles) {
  const Vec3 margin{spacing, spacing, spacing};
  Box box{solid.lower - margin, solid.upper + margin, {}};
  const Vec3 size = box.upper - box.lower;
  const double block =
      std::max(std::cbrt(kParticlesPerBlock) * spacing,
               std::cbrt(size.x * size.y * size.z / (kMostBlocksPerParticle * static_cast<double>(particles))));
  for (int d = 0; d < 3; ++d)
    box.blocks[static_cast<std::size_t>(d)] = std::max(1, static_cast<int>(std::ceil(size[d] / block)));
  return box;
}

}  // namespace

struct ConvexVoronoi::Impl {
  Impl(std::span<const Vec3> all_points, const Box& box, double scale)
      : points(all_points),
        metre(1.0 / scale),
        container(scale * box.lower.x, scale * box.upper.x, scale * box.lower.y, scale * box.upper.y,
                  scale * box.lower.z, scale * box.upper.z, box.blocks[0], box.blocks[1], box.blocks[2], false, false,
                  false, 8),
        order(static_cast<int>(all_points.size()) + 1) {
    for (std::size_t p = 0; p < points.size(); ++p)
      container.put(order, static_cast<int>(p), scale * points[p].x, scale * points[p].y, scale * points[p].z);
  }

  std::span<const Vec3> points;
  double metre;
  voro::container container;
  voro::particle_order order;  // block and slot of every particle
  voro::voronoicell_neighbor cell;
  std::vector<double> vertices;
  std::vector<int> faces;
  std::vector<int> neighbours;
};

ConvexVoronoi::ConvexVoronoi(std::span<const Vec3> points, const Solid& solid, double tolerance) {
  const double spacing = std::cbrt(solid.volume / static_cast<double>(points.size()));
  const Box box = enlarged_box(solid, spacing, points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (!(points[p][d] >= solid.lower[d] && points[p][d] <= solid.upper[d]))
        throw GeometryError(fmt::format("particle {} at ({:g}, {:g}, {:g}) m lies outside the solid", p, points[p].x,
                                        points[p].y, points[p].z));
  impl_ = std::make_unique<Impl>(points, box, units_per_metre(tolerance, spacing));
}

ConvexVoronoi::~ConvexVoronoi() = default;

void ConvexVoronoi::compute(Index particle, ConvexPolyhedron& cell) {
  Impl& v = *impl_;
  cell.clear();
  const int* const place = v.order.o + 2 * particle;
  if (!v.container.compute_cell(v.cell, place[0], place[1])) return;
  v.cell.vertices(v.vertices);  // relative to the particle
  v.cell.face_vertices(v.faces);
  v.cell.neighbors(v.neighbours);
  const Vec3& X = v.points[static_cast<std::size_t>(particle)];
  for (std::size_t i = 0; i < v.vertices.size(); i += 3)
    cell.vertices.push_back(X + v.metre * Vec3{v.vertices[i], v.vertices[i + 1], v.vertices[i + 2]});
  std::size_t at = 0;
  for (const int neighbour : v.neighbours) {
    const auto count = static_cast<std::size_t>(v.faces[at++]);
    at += count;
    for (std::size_t i = 1; i <= count; ++i) cell.corners.push_back(v.faces[at - i]);  // voro++ lists them clockwise
    cell.close_face(neighbour >= 0 ? neighbour : kBoxTag);
  }
}

}  // namespace tessera
