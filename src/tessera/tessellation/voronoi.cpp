#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tessera/base/error.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/voronoi_cutter.hpp"

namespace tessera {
namespace {

constexpr double kRoundoffFace = 1e-14;  // of V^(2/3): faces smaller than this are round-off
constexpr double kClosed = 1e-8;         // of the surface or volume: cells that miss more are wrong

struct FlatFace {
  Vec3 area;          // [m2]
  Vec3 centroid;      // relative to the cell's particle [m]
  Symmetric3 second;  // moment about the centroid, if wanted [m4]
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
  return {area, (first - X) + moment / (3.0 * size2), {}};
}

/// The integral of (Y - C) (x) (Y - C) over a face with centroid C, as triangles from one of its vertices.
Symmetric3 second_moment(const ConvexPolyhedron& part, Index f, const Vec3& X, const FlatFace& face) {
  const std::span<const Index> corners = part.face(f);
  const auto vertex = [&](std::size_t i) { return part.vertices[static_cast<std::size_t>(corners[i])]; };
  const double size = norm(face.area);
  if (size == 0.0) return {};
  const Vec3 first = vertex(0);
  Symmetric3 sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3 u = vertex(i) - first, v = vertex(i + 1) - first;
    const double share = dot(cross(u, v), face.area) / (24.0 * size);
    sum += share * (square(u) + square(v) + square(u + v));
  }
  return sum - size * square(face.centroid + X - first);
}

/// The faces of one cell towards one neighbour or side, put together from the pieces of the solid.
struct MergedFace {
  Index tag = 0;
  Vec3 area;
  Vec3 moment;  // area times centroid [m3]
  double size = 0.0;
  Symmetric3 second;  // moment about the centroid [m4]

  Vec3 centroid() const { return moment / size; }
};

struct CellSums {
  std::vector<MergedFace> faces;
  double volume = 0.0;
  Vec3 moment;        // volume times centroid [m4]
  Symmetric3 second;  // moment about the particle [m5]

  void clear() {
    faces.clear();
    volume = 0.0;
    moment = {};
    second = {};
  }
};

void add_face(CellSums& sums, Index tag, const FlatFace& face) {
  auto it = std::find_if(sums.faces.begin(), sums.faces.end(), [tag](const MergedFace& m) { return m.tag == tag; });
  if (it == sums.faces.end()) it = sums.faces.insert(sums.faces.end(), MergedFace{tag, {}, {}, 0.0, {}});
  const double size = norm(face.area);
  it->second += face.second;
  if (it->size > 0.0 && size > 0.0)  // parallel axes
    it->second += (it->size * size / (it->size + size)) * square(it->centroid() - face.centroid);
  it->area += face.area;
  it->moment += size * face.centroid;
  it->size += size;
}

/// Cones from the particle to the faces give volume, centroid and second moment, inner walls included.
void add_part(CellSums& sums, const ConvexPolyhedron& part, const Vec3& X, Moments moments) {
  for (Index f = 0; f < part.faces(); ++f) {
    FlatFace face = measure(part, f, X);
    const double cone = dot(face.area, face.centroid) / 3.0;
    sums.volume += cone;
    sums.moment += 0.75 * cone * face.centroid;
    if (moments != Moments::first) {
      face.second = second_moment(part, f, X, face);
      sums.second += 0.6 * cone * square(face.centroid);
      if (const double size = norm(face.area); size > 0.0) sums.second += (0.6 * cone / size) * face.second;
    }
    const Index tag = part.tags[static_cast<std::size_t>(f)];
    if (tag != VoronoiCutter::kInnerWall) add_face(sums, tag, face);
  }
}

std::string named(const Generators& points, Index a) { return "particle " + points.named(a); }

/// Room for the interior faces of a cell that it shares with higher particles, on average.
constexpr std::size_t kExpectedFaces = 8;
/// Blocks of cells whose faces are kept apart for a while, before they join the others.
constexpr std::int64_t kBatch = 128 * parallel::block_size;

/// The faces of consecutive cells.
struct Faces {
  std::vector<InteriorFace> interior;
  std::vector<BoundaryFace> boundary;
  std::vector<Symmetric3> interior_second_moment, boundary_second_moment;  // if wanted
};

/// Puts one block's values where they belong.
template <class T>
void copy_to(std::vector<T>& all, std::size_t place, const std::vector<T>& values) {
  std::copy(values.begin(), values.end(), all.begin() + static_cast<std::ptrdiff_t>(place));
}

/// Where one block's faces go.
struct Place {
  std::size_t interior = 0, boundary = 0;
};

/// What one thread works with.
struct Workspace {
  VoronoiCutter cutter;
  CellSums sums;
};

class Assembly {
 public:
  Assembly(const Generators& points, const Solid& solid, Moments moments)
      : points_(points),
        moments_(moments),
        grid_(VoronoiCutter::grid_of(points.points(), solid)),
        workspaces_([this, &solid] {
          return std::unique_ptr<Workspace>(new Workspace{VoronoiCutter(points_, solid, grid_), {}});
        }) {}

  Cells assemble() {
    cells_.volume.resize(points_.size());
    cells_.centroid.resize(points_.size());
    if (moments_ != Moments::first) cells_.second_moment.resize(points_.size());
    cells_.interior.reserve(kExpectedFaces * points_.size());
    const auto n = static_cast<std::int64_t>(points_.size());
    for (std::int64_t first = 0; first < n; first += kBatch) add_cells(first, std::min(first + kBatch, n));
    close_cells();
    return std::move(cells_);
  }

 private:
  const Vec3& point(Index a) const { return points_[static_cast<std::size_t>(a)]; }

  /// Cuts the cells first .. last and appends their faces.
  void add_cells(std::int64_t first, std::int64_t last) {
    std::vector<Faces> blocks(
        static_cast<std::size_t>((last - first + parallel::block_size - 1) / parallel::block_size));
    const auto block = [&](std::int64_t begin) {
      return static_cast<std::size_t>((begin - first) / parallel::block_size);
    };
    parallel::for_ranges(first, last, [&](std::int64_t begin, std::int64_t end) {
      const parallel::Workspaces<Workspace>::Lease workspace(workspaces_);
      Faces& faces = blocks[block(begin)];
      faces.interior.reserve(kExpectedFaces * parallel::block_size);
      for (auto a = static_cast<Index>(begin); a < static_cast<Index>(end); ++a) add_cell(a, *workspace, faces);
    });
    std::vector<Place> places;
    Place end{cells_.interior.size(), cells_.boundary.size()};
    for (const Faces& faces : blocks) {
      places.push_back(end);
      end.interior += faces.interior.size();
      end.boundary += faces.boundary.size();
    }
    cells_.interior.resize(end.interior);
    cells_.boundary.resize(end.boundary);
    if (with_faces()) {
      cells_.interior_second_moment.resize(end.interior);
      cells_.boundary_second_moment.resize(end.boundary);
    }
    parallel::for_ranges(first, last, [&](std::int64_t begin, std::int64_t) {
      const Faces& faces = blocks[block(begin)];
      const Place& place = places[block(begin)];
      copy_to(cells_.interior, place.interior, faces.interior);
      copy_to(cells_.boundary, place.boundary, faces.boundary);
      copy_to(cells_.interior_second_moment, place.interior, faces.interior_second_moment);
      copy_to(cells_.boundary_second_moment, place.boundary, faces.boundary_second_moment);
    });
  }

  /// The lower of two particles computes their common face; both cells then use the same numbers.
  void add_cell(Index a, Workspace& workspace, Faces& out) {
    CellSums& sums = workspace.sums;
    sums.clear();
    for (const ConvexPolyhedron& part : workspace.cutter.cut(a)) add_part(sums, part, point(a), moments_);
    if (!(sums.volume > 0.0))
      throw GeometryError("the Voronoi cell of " + named(points_, a) +
                          " is empty; is it in the solid, and there only once?");
    const double smallest = kRoundoffFace * std::cbrt(sums.volume * sums.volume);
    std::sort(sums.faces.begin(), sums.faces.end(),
              [](const MergedFace& f, const MergedFace& g) { return rank(f.tag) < rank(g.tag); });
    for (const MergedFace& face : sums.faces) {
      if (face.size < smallest) continue;
      const bool is_side = VoronoiCutter::is_side(face.tag);
      if (is_side)
        out.boundary.push_back({a, VoronoiCutter::side_of(face.tag), face.area, point(a) + face.centroid()});
      else if (face.tag > a)
        out.interior.push_back(
            {a, face.tag, face.area, point(a) + face.centroid(), true, cut_of(points_, a, face.tag)});
      if (with_faces() && is_side) out.boundary_second_moment.push_back(face.second);
      if (with_faces() && face.tag > a) out.interior_second_moment.push_back(face.second);
    }
    const auto k = static_cast<std::size_t>(a);
    const Vec3 centroid = sums.moment / sums.volume;
    cells_.volume[k] = sums.volume;
    cells_.centroid[k] = point(a) + centroid;
    if (moments_ != Moments::first) cells_.second_moment[k] = sums.second - sums.volume * square(centroid);
  }

  bool with_faces() const { return moments_ == Moments::second_of_faces; }

  /// Neighbours and sides in ascending order.
  static Index rank(Index tag) { return VoronoiCutter::is_side(tag) ? VoronoiCutter::side_of(tag) : tag; }

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
    for (const InteriorFace& face : cells_.interior) add_to_balance(balances, face.b, -face.area, face.centroid);
    parallel::for_ranges(0, static_cast<std::int64_t>(points_.size()), [&](std::int64_t begin, std::int64_t end) {
      const auto first = static_cast<Index>(begin), last = static_cast<Index>(end);
      const auto is_before = [](const InteriorFace& face, Index a) { return face.a < a; };
      const auto is_owned_before = [](const BoundaryFace& face, Index a) { return face.owner < a; };
      for (auto f = std::lower_bound(cells_.interior.begin(), cells_.interior.end(), first, is_before);
           f != cells_.interior.end() && f->a < last; ++f)
        add_to_balance(balances, f->a, f->area, f->centroid);
      for (auto f = std::lower_bound(cells_.boundary.begin(), cells_.boundary.end(), first, is_owned_before);
           f != cells_.boundary.end() && f->owner < last; ++f)
        add_to_balance(balances, f->owner, f->area, f->centroid);
      for (Index a = first; a < last; ++a) close_cell(a, balances[static_cast<std::size_t>(a)]);
    });
  }

  void close_cell(Index a, const Balance& balance) {
    double& volume = cells_.volume[static_cast<std::size_t>(a)];
    if (norm(balance.area) > kClosed * balance.surface || std::abs(balance.volume - volume) > kClosed * volume)
      throw GeometryError("the Voronoi cell of " + named(points_, a) +
                          " does not close; are particles there closer than round-off to each other or to a wall?");
    volume = balance.volume;
  }

  Generators points_;
  Moments moments_;
  PointGrid grid_;
  parallel::Workspaces<Workspace> workspaces_;
  Cells cells_;
};

}  // namespace

Cells voronoi_cells(const Generators& points, const Solid& solid, Moments moments) {
  if (points.size() == 0) throw GeometryError("there are no particles to make Voronoi cells of");
  return Assembly(points, solid, moments).assemble();
}

std::vector<Polyhedron> voronoi_polyhedra(const Generators& points, const Solid& solid) {
  if (points.size() == 0) throw GeometryError("there are no particles to make Voronoi cells of");
  const PointGrid grid = VoronoiCutter::grid_of(points.points(), solid);
  VoronoiCutter cutter(points, solid, grid);
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
