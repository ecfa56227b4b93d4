#include "tessera/discretization/curved_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/to_eigen.hpp"
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

RawField<Symmetric3> interior_curvature(std::span<const Vec3> X, const Cells& cells, const Csr<FaceOfCell>& faces,
                                        const FacePositions& positions) {
  RawField<Symmetric3> M(cells.interior.size());
  parallel::for_ranges(0, static_cast<std::int64_t>(M.size()), [&](std::int64_t begin, std::int64_t end) {
    StencilSquares squares(X, faces, positions);
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const InteriorFace& f = cells.interior[k];
      const Vec3 middle = on_branch(f, X[static_cast<std::size_t>(f.a)], X[static_cast<std::size_t>(f.b)]);
      const Symmetric3 S = about(cells.interior_second_moment[k], norm(f.area), f.centroid - middle);
      M[k] = 0.5 * (S - squares.of(f, k, middle));
    }
  });
  return M;
}

/// M_f of a boundary face at this position.
Symmetric3 boundary_curvature(std::span<const Vec3> X, const Cells& cells, std::size_t k,
                              std::span<const FaceTerm> position) {
  const BoundaryFace& f = cells.boundary[k];
  const Vec3& X_a = X[static_cast<std::size_t>(f.owner)];
  Symmetric3 S = about(cells.boundary_second_moment[k], norm(f.area), f.centroid - X_a);
  for (const FaceTerm& t : position) S -= t.weight * square(X[static_cast<std::size_t>(t.particle)] - X_a);
  return 0.5 * S;
}

/// The same of all of them that follow particles.
std::vector<Symmetric3> boundary_curvature(std::span<const Vec3> X, const Cells& cells,
                                           const FacePositions& positions) {
  std::vector<Symmetric3> M(cells.boundary.size());
  parallel::for_each(static_cast<std::int64_t>(M.size()), [&](std::int64_t i) {
    const std::span<const FaceTerm> position = positions.boundary.row(static_cast<Index>(i));
    const auto k = static_cast<std::size_t>(i);
    if (!position.empty()) M[k] = boundary_curvature(X, cells, k, position);
  });
  return M;
}

/// Refused are cells that have several faces in common with one neighbour, for their curvature is not that of a bond.
std::vector<CellPlace> places_of(const Csr<FaceOfCell>& faces) {
  std::vector<CellPlace> places(static_cast<std::size_t>(faces.rows()), CellPlace::inside);
  const auto is_at_boundary = [&](Index a) {
    const std::span<const FaceOfCell> all = faces.row(a);
    return std::any_of(all.begin(), all.end(), [](const FaceOfCell& f) { return f.neighbour < 0; });
  };
  parallel::for_each(faces.rows(), [&](std::int64_t i) {
    CellPlace& place = places[static_cast<std::size_t>(i)];
    const auto a = static_cast<Index>(i);
    const std::span<const FaceOfCell> interior = interior_faces(faces, a);
    if (std::any_of(interior.begin(), interior.end(), [&](const FaceOfCell& f) { return is_at_boundary(f.neighbour); }))
      place = CellPlace::near_boundary;
    if (is_at_boundary(a)) place = CellPlace::at_boundary;
    for (std::size_t k = 0; k < interior.size(); ++k)
      if (is_repeated(interior, k)) place = CellPlace::refused;
  });
  return places;
}

/// The faces of the bonds between resolved cells.
RawField<Index> faces_of_bonds(const Discretization& d, const Csr<FaceOfCell>& faces,
                               const std::vector<char>& resolved) {
  RawField<Index> face(static_cast<std::size_t>(d.bonds.size()));
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<Index>(i);
    std::fill(face.begin() + d.bonds.begin(a), face.begin() + d.bonds.end(a), -1);
    if (!resolved[static_cast<std::size_t>(a)]) return;
    Offset bond = d.bonds.begin(a);  // both rows are ascending
    for (const FaceOfCell& g : interior_faces(faces, a)) {
      while (d.bonds.neighbour[static_cast<std::size_t>(bond)] < g.neighbour) ++bond;
      if (resolved[static_cast<std::size_t>(g.neighbour)]) face[static_cast<std::size_t>(bond)] = g.face;
    }
  });
  return face;
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

/// Positions of the boundary faces with second derivatives.
Csr<FaceTerm> boundary_positions(const Discretization& d, const Cells& cells, const FacePositions& positions,
                                 std::span<const Symmetric3> M, const SecondDerivatives& s) {
  return parallel::collect_rows<FaceTerm>(
      static_cast<Index>(M.size()), [&](Index k, parallel::RowCollector<FaceTerm>& out) {
        const std::span<const FaceTerm> linear = positions.boundary.row(k);
        if (linear.empty()) return;
        std::vector<FaceTerm> terms(linear.begin(), linear.end());
        const Index owner = cells.boundary[static_cast<std::size_t>(k)].owner;
        double sum = 0.0;
        for (const MeanTerm& t : contracted_curvature(d, s, owner, M[static_cast<std::size_t>(k)])) {
          terms.push_back({t.particle, t.weight});
          sum += t.weight;
        }
        terms.push_back({owner, -sum});
        join(terms);
        for (const FaceTerm& t : terms) out.add(t);
      });
}

std::vector<CurvedSurface> free_surfaces(const Cells& cells, std::span<const Symmetric3> M, std::span<const Mat3> D,
                                         const std::vector<char>& resolved) {
  std::vector<CurvedSurface> surfaces;
  for (std::size_t k = 0; k < M.size(); ++k) {
    const BoundaryFace& f = cells.boundary[k];
    if (!is_zero(D[k]) || !resolved[static_cast<std::size_t>(f.owner)]) continue;
    if (surfaces.empty() || surfaces.back().particle != f.owner) surfaces.push_back({f.owner, {}});
    const std::array<double, 6> m{M[k].xx, 2.0 * M[k].xy, 2.0 * M[k].xz, M[k].yy, 2.0 * M[k].yz, M[k].zz};
    for (std::size_t i = 0; i < 6; ++i) surfaces.back().area_moment[i] += m[i] * f.area;
  }
  return surfaces;
}

}  // namespace

FaceSpread face_spread(const Symmetric3& second_moment, double area) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      to_eigen(second_moment));  // the least eigenvalue is zero: along the normal
  const auto axis = [&](int k) {
    const Eigen::Vector3d v =
        std::sqrt(2.0 * std::max(eigen.eigenvalues()(k), 0.0) / area) * eigen.eigenvectors().col(k);
    return Vec3{v(0), v(1), v(2)};
  };
  return {axis(1), axis(2)};
}

CurvedFaces curved_faces(const Discretization& d, const Cells& cells, const Csr<FaceOfCell>& faces,
                         const FacePositions& positions, std::span<const Mat3> D) {
  CurvedFaces result;
  SecondOrder& s = result.second_order;
  const std::vector<Symmetric3> boundary = boundary_curvature(d.X, cells, positions);
  s.derivatives = second_derivatives(d, places_of(faces));
  s.M = interior_curvature(d.X, cells, faces, positions);
  s.face = faces_of_bonds(d, faces, s.derivatives.resolved);
  s.surfaces = free_surfaces(cells, boundary, D, s.derivatives.resolved);
  result.boundary = boundary_positions(d, cells, positions, boundary, s.derivatives);
  return result;
}

}  // namespace tessera
