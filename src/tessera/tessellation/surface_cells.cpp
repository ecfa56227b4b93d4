#include "tessera/tessellation/surface_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tessera/base/error.hpp"
#include "tessera/parallel/collect.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/cell_closure.hpp"
#include "tessera/tessellation/surface_face_list.hpp"
#include "tessera/tessellation/surface_fence.hpp"
#include "tessera/tessellation/surface_outline.hpp"
#include "tessera/tessellation/surface_parts.hpp"

namespace tessera {
namespace {

constexpr double kFilled = 1e-8;     // of the volume: cells that miss more do not fill the solid
constexpr double kFirstFence = 2.0;  // distance of the first fence, in spacings

std::string named(const Generators& points, Index a) { return "particle " + points.named(a); }

/// A face of a cell in one part, as it is kept until all cells are cut.
struct KeptFace {
  Index neighbour, patch;
  FlatArea piece;
};

class SurfaceAssembly {
 public:
  SurfaceAssembly(const Generators& points, const SurfaceIndex& index, Moments moments, Pictures pictures)
      : points_(points),
        index_(index),
        moments_(moments),
        pictures_(pictures),
        planes_(find_planes(index.surface())),
        solid_volume_(volume(index.surface())),
        listed_(points_, planes_) {}

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
      if (face.neighbour >= static_cast<Index>(points_.size()) &&
          std::abs(face.piece.size) > smallest_face(point(a), V))
        return false;
      if (cell.parts.size() > 1 || (face.neighbour >= 0 && face.neighbour < a)) continue;
      out.add({face.neighbour, face.patch, face.piece});
      if (!kept_second_.empty()) kept_second_[i].push_back(face.piece.second);
    }
    return true;
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
    listed_.move_to(result_.cells);
    faces_ = {};
    kept_second_ = {};
  }

  void list(Index cell, const StoredFace& face, Index a, Index b) {
    listed_.add(cell, face, a, b, result_.cells.volume);
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
  SurfaceFaceList listed_;
  SurfaceCells result_;
};

}  // namespace

SurfaceCells surface_cells(const Generators& points, const SurfaceIndex& index, Moments moments, Pictures pictures) {
  if (points.size() == 0) throw GeometryError("there are no particles to make Voronoi cells of");
  return SurfaceAssembly(points, index, moments, pictures).assemble();
}

}  // namespace tessera
