#include "tessera/tessellation/surface_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "tessera/base/error.hpp"
#include "tessera/parallel/collect.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/cell_closure.hpp"
#include "tessera/tessellation/surface_fence.hpp"
#include "tessera/tessellation/surface_outline.hpp"
#include "tessera/tessellation/surface_parts.hpp"

namespace tessera {
namespace {

constexpr double kRoundoffFace = 1e-14;  // of V^(2/3): faces smaller than this are round-off
constexpr double kFilled = 1e-8;         // of the volume: cells that miss more do not fill the solid
constexpr double kFirstFence = 2.0;      // distance of the first fence, in spacings

std::string named(const Generators& points, Index a) { return "particle " + points.named(a); }

/// A face of a cell in one part, as it is kept until all cells are cut.
struct KeptFace {
  Index neighbour, patch;
  FlatArea piece;
};

/// A face where it is stored; `second` is null where second moments are not wanted.
struct StoredFace {
  Index neighbour, patch;
  const FlatArea* piece;
  const Symmetric3* second;
};

/// A face as it enters the list of all: the pair whose bisector it lies in, or the flat patch of the surface.
struct ListedFace {
  Index a, b;  // owners now; b is -1 on the boundary
  Index low, high;
  Index cell;  // of which `piece` is a face; positions in it are relative to its particle
  int sign;    // -1 where the piece's area points from b to a
  const FlatArea* piece;
  const Symmetric3* second;
};

/// A second moment about a point at `shift` from the new one, turned to that: `size` and `moment` are those about the
/// old one.
Symmetric3 moved(const Symmetric3& second, const Vec3& moment, double size, const Vec3& shift) {
  return second + symmetric_product(moment, shift) + size * square(shift);
}

class SurfaceAssembly {
 public:
  SurfaceAssembly(const Generators& points, const SurfaceIndex& index, Moments moments, Pictures pictures)
      : points_(points),
        index_(index),
        moments_(moments),
        pictures_(pictures),
        planes_(find_planes(index.surface())),
        solid_volume_(volume(index.surface())) {}

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
    list_polyhedra();
    list_faces();
    close_cells(points_, result_.cells);
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

  /// The fence and what is around it are as light as the lightest particle.
  std::vector<double> weights_of(std::size_t generators) const {
    std::vector<double> weights;
    if (!points_.has_weights()) return weights;
    for (Index a = 0; a < static_cast<Index>(points_.size()); ++a) weights.push_back(points_.weight(a));
    weights.resize(generators, *std::min_element(weights.begin(), weights.end()));
    return weights;
  }

  /// Cuts all cells within a fence; is it far enough away from the solid to take nothing of it?
  bool cut_all(double distance, double spacing) {
    const std::vector<Vec3> all = enclosed_generators(points_.points(), fence_points(index_.surface(), distance));
    const std::vector<double> weights = weights_of(all.size());
    const Generators generators(all, weights, points_.names());
    const PointGrid grid = grid_of(all, spacing);
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
    second_.assign(moments_ == Moments::first ? 0 : points_.size(), {});
    kept_second_.assign(with_faces() ? points_.size() : 0, {});
    split_.clear();
    split_.resize(points_.size());
    outlines_.assign(pictures_ == Pictures::wanted ? points_.size() : 0, {});
    std::vector<char> meets_fence(points_.size(), 0);
    faces_ = parallel::collect_rows<KeptFace>(static_cast<Index>(points_.size()),
                                              [&](Index a, parallel::RowCollector<KeptFace>& out) {
                                                typename parallel::Workspaces<Tools>::Lease own(tools);
                                                const CutCell& cell = own->surface.cut(own->cells.cut(a));
                                                const auto i = static_cast<std::size_t>(a);
                                                meets_fence[i] = add_cell(a, cell, out) ? 0 : 1;
                                                if (!outlines_.empty())
                                                  outlines_[i] = outlines_of(own->surface, a, point(a));
                                              });
    if (std::find(meets_fence.begin(), meets_fence.end(), 1) != meets_fence.end()) return false;
    double total = 0.0;
    for (const double V : result_.cells.volume) total += V;
    return std::abs(total - solid_volume_) <= kFilled * solid_volume_;
  }

  /// False when the cell has a face with the fence.
  bool add_cell(Index a, const CutCell& cell, parallel::RowCollector<KeptFace>& out) {
    const auto i = static_cast<std::size_t>(a);
    for (const CutCell::Part& part : cell.parts) {
      result_.cells.volume[i] += part.volume;
      moment_[i] += part.moment;
      if (!second_.empty()) second_[i] += part.second;
    }
    const double V = result_.cells.volume[i];
    if (!(V > 0.0)) throw GeometryError("the Voronoi cell of " + named(points_, a) + " is empty");
    if (cell.parts.size() > 1) split_[i] = std::make_unique<CutCell>(cell);
    for (const CutFace& face : cell.faces) {
      if (face.neighbour >= static_cast<Index>(points_.size()) && std::abs(face.piece.size) > smallest_face(a))
        return false;
      if (cell.parts.size() > 1 || (face.neighbour >= 0 && face.neighbour < a)) continue;
      out.add({face.neighbour, face.patch, face.piece});
      if (!kept_second_.empty()) kept_second_[i].push_back(face.piece.second);
    }
    return true;
  }

  /// What a face needs to be more than round-off [m2].
  double smallest_face(Index a) const {
    const double V = result_.cells.volume[static_cast<std::size_t>(a)], size = std::cbrt(V);
    return std::max(kRoundoffFace * size, round_off(point(a), V)) * size;
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
        const Vec3 shift = point(a) - point(owner);
        moment_[to] += part.moment + part.volume * shift;
        if (!second_.empty()) {
          second_[from] -= part.second;
          second_[to] += moved(part.second, part.moment, part.volume, shift);
        }
        ++result_.adopted;
        result_.adopted_volume += part.volume;
      }
    }
    for (std::size_t a = 0; a < points_.size(); ++a)
      result_.cells.centroid.push_back(points_[a] + moment_[a] / volume[a]);
    for (std::size_t a = 0; a < second_.size(); ++a)
      result_.cells.second_moment.push_back(second_[a] - (1.0 / volume[a]) * square(moment_[a]));
  }

  void list_polyhedra() {
    for (std::size_t a = 0; a < outlines_.size(); ++a)
      for (std::size_t p = 0; p < outlines_[a].size(); ++p) {
        if (split_[a]) outlines_[a][p].particle = owners_->owner(static_cast<Index>(a), static_cast<Index>(p));
        result_.polyhedra.push_back(std::move(outlines_[a][p]));
      }
    outlines_ = {};
  }

  void list(Index cell, const StoredFace& face, Index a, Index b) {
    if (a == b) return;
    const bool is_reversed = b >= 0 && a > b;
    if (is_reversed) std::swap(a, b);
    if (std::abs(face.piece->size) < smallest_face(a)) return;
    const auto [low, high] =
        face.neighbour >= 0 ? std::minmax(cell, face.neighbour) : std::minmax(face.patch, face.patch);
    listed_.push_back({a, b, low, high, cell, is_reversed ? -1 : 1, face.piece, face.second});
  }

  void list_faces() {
    for (Index a = 0; a < static_cast<Index>(points_.size()); ++a) {
      const auto i = static_cast<std::size_t>(a);
      if (const CutCell* cell = split_[i].get()) {
        for (const CutFace& face : cell->faces) list_split(a, face);
        continue;
      }
      const std::span<const KeptFace> row = faces_.row(a);
      for (std::size_t f = 0; f < row.size(); ++f)
        if (row[f].neighbour < 0 || !split_[static_cast<std::size_t>(row[f].neighbour)])
          list(a, {row[f].neighbour, row[f].patch, &row[f].piece, with_faces() ? &kept_second_[i][f] : nullptr}, a,
               row[f].neighbour);
    }
    std::stable_sort(listed_.begin(), listed_.end(), [this](const ListedFace& f, const ListedFace& g) {
      return (f.b < 0) != (g.b < 0) ? g.b < 0 : key(f) < key(g);
    });
    merge_listed();
  }

  void list_split(Index a, const CutFace& face) {
    const StoredFace stored{face.neighbour, face.patch, &face.piece, with_faces() ? &face.piece.second : nullptr};
    const Index owner = owners_->owner(a, face.part);
    if (face.neighbour < 0) return list(a, stored, owner, -1);
    const bool is_common = split_[static_cast<std::size_t>(face.neighbour)] != nullptr;
    if (is_common && face.neighbour < a) return;
    list(a, stored, owner, owners_->owner_behind(a, face));
  }

  bool with_faces() const { return moments_ == Moments::second_of_faces; }

  Index side_of(const ListedFace& face) const { return planes_.side[static_cast<std::size_t>(face.low)]; }
  std::tuple<Index, Index, Index, Index> key(const ListedFace& face) const {
    if (face.b < 0) return {face.a, side_of(face), face.low, 0};
    return {face.a, face.b, face.low, face.high};
  }

  /// Puts the pieces of one face together; positions are relative to the particle of its owner a.
  FlatPiece together(std::span<const ListedFace> pieces) const {
    FlatPiece sum;
    for (const ListedFace& f : pieces) {
      const FlatArea& piece = *f.piece;
      const Vec3 shift = point(f.cell) - point(f.a);
      sum.area += static_cast<double>(f.sign) * piece.area;
      sum.moment += piece.moment + piece.size * shift;
      sum.size += piece.size;
      if (f.second != nullptr) sum.second += moved(*f.second, piece.moment, piece.size, shift);
    }
    return sum;
  }

  void merge_listed() {
    for (auto first = listed_.begin(); first != listed_.end();) {
      auto next = first + 1;
      while (next != listed_.end() && (next->b < 0) == (first->b < 0) && key(*next) == key(*first)) ++next;
      add_face(*first, together({first, next}));
      first = next;
    }
    listed_ = {};
    faces_ = {};
    kept_second_ = {};
  }

  void add_face(const ListedFace& f, const FlatPiece& piece) {
    Cells& cells = result_.cells;
    const Vec3 C = point(f.a) + piece.moment / piece.size;
    if (f.b < 0)
      cells.boundary.push_back({f.a, side_of(f), piece.area, C});
    else
      cells.interior.push_back(interior_face(f, piece.area, C));
    if (with_faces())
      (f.b < 0 ? cells.boundary_second_moment : cells.interior_second_moment)
          .push_back(piece.second - (1.0 / piece.size) * square(piece.moment));
  }

  InteriorFace interior_face(const ListedFace& f, const Vec3& area, const Vec3& centroid) const {
    const bool bisects = f.low == f.a && f.high == f.b;
    return {f.a, f.b, area, centroid, bisects, bisects ? cut_of(points_, f.a, f.b) : 0.5};
  }

  Generators points_;
  const SurfaceIndex& index_;
  Moments moments_;
  Pictures pictures_;
  SurfacePlanes planes_;
  double solid_volume_;
  Csr<KeptFace> faces_;                               // of cells in one part
  std::vector<std::vector<Symmetric3>> kept_second_;  // their second moments, if wanted
  std::vector<std::unique_ptr<CutCell>> split_;       // cells in several parts
  std::vector<Vec3> moment_;                          // volume times centroid relative to the particle
  std::vector<Symmetric3> second_;                    // moments about the particle, if wanted
  std::vector<std::vector<Polyhedron>> outlines_;     // per cell, per part, if wanted
  std::unique_ptr<SplitCells> owners_;
  std::vector<ListedFace> listed_;
  SurfaceCells result_;
};

}  // namespace

SurfaceCells surface_cells(const Generators& points, const SurfaceIndex& index, Moments moments, Pictures pictures) {
  if (points.size() == 0) throw GeometryError("there are no particles to make Voronoi cells of");
  return SurfaceAssembly(points, index, moments, pictures).assemble();
}

}  // namespace tessera
