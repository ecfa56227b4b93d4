#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tessera/base/error.hpp"
#include "tessera/parallel/collect.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/voronoi_cutter.hpp"

namespace tessera {
namespace {

constexpr double kRoundoffFace = 1e-14;  // of V^(2/3): faces smaller than this are round-off
constexpr double kClosed = 1e-8;         // of the surface or volume: cells that miss more are wrong

struct FlatFace {
  Vec3 area;      // [m2]
  Vec3 centroid;  // relative to the cell's particle [m]
};

FlatFace measure(const ConvexPolyhedron& part, Index f, const Vec3& X) {
  const std::span<const Index> corners = part.face(f);
  const auto vertex = [&](std::size_t i) { return part.vertices[static_cast<std::size_t>(corners[i])]; };
  const Vec3 first = vertex(0);
  Vec3 area;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) area += 0.5 * cross(vertex(i) - first, vertex(i + 1) - first);
  const double size2 = norm2(area);
  if (size2 == 0.0) return {};
  Vec3 moment;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3 u = vertex(i) - first, v = vertex(i + 1) - first;
    moment += 0.5 * dot(cross(u, v), area) * (u + v);
  }
  return {area, (first - X) + moment / (3.0 * size2)};
}

/// The faces of one cell towards one neighbour or side, put together from the pieces of the solid.
struct MergedFace {
  Index tag = 0;
  Vec3 area;
  Vec3 moment;  // area times centroid [m3]
  double size = 0.0;

  Vec3 centroid() const { return moment / size; }
};

struct CellSums {
  std::vector<MergedFace> faces;
  double volume = 0.0;
  Vec3 moment;  // volume times centroid [m4]
};

void add_face(CellSums& sums, Index tag, const FlatFace& face) {
  auto it = std::find_if(sums.faces.begin(), sums.faces.end(), [tag](const MergedFace& m) { return m.tag == tag; });
  if (it == sums.faces.end()) it = sums.faces.insert(sums.faces.end(), MergedFace{tag, {}, {}, 0.0});
  const double size = norm(face.area);
  it->area += face.area;
  it->moment += size * face.centroid;
  it->size += size;
}

/// Cones from the particle to the faces give volume and centroid, inner walls included.
void add_part(CellSums& sums, const ConvexPolyhedron& part, const Vec3& X) {
  for (Index f = 0; f < part.faces(); ++f) {
    const FlatFace face = measure(part, f, X);
    const double cone = dot(face.area, face.centroid) / 3.0;
    sums.volume += cone;
    sums.moment += 0.75 * cone * face.centroid;
    const Index tag = part.tags[static_cast<std::size_t>(f)];
    if (tag != VoronoiCutter::kInnerWall) add_face(sums, tag, face);
  }
}

/// "particle 7 at (1, 2, 3) m".
std::string named(std::span<const Vec3> points, Index a) {
  const Vec3& X = points[static_cast<std::size_t>(a)];
  return fmt::format("particle {} at ({:g}, {:g}, {:g}) m", a, X.x, X.y, X.z);
}

/// One face of a cell before interior and boundary ones part: the particle or side behind it.
struct TaggedFace {
  Index tag = 0;
  Vec3 area;
  Vec3 centroid;
};

class Assembly {
 public:
  Assembly(std::span<const Vec3> points, const Solid& solid)
      : points_(points), cutters_([points, &solid] { return std::make_unique<VoronoiCutter>(points, solid); }) {}

  Cells assemble() {
    cells_.volume.resize(points_.size());
    cells_.centroid.resize(points_.size());
    Csr<TaggedFace> rows = parallel::collect_rows<TaggedFace>(
        static_cast<Index>(points_.size()),
        [this](Index a, parallel::RowCollector<TaggedFace>& out) { add_cell(a, out); });
    sort_out(rows);
    rows = {};
    close_cells();
    return std::move(cells_);
  }

 private:
  const Vec3& point(Index a) const { return points_[static_cast<std::size_t>(a)]; }

  /// The lower of two particles computes their common face; both cells then use the same numbers.
  void add_cell(Index a, parallel::RowCollector<TaggedFace>& out) {
    const parallel::Workspaces<VoronoiCutter>::Lease cutter(cutters_);
    CellSums sums;
    for (const ConvexPolyhedron& part : cutter->cut(a)) add_part(sums, part, point(a));
    if (!(sums.volume > 0.0))
      throw GeometryError("the Voronoi cell of " + named(points_, a) +
                          " is empty; is it in the solid, and there only once?");
    const double smallest = kRoundoffFace * std::cbrt(sums.volume * sums.volume);
    std::sort(sums.faces.begin(), sums.faces.end(),
              [](const MergedFace& f, const MergedFace& g) { return rank(f.tag) < rank(g.tag); });
    for (const MergedFace& face : sums.faces)
      if (face.size >= smallest && (VoronoiCutter::is_side(face.tag) || face.tag > a))
        out.add({face.tag, face.area, point(a) + face.centroid()});
    cells_.volume[static_cast<std::size_t>(a)] = sums.volume;
    cells_.centroid[static_cast<std::size_t>(a)] = point(a) + sums.moment / sums.volume;
  }

  /// Neighbours and sides in ascending order.
  static Index rank(Index tag) { return VoronoiCutter::is_side(tag) ? VoronoiCutter::side_of(tag) : tag; }

  void sort_out(const Csr<TaggedFace>& rows) {
    for (Index a = 0; a < rows.rows(); ++a)
      for (const TaggedFace& face : rows.row(a))
        if (VoronoiCutter::is_side(face.tag))
          cells_.boundary.push_back({a, VoronoiCutter::side_of(face.tag), face.area, face.centroid});
        else
          cells_.interior.push_back({a, face.tag, face.area, face.centroid});
  }

  struct Balance {
    Vec3 area;
    double surface = 0.0;
    double volume = 0.0;
  };

  void add_to_balance(std::vector<Balance>& balances, Index a, const Vec3& area, const Vec3& centroid) const {
    Balance& balance = balances[static_cast<std::size_t>(a)];
    balance.area += area;
    balance.surface += norm(area);
    balance.volume += dot(area, centroid - point(a)) / 3.0;
  }

  /// Takes the volumes from the faces by the divergence theorem, so that they fit each other to the last digit, and
  /// checks that every cell is closed.
  void close_cells() {
    std::vector<Balance> balances(points_.size());
    for (const InteriorFace& face : cells_.interior) {
      add_to_balance(balances, face.a, face.area, face.centroid);
      add_to_balance(balances, face.b, -face.area, face.centroid);
    }
    for (const BoundaryFace& face : cells_.boundary) add_to_balance(balances, face.owner, face.area, face.centroid);
    for (std::size_t a = 0; a < points_.size(); ++a) {
      const Balance& balance = balances[a];
      if (norm(balance.area) > kClosed * balance.surface ||
          std::abs(balance.volume - cells_.volume[a]) > kClosed * cells_.volume[a])
        throw GeometryError("the Voronoi cell of " + named(points_, static_cast<Index>(a)) +
                            " does not close; are particles there closer than round-off to each other or to a wall?");
      cells_.volume[a] = balance.volume;
    }
  }

  std::span<const Vec3> points_;
  parallel::Workspaces<VoronoiCutter> cutters_;
  Cells cells_;
};

}  // namespace

Cells voronoi_cells(std::span<const Vec3> points, const Solid& solid) {
  if (points.empty()) throw GeometryError("there are no particles to make Voronoi cells of");
  return Assembly(points, solid).assemble();
}

std::vector<Polyhedron> voronoi_polyhedra(std::span<const Vec3> points, const Solid& solid) {
  if (points.empty()) throw GeometryError("there are no particles to make Voronoi cells of");
  VoronoiCutter cutter(points, solid);
  std::vector<Polyhedron> polyhedra;
  for (Index a = 0; a < static_cast<Index>(points.size()); ++a)
    for (const ConvexPolyhedron& part : cutter.cut(a)) {
      Polyhedron polyhedron{a, part.vertices, {}};
      for (Index f = 0; f < part.faces(); ++f) polyhedron.faces.emplace_back(part.face(f).begin(), part.face(f).end());
      polyhedra.push_back(std::move(polyhedron));
    }
  return polyhedra;
}

}  // namespace tessera
