#include "tessera/discretization/moved_means.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/voronoi_common.hpp"

namespace tessera {

namespace {

// Eigenvalues of sum_f N_f (x) N_f below this, 1 - cos 40 degrees, count as none: faces at a blunter edge are one.
constexpr double blunt = 0.234;
// A way below this part of the cell's size is round-off.
constexpr double no_way = 1e-9;

/// The directions in the planes of all free faces of a cell, and across them.
struct Surface {
  Mat3 in_plane;       // projection T
  int directions = 0;  // in the planes
  Mat3 inverse;        // pseudo-inverse of sum_f N_f (x) N_f, in the directions across
};

Surface surface_of(std::span<const Vec3> normals) {
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (const Vec3& N : normals) S += Eigen::Vector3d(N.x, N.y, N.z) * Eigen::RowVector3d(N.x, N.y, N.z);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(S);
  Surface surface;
  for (int i = 0; i < 3; ++i) {
    const Vec3 v{eigen.eigenvectors()(0, i), eigen.eigenvectors()(1, i), eigen.eigenvectors()(2, i)};
    if (eigen.eigenvalues()(i) > blunt)
      surface.inverse += (1.0 / eigen.eigenvalues()(i)) * outer(v, v);
    else
      surface.in_plane += outer(v, v), ++surface.directions;
  }
  return surface;
}

/// C*_a - X_a.
Vec3 place_of_mean(const Discretization& d, Index a, const Surface& surface) {
  const Mat3& T = surface.in_plane;
  const double n = surface.directions, V = d.volume[static_cast<std::size_t>(a)];
  Vec3 u, w;
  for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i) {
    const Vec3 X_ab = d.branch(a, i), TB = T * d.bonds.B_ab[static_cast<std::size_t>(i)];
    u += dot(X_ab, TB) * X_ab;
    w += dot(X_ab, T * X_ab) * TB;
  }
  const Vec3 Tu = T * u;
  return (1.0 / (n * V)) * (u - Tu) + (1.0 / (n * (n + 2.0) * V)) * ((n + 1.0) * Tu - 0.5 * w);
}

/// What moves the means, particle after particle.
class MeanMover {
 public:
  MeanMover(const Discretization& d, const Cells& cells)
      : d_(d), cells_(cells), faces_(faces_of_cells(cells)), across_(cells.boundary.size()) {}

  MovedMeans move() {
    find_ways();
    for (const Way& way : ways_) add(way);
    return std::move(moved_);
  }

 private:
  /// From C*_a to the centroid along the free faces; how far across each of them is known by faces.
  struct Way {
    Index particle;
    Vec3 in_plane;
  };
  struct Distance {
    double value = 0.0;
    bool known = false;
  };

  void find_ways() {
    std::vector<bool> is_held(d_.X.size());
    for (const BoundaryNode& f : d_.nodes) is_held[static_cast<std::size_t>(f.owner)] = true;
    for (Index a = 0; a < d_.particles(); ++a)
      if (!is_held[static_cast<std::size_t>(a)] && !boundary_faces(a).empty()) find_way(a);
  }

  /// Where free faces leave no direction, at corners, there is no stress to speak of.
  void find_way(Index a) {
    std::vector<Vec3> normals;
    for (const FaceOfCell& f : boundary_faces(a)) normals.push_back(normal(f));
    const Surface surface = surface_of(normals);
    if (surface.directions == 0) return;
    const auto k = static_cast<std::size_t>(a);
    const Vec3 way = d_.measure->centroid[k] - d_.X[k] - place_of_mean(d_, a, surface);
    const Vec3 in_plane = surface.in_plane * way;
    ways_.push_back({a, in_plane});
    for (const FaceOfCell& f : boundary_faces(a))
      across_[static_cast<std::size_t>(f.face)] = {dot(normal(f), surface.inverse * (way - in_plane)), true};
  }

  void add(const Way& way) {
    const Index a = way.particle;
    double size = norm(way.in_plane);
    for (const FaceOfCell& f : boundary_faces(a)) size += std::abs(mean_across(a, f.face));
    if (size < no_way * std::cbrt(volume(a))) return;
    add_derivative(a, way.in_plane);
    for (const FaceOfCell& f : boundary_faces(a))
      if (const Index b = behind(a, normal(f)); b >= 0) add_derivative(b, mean_across(a, f.face) * normal(f));
    finish_row(a);
  }

  /// The mean over the cell and its neighbours on the same side: what differs from cell to cell would be felt by a
  /// constant stress.
  double mean_across(Index a, Index face) const {
    double V = volume(a), sum = V * across_[static_cast<std::size_t>(face)].value;
    for (const FaceOfCell& f : interior_faces(faces_, a))
      for (const FaceOfCell& g : boundary_faces(f.neighbour)) {
        const Distance& distance = across_[static_cast<std::size_t>(g.face)];
        if (!distance.known || boundary(g.face).side != boundary(face).side) continue;
        V += volume(f.neighbour);
        sum += volume(f.neighbour) * distance.value;
      }
    return sum / V;
  }

  /// The neighbour across the largest face that is turned away from N; -1: there is none.
  Index behind(Index a, const Vec3& N) const {
    Index found = -1;
    double largest = 0.0;
    for (const FaceOfCell& f : interior_faces(faces_, a)) {
      const InteriorFace& face = cells_.interior[static_cast<std::size_t>(f.face)];
      const double turned_away = face.a == a ? -dot(N, face.area) : dot(N, face.area);
      if (turned_away > largest) largest = turned_away, found = f.neighbour;
    }
    return found;
  }

  void add_derivative(Index b, const Vec3& along) {
    for (const MeanTerm& t : derivative(d_, b, along)) row_.push_back(t);
  }

  /// One term for each particle; that of the cell itself would do nothing.
  void finish_row(Index a) {
    std::sort(row_.begin(), row_.end(), [](const MeanTerm& l, const MeanTerm& r) { return l.particle < r.particle; });
    std::vector<MeanTerm>& all = moved_.terms.value;
    const std::size_t first = all.size();
    for (const MeanTerm& t : row_) {
      if (t.particle == a) continue;
      if (all.size() > first && all.back().particle == t.particle)
        all.back().weight += t.weight;
      else
        all.push_back(t);
    }
    row_.clear();
    moved_.particles.push_back(a);
    moved_.terms.offset.push_back(static_cast<Offset>(all.size()));
  }

  std::span<const FaceOfCell> boundary_faces(Index a) const {
    return faces_.row(a).subspan(interior_faces(faces_, a).size());
  }
  const BoundaryFace& boundary(Index face) const { return cells_.boundary[static_cast<std::size_t>(face)]; }
  Vec3 normal(const FaceOfCell& f) const { return normalized(boundary(f.face).area); }
  double volume(Index a) const { return d_.volume[static_cast<std::size_t>(a)]; }

  const Discretization& d_;
  const Cells& cells_;
  Csr<FaceOfCell> faces_;
  std::vector<Way> ways_;
  std::vector<Distance> across_;  // of each boundary face
  std::vector<MeanTerm> row_;
  MovedMeans moved_;
};

}  // namespace

MovedMeans moved_means(const Discretization& d, const Cells& cells) { return MeanMover(d, cells).move(); }

}  // namespace tessera
