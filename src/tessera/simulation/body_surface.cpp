#include "tessera/simulation/body_surface.hpp"

#include <algorithm>
#include <set>

#include "tessera/geometry/solid_surface.hpp"
#include "tessera/geometry/surface_sides.hpp"

namespace tessera {

namespace {

std::vector<std::string> sorted_names(const std::vector<std::vector<std::string>>& sides) {
  std::set<std::string> names;
  for (const auto& side : sides) names.insert(side.begin(), side.end());
  return {names.begin(), names.end()};
}

}  // namespace

Surface surface_of_body(const BodySpec& body, const Solid& solid, const Cells& cells) {
  Surface s;
  s.body = body.name;
  s.lower = solid.lower;
  s.upper = solid.upper;
  for (const Side& side : solid.sides) s.side_names.push_back(side.names);
  s.known_names = side_names(solid);
  for (const BoundaryFace& f : cells.boundary) s.pieces.push_back({f.centroid, normalized(f.area), f.side, {}});
  return s;
}

Surface surface_of_body(const BodySpec& body, const ShapeSurface& shape, const Cells& cells) {
  Surface s;
  s.body = body.name;
  const Bounds box = bounds(shape.surface);
  s.lower = box.lower;
  s.upper = box.upper;
  for (const std::string& side : shape.surface.side_names) s.side_names.push_back(shape.names.at(side));
  s.known_names = sorted_names(s.side_names);
  for (const BoundaryFace& f : cells.boundary) s.pieces.push_back({f.centroid, normalized(f.area), f.side, {}});
  return s;
}

Surface surface_of_body(const BodySpec& body, const TetrahedralMesh& mesh) {
  Surface s;
  s.body = body.name;
  s.side_names = mesh.side_names;
  s.known_names = sorted_names(mesh.side_names);
  s.lower = s.upper = mesh.points.front();
  for (const Vec3& X : mesh.points)
    for (int i = 0; i < 3; ++i) {
      s.lower[i] = std::min(s.lower[i], X[i]);
      s.upper[i] = std::max(s.upper[i], X[i]);
    }
  for (const BoundaryTriangle& t : mesh.boundary) {
    const Vec3 &a = mesh.points[static_cast<std::size_t>(t.vertices[0])],
               &b = mesh.points[static_cast<std::size_t>(t.vertices[1])],
               &c = mesh.points[static_cast<std::size_t>(t.vertices[2])];
    s.pieces.push_back({(1.0 / 3.0) * (a + b + c),
                        normalized(cross(b - a, c - a)),
                        t.side,
                        {t.vertices[0], t.vertices[1], t.vertices[2]}});
  }
  return s;
}

TriangleSurface outline_of(const TetrahedralMesh& mesh) {
  TriangleSurface surface{mesh.points, {}, {}, {}};
  for (const auto& names : mesh.side_names) surface.side_names.push_back(names[0]);
  for (const BoundaryTriangle& t : mesh.boundary) {
    surface.triangles.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
    surface.side.push_back(t.side);
  }
  return surface;
}

}  // namespace tessera
