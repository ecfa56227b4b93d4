#include "tessera/tessellation/surface_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "tessera/base/error.hpp"
#include "tessera/parallel/collect.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/surface_fence.hpp"
#include "tessera/tessellation/surface_parts.hpp"

namespace tessera {
namespace {

constexpr double kRoundoffFace = 1e-14;  // of V^(2/3): faces smaller than this are round-off
constexpr double kClosed = 1e-8;         // of the surface or volume: cells that miss more are wrong
constexpr double kFirstFence = 2.0;      // distance of the first fence, in spacings
constexpr double kFarAway = 10.0;        // distance of the farthest generators, in sizes of what they surround

std::string named(std::span<const Vec3> points, Index a) {
  const Vec3& X = points[static_cast<std::size_t>(a)];
  return fmt::format("particle {} at ({:g}, {:g}, {:g}) m", a, X.x, X.y, X.z);
}

/// Particles, a fence around them, and a tetrahedron around all.
std::vector<Vec3> generators_of(std::span<const Vec3> points, const TriangleSurface& surface, double distance) {
  std::vector<Vec3> generators(points.begin(), points.end());
  const std::vector<Vec3> fence = fence_points(surface, distance);
  generators.insert(generators.end(), fence.begin(), fence.end());
  Bounds box;
  for (const Vec3& X : generators) box.include(X);
  const Vec3 center = 0.5 * (box.lower + box.upper);
  const double far = kFarAway * norm(box.size());
  for (const Vec3& way : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}})
    generators.push_back(center + far * way);
  return generators;
}

/// A face as it enters the list of all: the pair whose bisector it lies in, or the flat patch of the surface.
struct ListedFace {
  Index a, b;  // owners now; b is -1 on the boundary
  Index low, high;
  Vec3 area;    // from a to b, or out of the solid
  Vec3 moment;  // area times centroid
  double size;
};

class SurfaceAssembly {
 public:
  SurfaceAssembly(std::span<const Vec3> points, const SurfaceIndex& index)
      : points_(points), index_(index), planes_(find_planes(index.surface())), solid_volume_(volume(index.surface())) {}

  SurfaceCells assemble() {
    check_particles();
    const double spacing = std::cbrt(solid_volume_ / static_cast<double>(points_.size()));
    const double largest = norm(bounds(index_.surface()).size());
    for (double distance = kFirstFence * spacing;; distance *= 2.0) {
      if (cut_all(distance, spacing)) break;
      if (distance > largest)
        throw GeometryError("the cells miss a part of the solid: has it parts without a particle?");
    }
    adopt();
    list_faces();
    close_cells();
    return std::move(result_);
  }

 private:
  const Vec3& point(Index a) const { return points_[static_cast<std::size_t>(a)]; }

  void check_particles() const {
    const auto n = static_cast<Index>(points_.size());
    std::vector<char> is_inside(points_.size(), 0);
    parallel::for_each(n, [&](std::int64_t a) {
      is_inside[static_cast<std::size_t>(a)] = index_.location(point(static_cast<Index>(a))) == Location::inside;
    });
    for (Index a = 0; a < n; ++a)
      if (!is_inside[static_cast<std::size_t>(a)])
        throw GeometryError(named(points_, a) + " does not lie inside the surface");
  }

  /// Cuts all cells within a fence; is it far enough away from the solid to take nothing of it?
  bool cut_all(double distance, double spacing) {
    const std::vector<Vec3> generators = generators_of(points_, index_.surface(), distance);
    const PointGrid grid = grid_of(generators, spacing);
    struct Tools {
      DualCellCutter cells;
      SurfaceCutter surface;
    };
    parallel::Workspaces<Tools> tools([&] {
      return std::make_unique<Tools>(
          Tools{DualCellCutter(generators, grid), SurfaceCutter(generators, index_, planes_)});
    });
    result_.cells.volume.assign(points_.size(), 0.0);
    moment_.assign(points_.size(), {});
    split_.clear();
    split_.resize(points_.size());
    std::vector<char> meets_fence(points_.size(), 0);
    faces_ = parallel::collect_rows<CutFace>(static_cast<Index>(points_.size()),
                                             [&](Index a, parallel::RowCollector<CutFace>& out) {
                                               typename parallel::Workspaces<Tools>::Lease own(tools);
                                               const CutCell& cell = own->surface.cut(own->cells.cut(a));
                                               const auto i = static_cast<std::size_t>(a);
                                               meets_fence[i] = add_cell(a, cell, out) ? 0 : 1;
                                             });
    if (std::find(meets_fence.begin(), meets_fence.end(), 1) != meets_fence.end()) return false;
    double total = 0.0;
    for (const double V : result_.cells.volume) total += V;
    return std::abs(total - solid_volume_) <= kClosed * solid_volume_;
  }

  /// False when the cell has a face with the fence.
  bool add_cell(Index a, const CutCell& cell, parallel::RowCollector<CutFace>& out) {
    const auto i = static_cast<std::size_t>(a);
    for (const CutCell::Part& part : cell.parts) {
      result_.cells.volume[i] += part.volume;
      moment_[i] += part.moment;
    }
    const double V = result_.cells.volume[i];
    if (!(V > 0.0)) throw GeometryError("the Voronoi cell of " + named(points_, a) + " is empty");
    if (cell.parts.size() > 1) split_[i] = std::make_unique<CutCell>(cell);
    for (const CutFace& face : cell.faces) {
      if (face.neighbour >= static_cast<Index>(points_.size()) && std::abs(face.piece.size) > smallest_face(a))
        return false;
      if (cell.parts.size() == 1 && (face.neighbour < 0 || face.neighbour > a)) out.add(face);
    }
    return true;
  }

  /// What a face needs to be more than round-off of the coordinates [m2].
  double smallest_face(Index a) const {
    const Vec3& X = point(a);
    const double size = std::cbrt(result_.cells.volume[static_cast<std::size_t>(a)]);
    const double coordinate = std::max({std::abs(X.x), std::abs(X.y), std::abs(X.z), size});
    return std::max(kRoundoffFace * size, 8.0 * std::numeric_limits<double>::epsilon() * coordinate) * size;
  }

  /// Hands parts that are cut off from their particles to other cells.
  void adopt() {
    owners_ = std::make_unique<SplitCells>(points_, split_);
    std::vector<double>& volume = result_.cells.volume;
    for (Index a = 0; a < static_cast<Index>(points_.size()); ++a) {
      const CutCell* cell = split_[static_cast<std::size_t>(a)].get();
      if (!cell) continue;
      for (std::size_t p = 0; p < cell->parts.size(); ++p) {
        const Index owner = owners_->owner(a, static_cast<Index>(p));
        if (owner == a) continue;
        const CutCell::Part& part = cell->parts[p];
        const auto from = static_cast<std::size_t>(a), to = static_cast<std::size_t>(owner);
        volume[from] -= part.volume;
        moment_[from] -= part.moment;
        volume[to] += part.volume;
        moment_[to] += part.moment + part.volume * (point(a) - point(owner));
        ++result_.adopted;
        result_.adopted_volume += part.volume;
      }
    }
    for (std::size_t a = 0; a < points_.size(); ++a)
      result_.cells.centroid.push_back(points_[a] + moment_[a] / volume[a]);
  }

  void list(Index cell, const CutFace& face, Index a, Index b) {
    if (a == b) return;
    const bool is_reversed = b >= 0 && a > b;
    const double sign = is_reversed ? -1.0 : 1.0;
    const Vec3 moment = face.piece.moment + face.piece.size * point(cell);
    if (is_reversed) std::swap(a, b);
    if (std::abs(face.piece.size) < smallest_face(a)) return;
    const auto [low, high] =
        face.neighbour >= 0 ? std::minmax(cell, face.neighbour) : std::minmax(face.patch, face.patch);
    listed_.push_back({a, b, low, high, sign * face.piece.area, moment, face.piece.size});
  }

  void list_faces() {
    for (Index a = 0; a < static_cast<Index>(points_.size()); ++a) {
      if (const CutCell* cell = split_[static_cast<std::size_t>(a)].get()) {
        for (const CutFace& face : cell->faces) list_split(a, face);
        continue;
      }
      for (const CutFace& face : faces_.row(a))
        if (face.neighbour < 0 || !split_[static_cast<std::size_t>(face.neighbour)]) list(a, face, a, face.neighbour);
    }
    faces_ = {};
    std::stable_sort(listed_.begin(), listed_.end(), [this](const ListedFace& f, const ListedFace& g) {
      return (f.b < 0) != (g.b < 0) ? g.b < 0 : key(f) < key(g);
    });
    merge_listed();
  }

  void list_split(Index a, const CutFace& face) {
    const Index owner = owners_->owner(a, face.part);
    if (face.neighbour < 0) return list(a, face, owner, -1);
    const bool is_common = split_[static_cast<std::size_t>(face.neighbour)] != nullptr;
    if (is_common && face.neighbour < a) return;
    list(a, face, owner, owners_->owner_behind(a, face));
  }

  Index side_of(const ListedFace& face) const { return planes_.side[static_cast<std::size_t>(face.low)]; }
  std::tuple<Index, Index, Index, Index> key(const ListedFace& face) const {
    if (face.b < 0) return {face.a, side_of(face), face.low, 0};
    return {face.a, face.b, face.low, face.high};
  }

  void merge_listed() {
    Cells& cells = result_.cells;
    for (auto first = listed_.begin(); first != listed_.end();) {
      ListedFace sum = *first;
      auto next = first + 1;
      for (; next != listed_.end() && (next->b < 0) == (first->b < 0) && key(*next) == key(*first); ++next)
        sum.area += next->area, sum.moment += next->moment, sum.size += next->size;
      const Vec3 centroid = sum.moment / sum.size;
      if (sum.b < 0)
        cells.boundary.push_back({sum.a, side_of(sum), sum.area, centroid});
      else
        cells.interior.push_back({sum.a, sum.b, sum.area, centroid, sum.low == sum.a && sum.high == sum.b});
      first = next;
    }
    listed_ = {};
  }

  struct Balance {
    Vec3 area;
    double surface = 0.0, volume = 0.0;
  };

  /// Takes the volumes from the faces by the divergence theorem, so that they fit each other to the last digit, and
  /// checks that every cell is closed.
  void close_cells() {
    std::vector<Balance> balances(points_.size());
    const auto add = [&](Index a, const Vec3& area, const Vec3& centroid) {
      Balance& balance = balances[static_cast<std::size_t>(a)];
      balance.area += area;
      balance.surface += norm(area);
      balance.volume += dot(area, centroid - point(a)) / 3.0;
    };
    for (const InteriorFace& f : result_.cells.interior) add(f.a, f.area, f.centroid), add(f.b, -f.area, f.centroid);
    for (const BoundaryFace& f : result_.cells.boundary) add(f.owner, f.area, f.centroid);
    for (std::size_t a = 0; a < points_.size(); ++a) {
      double& V = result_.cells.volume[a];
      if (norm(balances[a].area) > kClosed * balances[a].surface || std::abs(balances[a].volume - V) > kClosed * V)
        throw GeometryError("the Voronoi cell of " + named(points_, static_cast<Index>(a)) +
                            " does not close; does the surface cross itself there?");
      V = balances[a].volume;
    }
  }

  std::span<const Vec3> points_;
  const SurfaceIndex& index_;
  SurfacePlanes planes_;
  double solid_volume_;
  Csr<CutFace> faces_;                           // of cells in one part
  std::vector<std::unique_ptr<CutCell>> split_;  // cells in several parts
  std::vector<Vec3> moment_;                     // volume times centroid relative to the particle
  std::unique_ptr<SplitCells> owners_;
  std::vector<ListedFace> listed_;
  SurfaceCells result_;
};

}  // namespace

SurfaceCells surface_cells(std::span<const Vec3> points, const SurfaceIndex& index) {
  if (points.empty()) throw GeometryError("there are no particles to make Voronoi cells of");
  return SurfaceAssembly(points, index).assemble();
}

}  // namespace tessera
