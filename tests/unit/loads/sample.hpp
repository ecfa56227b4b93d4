#pragma once

#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "tessera/loads/loads.hpp"

namespace tessera::test {

/// An entry as the reader makes it; `line` stands for its place in the case file.
inline BoundaryCondition entry(int line, std::vector<std::string> where, decltype(BoundaryCondition::kind) kind) {
  BoundaryCondition c;
  c.origin = {"case.toml", line, 1, "boundary"};
  c.where = {std::move(where), {"case.toml", line, 9, "where"}};
  c.kind = std::move(kind);
  return c;
}

inline std::optional<Formula> formula(const std::string& text) { return Formula(text, {"case.toml", 1, 1, "formula"}); }

inline std::vector<const BoundaryCondition*> pointers(const std::vector<BoundaryCondition>& conditions) {
  std::vector<const BoundaryCondition*> list;
  for (const BoundaryCondition& c : conditions) list.push_back(&c);
  return list;
}

/// The surface of a voronoi body in a solid.
inline Surface surface_of(const Solid& solid, const Cells& cells) {
  Surface s;
  s.body = "block";
  s.lower = solid.lower;
  s.upper = solid.upper;
  s.known_names = side_names(solid);
  for (const Side& side : solid.sides) s.side_names.push_back(side.names);
  for (const BoundaryFace& f : cells.boundary) s.pieces.push_back({f.centroid, normalized(f.area), f.side, {}});
  return s;
}

/// The surface of a delaunay body in a solid.
inline Surface surface_of(const Solid& solid, const TetrahedralMesh& mesh) {
  Surface s;
  s.body = "block";
  s.lower = solid.lower;
  s.upper = solid.upper;
  s.known_names = side_names(solid);
  s.side_names = mesh.side_names;
  for (const BoundaryTriangle& t : mesh.boundary) {
    std::array<Vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = mesh.points[static_cast<std::size_t>(t.vertices[i])];
    s.pieces.push_back({(1.0 / 3.0) * (x[0] + x[1] + x[2]),
                        normalized(cross(x[1] - x[0], x[2] - x[0])),
                        t.side,
                        {t.vertices.begin(), t.vertices.end()}});
  }
  return s;
}

/// Two oblique sides "one" and "two" that meet at the particles 0 and 1.
struct Wedge {
  Surface surface;
  std::vector<Vec3> X{{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
  Vec3 N1 = normalized(Vec3{1, 0.2, 0.1}), N2 = normalized(Vec3{0.3, 1, -0.2});

  Wedge() {
    surface.body = "wedge";
    surface.side_names = {{"one"}, {"two"}};
    surface.known_names = {"one", "two"};
    surface.upper = {1, 1, 1};
    surface.pieces = {{{}, N1, 0, {0, 1, 2}}, {{}, N2, 1, {0, 1, 3}}};
  }
};

/// What an InputError says; empty when `action` throws none.
template <class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace tessera::test
