#include "tessera/discretization/curved_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi_common.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

namespace {

Symmetric3 about(const Symmetric3& integral, double area, const Vec3& offset) {
  return (1.0 / area) * integral + square(offset);
}

/// sum_c phi_fc Y_c (x) Y_c of interior faces.
class StencilSquares {
 public:
  StencilSquares(std::span<const Vec3> X, const Csr<FaceOfCell>& faces, const FacePositions& positions)
      : X_(X), faces_(faces), positions_(positions) {}

  Symmetric3 of(const InteriorFace& f, std::size_t k, const Vec3& middle) {
    const StencilFunction& w = positions_.interior[k];
    const double share = branch_share(f);
    Symmetric3 sum = (1.0 - share) * square(at(f.a) - middle) + share * square(at(f.b) - middle);
    if (w.is_zero()) return sum;
    const auto add = [&](Index c) {
      const Vec3 Y = at(c) - middle;
      sum += w(Y) * square(Y);
    };
    const std::span<const FaceOfCell> of_a = interior_faces(faces_, f.a), of_b = interior_faces(faces_, f.b);
    if (!positions_.is_widened[k]) {
      add(f.a);
      add(f.b);
      for (const Index place : common_.find(of_a, of_b)) add(of_a[static_cast<std::size_t>(place)].neighbour);
      return sum;
    }
    stencil_.clear();
    for (const FaceOfCell& g : of_a) stencil_.push_back(g.neighbour);
    for (const FaceOfCell& g : of_b) stencil_.push_back(g.neighbour);
    std::sort(stencil_.begin(), stencil_.end());
    stencil_.erase(std::unique(stencil_.begin(), stencil_.end()), stencil_.end());
    for (const Index c : stencil_) add(c);
    return sum;
  }

 private:
  const Vec3& at(Index a) const { return X_[static_cast<std::size_t>(a)]; }

  std::span<const Vec3> X_;
  const Csr<FaceOfCell>& faces_;
  const FacePositions& positions_;
  CommonNeighbours common_;
  std::vector<Index> stencil_;
};

bool is_resolved(const QuadraticFits& fits, Index a) { return fits.resolved[static_cast<std::size_t>(a)] != 0; }

std::vector<Symmetric3> interior_curvature(std::span<const Vec3> X, const Cells& cells, const Csr<FaceOfCell>& faces,
                                           const FacePositions& positions, const QuadraticFits& fits) {
  std::vector<Symmetric3> M(cells.interior.size());
  parallel::for_ranges(0, static_cast<std::int64_t>(M.size()), [&](std::int64_t begin, std::int64_t end) {
    StencilSquares squares(X, faces, positions);
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const InteriorFace& f = cells.interior[k];
      if (!is_resolved(fits, f.a) || !is_resolved(fits, f.b)) continue;
      const Vec3 middle = on_branch(f, X[static_cast<std::size_t>(f.a)], X[static_cast<std::size_t>(f.b)]);
      const Symmetric3 S = about(cells.interior_second_moment[k], norm(f.area), f.centroid - middle);
      M[k] = 0.5 * (S - squares.of(f, k, middle));
    }
  });
  return M;
}

/// M_f of boundary faces; zero where nothing of the face is free.
std::vector<Symmetric3> boundary_curvature(std::span<const Vec3> X, const Cells& cells, const FacePositions& positions,
                                           const QuadraticFits& fits) {
  std::vector<Symmetric3> M(cells.boundary.size());
  parallel::for_each(static_cast<std::int64_t>(M.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const BoundaryFace& f = cells.boundary[k];
    const std::span<const FaceTerm> position = positions.boundary.row(static_cast<Index>(i));
    if (!is_resolved(fits, f.owner) || position.empty()) return;
    const Vec3& X_a = X[static_cast<std::size_t>(f.owner)];
    Symmetric3 S = about(cells.boundary_second_moment[k], norm(f.area), f.centroid - X_a);
    for (const FaceTerm& t : position) S -= t.weight * square(X[static_cast<std::size_t>(t.particle)] - X_a);
    M[k] = 0.5 * S;
  });
  return M;
}

/// Adds up terms of the same particle.
void join(std::vector<FaceTerm>& terms) {
  std::stable_sort(terms.begin(), terms.end(),
                   [](const FaceTerm& l, const FaceTerm& r) { return l.particle < r.particle; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < terms.size(); ++i) {
    if (terms[i].particle == terms[last].particle)
      terms[last].weight += terms[i].weight;
    else
      terms[++last] = terms[i];
  }
  terms.resize(std::min(terms.size(), last + 1));
}

Csr<FaceTerm> boundary_positions(std::span<const Vec3> X, const Cells& cells, const FacePositions& positions,
                                 std::span<const Symmetric3> M, const QuadraticFits& fits) {
  return parallel::collect_rows<FaceTerm>(
      static_cast<Index>(M.size()), [&](Index k, parallel::RowCollector<FaceTerm>& out) {
        const std::span<const FaceTerm> linear = positions.boundary.row(k);
        if (linear.empty()) return;
        std::vector<FaceTerm> terms(linear.begin(), linear.end());
        const Index owner = cells.boundary[static_cast<std::size_t>(k)].owner;
        const auto a = static_cast<std::size_t>(owner);
        double sum = 0.0;
        for (const Index b : fits.stencil.row(owner)) {
          const double weight =
              contract(fits.fit[a].weights(X[static_cast<std::size_t>(b)] - X[a]), M[static_cast<std::size_t>(k)]);
          terms.push_back({b, weight});
          sum += weight;
        }
        terms.push_back({owner, -sum});
        join(terms);
        for (const FaceTerm& t : terms) out.add(t);
      });
}

Csr<CurvedFace> faces_of_particles(const Cells& cells, const Csr<FaceOfCell>& faces, std::span<const Symmetric3> M,
                                   const QuadraticFits& fits) {
  return parallel::collect_rows<CurvedFace>(
      static_cast<Index>(cells.volume.size()), [&](Index a, parallel::RowCollector<CurvedFace>& out) {
        if (!is_resolved(fits, a)) return;
        for (const FaceOfCell& g : interior_faces(faces, a)) {
          if (!is_resolved(fits, g.neighbour)) continue;
          const InteriorFace& f = cells.interior[static_cast<std::size_t>(g.face)];
          out.add({g.neighbour, f.a == a ? f.area : -f.area, M[static_cast<std::size_t>(g.face)]});
        }
      });
}

std::vector<CurvedSurface> free_surfaces(const Cells& cells, std::span<const Symmetric3> M, std::span<const Mat3> D,
                                         const QuadraticFits& fits) {
  std::vector<CurvedSurface> surfaces;
  for (std::size_t k = 0; k < M.size(); ++k) {
    const BoundaryFace& f = cells.boundary[k];
    if (!is_zero(D[k]) || !is_resolved(fits, f.owner)) continue;
    if (surfaces.empty() || surfaces.back().particle != f.owner) surfaces.push_back({f.owner, {}});
    const std::array<double, 6> m{M[k].xx, 2.0 * M[k].xy, 2.0 * M[k].xz, M[k].yy, 2.0 * M[k].yz, M[k].zz};
    for (std::size_t i = 0; i < 6; ++i) surfaces.back().area_moment[i] += m[i] * f.area;
  }
  return surfaces;
}

}  // namespace

FaceSpread face_spread(const Symmetric3& second_moment, double area) {
  Eigen::Matrix3d m;
  const Symmetric3& s = second_moment;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(m);  // the least eigenvalue is zero: along the normal
  const auto axis = [&](int k) {
    const Eigen::Vector3d v =
        std::sqrt(2.0 * std::max(eigen.eigenvalues()(k), 0.0) / area) * eigen.eigenvectors().col(k);
    return Vec3{v(0), v(1), v(2)};
  };
  return {axis(1), axis(2)};
}

CurvedFaces curved_faces(std::span<const Vec3> X, const Cells& cells, const Csr<FaceOfCell>& faces,
                         const FacePositions& positions, std::span<const Mat3> D) {
  CurvedFaces result;
  SecondOrder& s = result.second_order;
  s.fits = quadratic_fits(X, cells.volume, faces);
  s.faces = faces_of_particles(cells, faces, interior_curvature(X, cells, faces, positions, s.fits), s.fits);
  const std::vector<Symmetric3> M = boundary_curvature(X, cells, positions, s.fits);
  s.surfaces = free_surfaces(cells, M, D, s.fits);
  result.boundary = boundary_positions(X, cells, positions, M, s.fits);
  return result;
}

}  // namespace tessera
