#include "tessera/discretization/curved_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tessera/discretization/first_derivatives.hpp"
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

std::vector<Symmetric3> interior_curvature(std::span<const Vec3> X, const Cells& cells, const Csr<FaceOfCell>& faces,
                                           const FacePositions& positions) {
  std::vector<Symmetric3> M(cells.interior.size());
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

/// Curvature of all faces by the particles alone, and what goes with it.
struct Curvature {
  std::vector<Symmetric3> interior, boundary;
  std::vector<char> spans;  // of boundary faces: 0 where no particles span the way there
};

Curvature curvature(const Discretization& d, const Cells& cells, const Csr<FaceOfCell>& faces,
                    const FacePositions& positions, std::span<const Index> held, const SecondOrder& s) {
  Curvature c{interior_curvature(d.X, cells, faces, positions), std::vector<Symmetric3>(cells.boundary.size()),
              std::vector<char>(cells.boundary.size(), 1)};
  std::vector<Index> row(cells.boundary.size(), -1);
  for (std::size_t i = 0; i < held.size(); ++i) row[static_cast<std::size_t>(held[i])] = static_cast<Index>(i);
  parallel::for_each(static_cast<std::int64_t>(row.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const std::span<const FaceTerm> position =
        row[k] >= 0 ? s.extrapolated.row(row[k]) : positions.boundary.row(static_cast<Index>(i));
    c.spans[k] = !position.empty();
    if (c.spans[k]) c.boundary[k] = boundary_curvature(d.X, cells, k, position);
  });
  return c;
}

/// How far the means F'_a are from those over the cells.
std::vector<MeanError> mean_errors(const Cells& cells, const Csr<FaceOfCell>& faces, const Curvature& c) {
  std::vector<MeanError> errors(cells.volume.size());
  parallel::for_each(static_cast<std::int64_t>(errors.size()), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    for (const FaceOfCell& g : faces.row(static_cast<Index>(i))) {
      const auto k = static_cast<std::size_t>(g.face);
      const bool inside = g.neighbour >= 0;
      const Vec3 area = !inside                                        ? cells.boundary[k].area
                        : cells.interior[k].a == static_cast<Index>(i) ? cells.interior[k].area
                                                                       : -cells.interior[k].area;
      for (std::size_t j = 0; j < 3; ++j)
        errors[a][j] -= (area[static_cast<int>(j)] / cells.volume[a]) * (inside ? c.interior[k] : c.boundary[k]);
    }
  });
  return errors;
}

/// F'_a of the undeformed body, the identity but for a layer of cells whose way to a side no particles span.
Mat3 undeformed(const Discretization& d, const FirstDerivatives& F, Index a) {
  const auto k = static_cast<std::size_t>(a);
  Mat3 sum;
  F.for_each_term(a, [&](Index b, const Vec3& B) { sum += outer(d.X[static_cast<std::size_t>(b)] - d.X[k], B); });
  return (1.0 / d.volume[k]) * sum;
}

/// Cells without second derivatives: those that have several faces in common with one neighbour (their curvature is
/// not that of a bond), and those whose first derivatives are not comparable with their neighbours'.
std::vector<char> refused_cells(const Discretization& d, const Csr<FaceOfCell>& faces, const SecondOrder& s,
                                const Curvature& c) {
  std::vector<char> refused(d.X.size(), 0);
  std::vector<Mat3> start(d.X.size());
  const FirstDerivatives F(d, s);
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    start[static_cast<std::size_t>(i)] = undeformed(d, F, static_cast<Index>(i));
  });
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<Index>(i);
    bool bad = false;
    const std::span<const FaceOfCell> interior = interior_faces(faces, a);
    for (std::size_t k = 0; k < interior.size(); ++k) bad = bad || is_repeated(interior, k);
    for (const FaceOfCell& g : faces.row(a))
      bad = bad || (g.neighbour < 0 && c.spans[static_cast<std::size_t>(g.face)] == 0);
    F.for_each_neighbour(a, [&](Index b) {
      const Mat3 change = start[static_cast<std::size_t>(b)] - start[static_cast<std::size_t>(a)];
      bad = bad || contract(change, change) > 1e-16;
    });
    refused[static_cast<std::size_t>(i)] = bad;
  });
  return refused;
}

/// M_f of the bonds between resolved cells.
RawField<Symmetric3> curvature_of_bonds(const Discretization& d, const Csr<FaceOfCell>& faces,
                                        const std::vector<Symmetric3>& interior, const std::vector<char>& resolved) {
  RawField<Symmetric3> M(static_cast<std::size_t>(d.bonds.size()), Symmetric3{});
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<Index>(i);
    if (!resolved[static_cast<std::size_t>(a)]) return;
    for (const FaceOfCell& g : interior_faces(faces, a))
      if (resolved[static_cast<std::size_t>(g.neighbour)])
        M[static_cast<std::size_t>(d.bonds.find(a, g.neighbour))] = interior[static_cast<std::size_t>(g.face)];
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

/// Positions of the boundary faces with second derivatives.
Csr<FaceTerm> boundary_positions(const Discretization& d, const Cells& cells, const FacePositions& positions,
                                 std::span<const Symmetric3> M, const SecondOrder& s) {
  return parallel::collect_rows<FaceTerm>(static_cast<Index>(M.size()),
                                          [&](Index k, parallel::RowCollector<FaceTerm>& out) {
                                            const std::span<const FaceTerm> linear = positions.boundary.row(k);
                                            if (linear.empty()) return;
                                            std::vector<FaceTerm> terms(linear.begin(), linear.end());
                                            const Index owner = cells.boundary[static_cast<std::size_t>(k)].owner;
                                            double sum = 0.0;
                                            for (const CurvatureTerm& t : mean_curvature(d, s, cells.centroid, owner)) {
                                              const double weight = contract(t.W, M[static_cast<std::size_t>(k)]);
                                              terms.push_back({t.particle, weight});
                                              sum += weight;
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

/// The boundary faces that have nodes, and where the particles see them.
std::vector<Index> held_faces(const Discretization& d, const Cells& cells, const Csr<FaceOfCell>& faces,
                              std::span<const Mat3> D, SecondOrder& s) {
  std::vector<Index> held;
  for (std::size_t k = 0; k < cells.boundary.size(); ++k) {
    if (is_zero(D[k])) continue;
    held.push_back(static_cast<Index>(k));
    s.held.push_back({cells.boundary[k].owner, cells.boundary[k].area});
  }
  s.extrapolated = extrapolated_positions(d.X, cells, faces, D, held);
  return held;
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

CurvedFaces curved_faces(const Discretization& d, const Cells& cells, const Csr<FaceOfCell>& faces,
                         const FacePositions& positions, std::span<const Mat3> D) {
  CurvedFaces result;
  SecondOrder& s = result.second_order;
  const std::vector<Index> held = held_faces(d, cells, faces, D, s);
  const Curvature c = curvature(d, cells, faces, positions, held, s);
  s.derivatives = second_derivatives(d, s, cells.centroid, mean_errors(cells, faces, c), refused_cells(d, faces, s, c));
  s.M = curvature_of_bonds(d, faces, c.interior, s.derivatives.resolved);
  s.surfaces = free_surfaces(cells, c.boundary, D, s.derivatives.resolved);
  result.boundary = boundary_positions(d, cells, positions, c.boundary, s);
  return result;
}

}  // namespace tessera
