#pragma once

#include <Eigen/Dense>
#include <map>
#include <set>

#include "support/reference_sums.hpp"
#include "support/small_bodies.hpp"

namespace tessera::test {

/// The consistent formulation written face by face: each face's position is an affine function of all particles,
/// c_f = c0_f + sum_b W_fb x_b; forces come from the chain rule, term by term.
class ConsistentReference {
 public:
  struct Face {
    std::map<std::size_t, Mat3> W;
    Mat3 from_wall;  // share of the wall's position
  };

  explicit ConsistentReference(const VoronoiBody& body)
      : X(body.X), cells(body.cells), near(X.size()), faces_of(X.size()) {
    for (const InteriorFace& f : cells.interior) {
      near[to(f.a)].insert(to(f.b));
      near[to(f.b)].insert(to(f.a));
    }
    for (const InteriorFace& f : cells.interior) {
      faces_of[to(f.a)].push_back({faces.size(), f.area});
      faces_of[to(f.b)].push_back({faces.size(), -f.area});
      faces.push_back(interior(f));
    }
    for (std::size_t i = 0; i < cells.boundary.size(); ++i) {
      faces_of[to(cells.boundary[i].owner)].push_back({faces.size(), cells.boundary[i].area});
      faces.push_back(boundary(cells.boundary[i], body.D[i]));
    }
  }

  Vec3 position(std::size_t f, const std::vector<Vec3>& x, const std::vector<Vec3>& walls) const {
    Vec3 c;
    for (const auto& [b, W] : faces[f].W) c += W * x[b];
    if (f >= cells.interior.size()) c += faces[f].from_wall * walls[f - cells.interior.size()];
    return c;
  }

  Mat3 deformation_gradient(std::size_t a, const std::vector<Vec3>& x, const std::vector<Vec3>& walls) const {
    Mat3 F;
    for (const auto& [f, area] : faces_of[a]) F += outer(position(f, x, walls), area);
    return (1.0 / cells.volume[a]) * F;
  }

  static std::size_t to(Index i) { return static_cast<std::size_t>(i); }

  std::vector<Vec3> X;
  const Cells& cells;
  std::vector<std::set<std::size_t>> near;
  std::vector<Face> faces;                                          // interior ones first
  std::vector<std::vector<std::pair<std::size_t, Vec3>>> faces_of;  // of each cell: face and outward area

 private:
  /// Least sum w_c^2 |y_c|^2 subject to sum w_c y_c = target and, where asked for, sum w_c = 0: the stationary point
  /// of the Lagrangian as one dense system. Empty when the conditions cannot be met with moderate weights.
  static std::vector<double> weights(const std::vector<Vec3>& y, const Vec3& target, int conditions) {
    const auto n = static_cast<Eigen::Index>(y.size());
    Eigen::MatrixXd C(conditions, n), system = Eigen::MatrixXd::Zero(n + conditions, n + conditions);
    Eigen::VectorXd goal = Eigen::VectorXd::Zero(conditions), right = Eigen::VectorXd::Zero(n + conditions);
    for (Eigen::Index c = 0; c < n; ++c) {
      const Vec3& p = y[static_cast<std::size_t>(c)];
      C.col(c).head(3) << p.x, p.y, p.z;
      if (conditions == 4) C(3, c) = 1.0;
      system(c, c) = norm2(p);
    }
    goal.head(3) << target.x, target.y, target.z;
    system.topRightCorner(n, conditions) = C.transpose();
    system.bottomLeftCorner(conditions, n) = C;
    right.tail(conditions) = goal;
    const Eigen::VectorXd solution = system.completeOrthogonalDecomposition().solve(right);
    const Eigen::VectorXd w = solution.head(n);
    double size = 0.0;
    for (Eigen::Index c = 0; c < n; ++c) size += w(c) * w(c) * system(c, c);
    if ((C * w - goal).norm() > 1e-9 * norm(target) || std::sqrt(size) > 10.0 * norm(target)) return {};
    return {w.data(), w.data() + n};
  }

  Face interior(const InteriorFace& f) const {
    const std::size_t a = to(f.a), b = to(f.b);
    const double s = std::clamp(f.cut, 0.1, 0.9);
    const Vec3 middle = X[a] + s * (X[b] - X[a]);
    std::set<std::size_t> narrow{a, b}, wide{a, b};
    for (std::size_t c : near[a]) {
      wide.insert(c);
      if (near[b].contains(c)) narrow.insert(c);
    }
    wide.insert(near[b].begin(), near[b].end());
    for (const auto& stencil : {narrow, wide}) {
      std::vector<Vec3> y;
      for (std::size_t c : stencil) y.push_back(X[c] - middle);
      const std::vector<double> w = weights(y, f.centroid - middle, 4);
      if (w.empty()) continue;
      Face face;
      std::size_t i = 0;
      for (std::size_t c : stencil) face.W[c] += w[i++] * identity();
      face.W[a] += (1.0 - s) * identity();
      face.W[b] += s * identity();
      return face;
    }
    throw std::runtime_error("degenerate stencil");
  }

  Face boundary(const BoundaryFace& f, const Mat3& D) const {
    Face face;
    face.from_wall = D;
    if (is_identity(D)) return face;
    const std::size_t a = to(f.owner);
    std::set<std::size_t> narrow = near[a], wide = near[a];
    for (std::size_t c : near[a]) wide.insert(near[c].begin(), near[c].end());
    wide.erase(a);
    const Mat3 free = identity() - D;
    for (const auto& stencil : {narrow, wide}) {
      std::vector<Vec3> y;
      for (std::size_t c : stencil) y.push_back(X[c] - X[a]);
      const std::vector<double> w = weights(y, f.centroid - X[a], 3);
      if (w.empty()) continue;
      std::size_t i = 0;
      face.W[a] += free;
      for (std::size_t c : stencil) {
        face.W[c] += w[i] * free;
        face.W[a] -= w[i++] * free;
      }
      return face;
    }
    throw std::runtime_error("degenerate stencil");
  }
};

/// V_a P_a, the derivatives of the strain energy with respect to the F_a.
inline std::vector<Mat3> nodal_energy_slopes(const ConsistentReference& r, const Material& m,
                                             const std::vector<Mat3>& F) {
  std::vector<Mat3> slopes;
  for (std::size_t a = 0; a < F.size(); ++a) slopes.push_back(r.cells.volume[a] * reference_stress(m, F[a]));
  return slopes;
}

/// The same with six points in each cell. F at a point is sum_b weight_b F_b: 1 for the cell itself, plus p . g_b for
/// the least squares' vectors g_b, which take the cell's own share with the opposite sign.
inline std::vector<Mat3> cell_energy_slopes(const ConsistentReference& r, const Material& m,
                                            const std::vector<Mat3>& F) {
  std::vector<Mat3> slopes(F.size());
  for (std::size_t a = 0; a < F.size(); ++a) {
    const std::vector<std::size_t> near(r.near[a].begin(), r.near[a].end());
    // Rows (C_b - C_a) / r of the least squares' system for the slope; its right side is (F_b - F_a) / r.
    Eigen::MatrixXd rows(near.size(), 3);
    std::vector<double> length;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Vec3 c = r.cells.centroid[near[i]] - r.cells.centroid[a];
      length.push_back(norm(c));
      rows.row(static_cast<Eigen::Index>(i)) << c.x / norm(c), c.y / norm(c), c.z / norm(c);
    }
    const Eigen::MatrixXd inverse = rows.completeOrthogonalDecomposition().pseudoInverse();
    const Mat3 p = cubature_points((1.0 / r.cells.volume[a]) * r.cells.second_moment[a]);
    for (int q = 0; q < 3; ++q)
      for (const double sign : {-1.0, 1.0}) {
        std::vector<double> weight;
        Mat3 at_point = F[a];
        for (std::size_t i = 0; i < near.size(); ++i) {
          double w = 0.0;
          for (int k = 0; k < 3; ++k) w += sign * p(k, q) * inverse(k, static_cast<Eigen::Index>(i)) / length[i];
          weight.push_back(w);
          at_point += w * (F[near[i]] - F[a]);
        }
        const Mat3 P = (r.cells.volume[a] / 6.0) * reference_stress(m, at_point);
        slopes[a] += P;
        for (std::size_t i = 0; i < near.size(); ++i) {
          slopes[near[i]] += weight[i] * P;
          slopes[a] -= weight[i] * P;
        }
      }
  }
  return slopes;
}

/// Forces on the particles and on the walls of the boundary faces.
struct ConsistentReferenceForces {
  std::vector<Mat3> F;
  std::vector<Vec3> particles, walls;

  ConsistentReferenceForces(const ConsistentReference& r, const VoronoiBody& body, const Material& m,
                            const std::vector<Vec3>& x, const std::vector<Vec3>& wall_positions,
                            Integration integration = Integration::nodal)
      : particles(x.size()), walls(wall_positions.size()) {
    for (std::size_t a = 0; a < x.size(); ++a) F.push_back(r.deformation_gradient(a, x, wall_positions));
    const std::vector<Mat3> energy_slopes =
        integration == Integration::cell ? cell_energy_slopes(r, m, F) : nodal_energy_slopes(r, m, F);
    for (std::size_t a = 0; a < x.size(); ++a) hand_on_strain(r, a, energy_slopes[a]);
    for (const InteriorFace& f : r.cells.interior) add_bond(r, m, x, f);
    for (std::size_t i = 0; i < body.D.size(); ++i)
      add_boundary_bond(r, m, x, wall_positions, r.cells.boundary[i], body.D[i], r.cells.interior.size() + i);
  }

 private:
  /// The forces of a change dF_a of F_a that costs the energy S : dF_a.
  void hand_on_strain(const ConsistentReference& r, std::size_t a, const Mat3& S) {
    for (const auto& [f, area] : r.faces_of[a]) hand_on_position(r, f, (1.0 / r.cells.volume[a]) * (S * area));
  }

  /// The forces of a change dc_f of a face's position that costs the energy g . dc_f.
  void hand_on_position(const ConsistentReference& r, std::size_t f, const Vec3& g) {
    for (const auto& [b, W] : r.faces[f].W) particles[b] -= transpose(W) * g;
    if (f >= r.cells.interior.size()) walls[f - r.cells.interior.size()] -= r.faces[f].from_wall * g;
  }

  void add_bond(const ConsistentReference& r, const Material& m, const std::vector<Vec3>& x, const InteriorFace& f) {
    const auto a = static_cast<std::size_t>(f.a), b = static_cast<std::size_t>(f.b);
    const Vec3 X_ab = r.X[b] - r.X[a];
    const double k = norm(f.area) / norm(X_ab);
    const ReferenceBond bond =
        reference_bond(m.contact.normal * m.young * k, m.contact.tangential * m.shear_modulus() * k, x[b] - x[a],
                       0.5 * ((F[a] + F[b]) * X_ab));
    particles[a] += bond.dU_dx;
    particles[b] -= bond.dU_dx;
    for (std::size_t end : {a, b}) hand_on_strain(r, end, 0.5 * outer(bond.dU_dy, X_ab));
  }

  void add_boundary_bond(const ConsistentReference& r, const Material& m, const std::vector<Vec3>& x,
                         const std::vector<Vec3>& wall_positions, const BoundaryFace& f, const Mat3& D,
                         std::size_t face) {
    const auto a = static_cast<std::size_t>(f.owner);
    const Vec3 N = normalized(f.area), Y = f.centroid - r.X[a];
    const double L = std::max(2.0 * std::abs(dot(N, Y)), 0.25 * std::cbrt(r.cells.volume[a]));
    const double k = 4.0 * norm(f.area) / L;
    const Vec3 u = D * (r.position(face, x, wall_positions) - x[a] - F[a] * Y);
    const ReferenceBoundaryBond bond = reference_boundary_bond(m, k, D, N, u, F[a]);
    hand_on_position(r, face, bond.dU_du);
    particles[a] += bond.dU_du;
    hand_on_strain(r, a, bond.dU_dF - outer(bond.dU_du, Y));
  }
};

}  // namespace tessera::test
