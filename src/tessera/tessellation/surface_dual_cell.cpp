#include "tessera/tessellation/surface_dual_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/error.hpp"
#include "tessera/geometry/bounds.hpp"
#include "tessera/geometry/predicates.hpp"
#include "tessera/tessellation/surface_circumcenter.hpp"

namespace tessera {
namespace {

constexpr std::size_t kFar = 4;  // generators that form the tetrahedron around all others

Bounds box_of(std::span<const Vec3> points) {
  Bounds box;
  for (const Vec3& X : points) box.include(X);
  return box;
}

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& X : points) largest = std::max({largest, std::abs(X.x), std::abs(X.y), std::abs(X.z)});
  return largest;
}

}  // namespace

PointGrid grid_of(std::span<const Vec3> generators, double spacing) {
  const std::span<const Vec3> near = generators.first(generators.size() - kFar);
  const Bounds box = box_of(near);
  return {near, box.lower, box.upper, spacing};
}

DualCellCutter::DualCellCutter(Generators generators, const PointGrid& grid)
    : generators_(generators),
      magnitude_(largest_coordinate(generators.points().first(generators.size() - kFar))),
      nearest_(grid) {}

const DualCell& DualCellCutter::cut(Index particle) {
  start(particle);
  double reach = generators_.reach(particle, farthest());
  for (std::size_t rank = 0;; ++rank) {
    const Index neighbour = nearest_.neighbour(rank, reach);
    if (neighbour < 0) break;
    if (clip(neighbour)) reach = generators_.reach(particle, farthest());
  }
  finish();
  return cell_;
}

void DualCellCutter::start(Index particle) {
  particle_ = particle;
  nearest_.start(particle, at(particle));
  faces_.clear();
  vertices_.clear();
  const auto first = static_cast<Index>(generators_.size() - kFar);
  for (Index g = 0; g < static_cast<Index>(kFar); ++g) add_face(first + g);
  const bool is_positive = orient3d(at(first), at(first + 1), at(first + 2), at(first + 3)) > 0;
  // The corner opposite to face l is where i, j, k meet; they run counter-clockwise seen from outside.
  for (Index l = 0; l < 4; ++l) {
    const Index i = (l + 1) % 4, j = (l + 2) % 4, k = (l + 3) % 4;
    if ((l % 2 == 0) == is_positive)
      add_vertex(i, j, k);
    else
      add_vertex(i, k, j);
  }
}

void DualCellCutter::add_face(Index neighbour) {
  const Vec3 branch = at(neighbour) - at(particle_);
  const double length = norm(branch);
  if (length <= 64.0 * std::numeric_limits<double>::epsilon() * magnitude_) {
    throw GeometryError(fmt::format("particles {} and {} coincide; leave one of them out", generators_.named(particle_),
                                    generators_.named(neighbour)));
  }
  const double distance = generators_.distance(particle_, neighbour, length);
  if (distance < kLeastShare * length) refuse_swallowed(generators_, particle_, neighbour);
  faces_.push_back({neighbour, branch / length, distance});
}

void DualCellCutter::add_vertex(Index i, Index j, Index k) {
  const auto generator = [&](Index f) { return faces_[static_cast<std::size_t>(f)].neighbour; };
  Vertex vertex{{i, j, k}, {particle_, generator(i), generator(j), generator(k)}, {}, {}, 0.0, 0.0};
  std::sort(vertex.name.begin(), vertex.name.end());
  const Circumcenter center = circumcenter(generators_, vertex.name);
  vertex.X = center.X;
  vertex.x = center.X - at(particle_);
  vertex.distance = norm(vertex.x);
  vertex.error = center.condition * 1e-14 * (vertex.distance + magnitude_);
  vertices_.push_back(vertex);
}

/// Is the vertex nearer to the face's generator than to its own?
bool DualCellCutter::is_cut_off(const Vertex& vertex, const Face& face) const {
  const double height = dot(face.normal, vertex.x) - face.offset;
  if (height > vertex.error) return true;
  if (height < -vertex.error) return false;
  return conflicts(vertex.name, face.neighbour);
}

/// Where `other` is to the sphere through the generators of a corner, or with weights to the one orthogonal to theirs:
/// the sign of side_of_sphere().
int DualCellCutter::side_of_sphere_through(const DualCell::Name& name, Index other) const {
  const auto point = [&](std::size_t i) { return at(name[i]); };
  if (!generators_.has_weights()) return side_of_sphere(point(0), point(1), point(2), point(3), at(other));
  const auto weighted = [&](Index g) { return WeightedPoint{at(g), generators_.weight(g)}; };
  return side_of_power_sphere(weighted(name[0]), weighted(name[1]), weighted(name[2]), weighted(name[3]),
                              weighted(other));
}

/// Is `other` in the sphere through the generators of a corner? If it is on it, the tiny weights decide: the higher a
/// generator's number, the larger they lift it off the paraboloid over which Voronoi cells are the lower hull, each
/// by far more than the one before. H. Edelsbrunner, E. P. Muecke, Simulation of simplicity, ACM Trans. Graph. 9, 1990.
bool DualCellCutter::conflicts(const DualCell::Name& name, Index other) const {
  std::array<Vec3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = at(name[i]);
  const int orientation = orient3d(p[0], p[1], p[2], p[3]);
  if (orientation == 0) return false;
  const int side = orientation * side_of_sphere_through(name, other);
  if (side != 0) return side > 0;
  for (std::size_t i = 4; i-- > 0;) {
    if (other > name[i]) return false;
    std::array<Vec3, 4> q = p;
    q[i] = at(other);
    const int share = orientation * orient3d(q[0], q[1], q[2], q[3]);
    if (share != 0) return share > 0;
  }
  return false;
}

/// Cuts by the bisector to `neighbour`; did it cut anything off? The corners that go form one patch of the surface;
/// around its rim new corners take their place.
bool DualCellCutter::clip(Index neighbour) {
  add_face(neighbour);
  const Face face = faces_.back();
  const auto is_kept = [&](const Vertex& vertex) { return !is_cut_off(vertex, face); };
  const auto kept_end = std::partition(vertices_.begin(), vertices_.end(), is_kept);
  if (kept_end == vertices_.end()) {
    faces_.pop_back();
    return false;
  }
  removed_.assign(kept_end, vertices_.end());
  vertices_.erase(kept_end, vertices_.end());
  edges_.clear();
  for (const Vertex& vertex : removed_)
    for (std::size_t e = 0; e < 3; ++e) {
      const Edge edge{vertex.faces[e], vertex.faces[(e + 1) % 3]};
      const auto twin = std::find_if(edges_.begin(), edges_.end(),
                                     [&](const Edge& other) { return other.from == edge.to && other.to == edge.from; });
      if (twin == edges_.end()) {
        edges_.push_back(edge);
      } else {
        *twin = edges_.back();
        edges_.pop_back();
      }
    }
  const auto added = static_cast<Index>(faces_.size()) - 1;
  for (const Edge& edge : edges_) add_vertex(edge.from, edge.to, added);
  return true;
}

double DualCellCutter::farthest() const {
  double largest = 0.0;
  for (const Vertex& vertex : vertices_) largest = std::max(largest, vertex.distance);
  return (1.0 + 1e-9) * largest;
}

/// Drops faces that were cut off and walks around the others.
void DualCellCutter::finish() {
  const std::size_t n = faces_.size();
  new_face_.assign(n, -1);
  for (const Vertex& vertex : vertices_)
    for (const Index f : vertex.faces) new_face_[static_cast<std::size_t>(f)] = 0;
  cell_.particle = particle_;
  cell_.neighbours.clear();
  for (std::size_t f = 0; f < n; ++f)
    if (new_face_[f] == 0) {
      new_face_[f] = cell_.faces();
      cell_.neighbours.push_back(faces_[f].neighbour);
    }
  cell_.corners.clear();
  const auto m = cell_.neighbours.size();
  next_.assign(m * m, -1);  // the corner of face f behind its edge with face g
  for (const Vertex& vertex : vertices_) {
    DualCell::Corner corner{{}, vertex.name, vertex.X};
    for (std::size_t i = 0; i < 3; ++i) corner.faces[i] = new_face_[static_cast<std::size_t>(vertex.faces[i])];
    for (std::size_t i = 0; i < 3; ++i)
      next_[static_cast<std::size_t>(corner.faces[i]) * m + static_cast<std::size_t>(corner.faces[(i + 1) % 3])] =
          static_cast<Index>(cell_.corners.size());
    cell_.corners.push_back(corner);
  }
  cell_.begin.assign(1, 0);
  cell_.loops.clear();
  for (std::size_t f = 0; f < m; ++f) {
    Index first = -1;
    for (std::size_t c = 0; c < cell_.corners.size(); ++c) {
      const auto& corner = cell_.corners[c];
      if (std::find(corner.faces.begin(), corner.faces.end(), static_cast<Index>(f)) == corner.faces.end()) continue;
      if (first < 0 || corner.name < cell_.corner(first).name) first = static_cast<Index>(c);
    }
    Index c = first;
    do {
      cell_.loops.push_back(c);
      const auto& faces = cell_.corner(c).faces;
      const auto i =
          static_cast<std::size_t>(std::find(faces.begin(), faces.end(), static_cast<Index>(f)) - faces.begin());
      c = next_[f * m + static_cast<std::size_t>(faces[(i + 2) % 3])];
    } while (c != first);
    cell_.begin.push_back(static_cast<Index>(cell_.loops.size()));
  }
}

}  // namespace tessera
