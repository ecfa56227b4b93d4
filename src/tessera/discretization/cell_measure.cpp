#include "tessera/discretization/cell_measure.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "tessera/discretization/to_eigen.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

/// Eigenvalues of K below this part of the largest one: neighbours do not extend in that direction. A layer of cells
/// whose centroids are out of one plane by a fifth of their distance is above it.
constexpr double unresolved_below = 0.04;

using Eigen::Matrix3d;
using Eigen::Vector3d;

Mat3 to_mat3(const Matrix3d& e) {
  Mat3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = e(i, j);
  return m;
}

struct ResolvedInverse {
  Matrix3d inverse = Matrix3d::Zero();
  int directions = 0;  // that are resolved
};

ResolvedInverse resolved_inverse(const Symmetric3& K) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(to_eigen(K));
  ResolvedInverse result;
  const double largest = eigen.eigenvalues()(2);
  for (int i = 0; i < 3; ++i) {
    const double value = eigen.eigenvalues()(i);
    if (!(value > unresolved_below * largest)) continue;
    const Vector3d v = eigen.eigenvectors().col(i);
    result.inverse += v * v.transpose() / value;
    ++result.directions;
  }
  return result;
}

/// Calls take(b, C_ab) for the neighbours with a common face.
template <class Take>
void for_each_difference(const Discretization& d, Index a, Take&& take) {
  const std::vector<Vec3>& C = d.measure->centroid;
  d.for_each_face_neighbour(
      a, [&](Offset, Index b) { take(b, C[static_cast<std::size_t>(b)] - C[static_cast<std::size_t>(a)]); });
}

/// K_a^-1.
ResolvedInverse inverse_of_fit(const Discretization& d, Index a) {
  Symmetric3 K;
  for_each_difference(d, a, [&](Index, const Vec3& C_ab) { K += (1.0 / norm2(C_ab)) * square(C_ab); });
  return resolved_inverse(K);
}

}  // namespace

Mat3 cubature_points(const Symmetric3& second_moment) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(to_eigen(3.0 * second_moment));
  const Vector3d roots = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return to_mat3(eigen.eigenvectors() * roots.asDiagonal() * eigen.eigenvectors().transpose());
}

CellMeasure measure_of_cells(const Cells& cells) {
  CellMeasure m{cells.centroid, cells.second_moment};
  for (std::size_t a = 0; a < m.second_moment.size(); ++a) m.second_moment[a] *= 1.0 / cells.volume[a];
  return m;
}

CellMeasure measure_of_dual_cells(const TetrahedralMesh& mesh) {
  const std::size_t n = mesh.points.size();
  std::vector<double> volume(n, 0.0);  // of the clusters, four times that of the cells
  std::vector<Vec3> first(n);
  CellMeasure m{{}, std::vector<Symmetric3>(n)};
  const auto point = [&](Index i) { return mesh.points[static_cast<std::size_t>(i)]; };
  for (const std::array<Index, 4>& t : mesh.tetrahedra)
    for (const Index i : t) {
      const auto a = static_cast<std::size_t>(i);
      Vec3 sum;
      Symmetric3 squares;
      for (const Index j : t) {
        const Vec3 edge = point(j) - point(i);  // zero at the particle itself
        sum += edge;
        squares += square(edge);
      }
      const Vec3 X = point(t[0]);
      const double V = dot(point(t[1]) - X, cross(point(t[2]) - X, point(t[3]) - X)) / 6.0;
      // Means over the six tetrahedra (corner, middle of edge j, of face jk, of all) of equal volume V/24.
      volume[a] += V;
      first[a] += (V * 23.0 / 144.0) * sum;
      m.second_moment[a] += V * ((2.0 / 135.0) * squares + (97.0 / 4320.0) * square(sum));
    }
  for (std::size_t a = 0; a < n; ++a) {
    const Vec3 C = first[a] / volume[a];
    m.centroid.push_back(mesh.points[a] + C);
    m.second_moment[a] = (1.0 / volume[a]) * m.second_moment[a] - square(C);
  }
  return m;
}

CellGradients cell_gradients(const Discretization& d) {
  CellGradients g;
  g.to_points.resize(d.X.size());
  g.unresolved = parallel::sum<Index>(d.particles(), [&](std::int64_t row) {
    const auto a = static_cast<Index>(row);
    const ResolvedInverse inverse = inverse_of_fit(d, a);
    g.to_points[static_cast<std::size_t>(a)] =
        to_mat3(inverse.inverse) * cubature_points(d.measure->second_moment[static_cast<std::size_t>(a)]);
    return inverse.directions < 3 ? 1 : 0;
  });
  return g;
}

std::vector<MeanTerm> derivative(const Discretization& d, Index a, const Vec3& v) {
  const Vec3 along = to_mat3(inverse_of_fit(d, a).inverse) * v;
  std::vector<MeanTerm> terms;
  double sum = 0.0;
  for_each_difference(d, a, [&](Index b, const Vec3& C_ab) {
    terms.push_back({b, dot(C_ab, along) / norm2(C_ab)});
    sum += terms.back().weight;
  });
  terms.push_back({a, -sum});
  return terms;
}

}  // namespace tessera
