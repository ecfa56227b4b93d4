#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <array>

#include "support/consistent_reference.hpp"
#include "support/quadratic_weights.hpp"
#include "tessera/discretization/second_derivatives.hpp"

namespace tessera::test {

/// A point of a cell's cubature, relative to the cell's centroid.
struct ReferencePoint {
  double weight;
  Vec3 p;
};

/// The second-order consistent formulation as a few large sparse matrices: positions of faces c = C x + C_w w, second
/// derivatives h = H x, deformation gradients F = S c, and the energy with its gradient by the chain rule through them.
/// Stencils, q_a and which cells use means are given; what they are is for other tests.
class SecondOrderReference {
 public:
  using Vector = Eigen::VectorXd;
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  std::vector<std::vector<ReferencePoint>> cubature;  // of each cell

  SecondOrderReference(const VoronoiBody& body, const Material& m, const SecondDerivatives& given)
      : linear(body), body_(body), m_(m), n_(body.X.size()), H_(n_), W_(n_), given_(given), resolved_(given.resolved) {
    for (std::size_t a = 0; a < n_; ++a) cubature.push_back(six_points(a));
    find_derivatives();
    assemble();
  }

  /// +-sqrt(3) times the columns of the symmetric root of the second moment.
  std::vector<ReferencePoint> six_points(std::size_t a) const {
    const Mat3 m = (1.0 / body_.cells.volume[a]) * to_mat3(body_.cells.second_moment[a]);
    Eigen::Matrix3d M;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) M(i, j) = m(i, j);
    const Eigen::Matrix3d L = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(M).operatorSqrt();
    std::vector<ReferencePoint> points;
    for (int k = 0; k < 3; ++k)
      for (double sign : {1.0, -1.0})
        points.push_back({1.0 / 6.0, (sign * std::sqrt(3.0)) * Vec3{L(0, k), L(1, k), L(2, k)}});
    return points;
  }

  struct Result {
    double internal = 0.0, contact = 0.0;
    Vector gx, gw;  // derivatives with respect to particles and walls
    Vector F, h;    // 9 numbers (row first) and 18 (xx, xy, xz, yy, yz, zz of x, y, z) a particle
  };

  Result evaluate(const Vector& x, const Vector& w) const {
    Result r;
    const Vector c = C * x + C_w * w;
    r.F = S * c;
    r.h = H * x;
    Vector gF = Vector::Zero(r.F.size()), gh = Vector::Zero(r.h.size()), gc = Vector::Zero(c.size());
    r.gx = Vector::Zero(x.size());
    for (std::size_t a = 0; a < n_; ++a)
      if (resolved_[a])
        add_cell(a, derivatives(r.h, a), r, gF, [&](std::size_t k, const Mat3& g) { add_derivatives(gh, a, k, g); });
      else
        add_unresolved(a, r, gF);
    for (const InteriorFace& f : body_.cells.interior) add_bond(f, x, r, gF);
    for (std::size_t i = 0; i < body_.cells.boundary.size(); ++i) add_boundary_bond(i, x, c, r, gF, gc);
    gc += S.transpose() * gF;
    r.gx += C.transpose() * gc + H.transpose() * gh;
    r.gw = C_w.transpose() * gc;
    return r;
  }

  Vector flat(const std::vector<Vec3>& v) const {
    Vector f(static_cast<Eigen::Index>(3 * v.size()));
    for (std::size_t a = 0; a < v.size(); ++a)
      for (int i = 0; i < 3; ++i) f(static_cast<Eigen::Index>(3 * a) + i) = v[a][i];
    return f;
  }

  /// The derivatives of F, dF(k) = d F / d X_k, from the second derivatives.
  static std::array<Mat3, 3> derivatives(const Vector& h, std::size_t a) {
    constexpr std::array<std::array<int, 3>, 3> place{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
    std::array<Mat3, 3> d;
    for (std::size_t k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          d[k](i, j) = h(static_cast<Eigen::Index>(18 * a) + 3 * place[k][static_cast<std::size_t>(j)] + i);
    return d;
  }

  Mat3 gradient(const Vector& F, std::size_t a) const {
    Mat3 m;
    for (std::size_t i = 0; i < 9; ++i) m.m[i] = F(static_cast<Eigen::Index>(9 * a + i));
    return m;
  }

  ConsistentReference linear;
  Sparse C, C_w, H, S;

 private:
  static void add_derivatives(Vector& gh, std::size_t a, std::size_t k, const Mat3& g) {
    constexpr std::array<std::array<int, 3>, 3> place{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        gh(static_cast<Eigen::Index>(18 * a) + 3 * place[k][static_cast<std::size_t>(j)] + i) += g(i, j);
  }
  static void add_gradient(Vector& gF, std::size_t a, const Mat3& g) {
    for (std::size_t i = 0; i < 9; ++i) gF(static_cast<Eigen::Index>(9 * a + i)) += g.m[i];
  }
  static Vec3 part(const Vector& x, std::size_t a) {
    const auto k = static_cast<Eigen::Index>(3 * a);
    return {x(k), x(k + 1), x(k + 2)};
  }
  static void add(Vector& x, std::size_t a, const Vec3& v) {
    for (int i = 0; i < 3; ++i) x(static_cast<Eigen::Index>(3 * a) + i) += v[i];
  }

  using Weights = std::map<std::size_t, std::array<double, 6>>;

  static void add(Weights& to, std::size_t b, double factor, const std::array<double, 6>& w) {
    for (std::size_t r = 0; r < 6; ++r) to[b][r] += factor * w[r];
  }

  /// H_a from the positions of its stencil, and what cells use: H_a itself, or the weighted mean with the neighbours'.
  void find_derivatives() {
    for (std::size_t a = 0; a < n_; ++a) {
      if (!resolved_[a]) continue;
      std::vector<std::size_t> stencil(linear.near[a].begin(), linear.near[a].end());
      for (const Index b : given_.far.row(static_cast<Index>(a))) stencil.push_back(static_cast<std::size_t>(b));
      std::vector<Vec3> branches;
      for (const std::size_t b : stencil) branches.push_back(body_.X[b] - body_.X[a]);
      const std::vector<std::array<double, 6>> w = quadratic_weights(branches);
      for (std::size_t i = 0; i < w.size(); ++i) {
        add(H_[a], stencil[i], 1.0, w[i]);
        add(H_[a], a, -1.0, w[i]);
      }
    }
    for (std::size_t a = 0; a < n_; ++a) {
      if (!resolved_[a]) continue;
      std::set<std::size_t> cells{a};
      if (given_.averaged[a]) cells.insert(linear.near[a].begin(), linear.near[a].end());
      double sum = 0.0;
      for (const std::size_t b : cells) sum += given_.weight[b];
      for (const std::size_t b : cells)
        for (const auto& [c, w] : H_[b]) add(W_[a], c, given_.weight[b] / sum, w);
    }
  }

  /// c += (factor H : M) as weights of particles.
  static void add_curvature(std::map<std::size_t, double>& c, const Weights& H, double factor, const Mat3& M) {
    for (const auto& [b, w] : H)
      c[b] += factor * (w[0] * M(0, 0) + w[3] * M(1, 1) + w[5] * M(2, 2) +
                        2.0 * (w[1] * M(0, 1) + w[2] * M(0, 2) + w[4] * M(1, 2)));
  }

  Mat3 curvature(const std::map<std::size_t, double>& c, const Vec3& origin, const Mat3& mean_square) const {
    Mat3 M = mean_square;
    for (const auto& [b, w] : c) M -= w * outer(body_.X[b] - origin, body_.X[b] - origin);
    return 0.5 * M;
  }

  Mat3 mean_square(const Symmetric3& integral, const Vec3& area, const Vec3& offset) const {
    return (1.0 / norm(area)) * to_mat3(integral) + outer(offset, offset);
  }

  void assemble() {
    std::vector<Eigen::Triplet<double>> c, c_w, s, h;
    const auto put = [](auto& list, std::size_t row, std::size_t column, double v) {
      list.emplace_back(static_cast<int>(row), static_cast<int>(column), v);
    };
    const Cells& cells = body_.cells;
    const std::size_t interior = cells.interior.size();
    for (std::size_t f = 0; f < linear.faces.size(); ++f) {
      const bool inside = f < interior;
      const Mat3 D = inside ? Mat3{} : body_.D[f - interior];
      const Mat3 free = identity() - D;
      std::map<std::size_t, double> phi;
      for (const auto& [b, W] : linear.faces[f].W) phi[b] = trace(W) / trace(free);
      if (inside) {
        const InteriorFace& face = cells.interior[f];
        const auto a = static_cast<std::size_t>(face.a), b = static_cast<std::size_t>(face.b);
        const Vec3 middle = 0.5 * (body_.X[a] + body_.X[b]);
        const Mat3 M =
            curvature(phi, middle, mean_square(cells.interior_second_moment[f], face.area, face.centroid - middle));
        if (resolved_[a] && resolved_[b]) {
          const double sum = given_.weight[a] + given_.weight[b];
          add_curvature(phi, H_[a], given_.weight[a] / sum, M);
          add_curvature(phi, H_[b], given_.weight[b] / sum, M);
        }
      } else {
        const BoundaryFace& face = cells.boundary[f - interior];
        const auto a = static_cast<std::size_t>(face.owner);
        const Mat3 square =
            mean_square(cells.boundary_second_moment[f - interior], face.area, face.centroid - body_.X[a]);
        if (resolved_[a] && !phi.empty()) add_curvature(phi, W_[a], 1.0, curvature(phi, body_.X[a], square));
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) put(c_w, 3 * f + i, 3 * (f - interior) + j, D.m[3 * i + j]);
      }
      for (const auto& [b, w] : phi)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) put(c, 3 * f + i, 3 * b + j, w * free.m[3 * i + j]);
    }
    for (std::size_t a = 0; a < n_; ++a) {
      for (const auto& [f, area] : linear.faces_of[a])
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            put(s, 9 * a + 3 * i + j, 3 * f + i, area[static_cast<int>(j)] / cells.volume[a]);
      for (const auto& [b, w] : W_[a])
        for (std::size_t k = 0; k < 6; ++k)
          for (std::size_t i = 0; i < 3; ++i) put(h, 18 * a + 3 * k + i, 3 * b + i, w[k]);
    }
    const auto build = [](Sparse& matrix, std::size_t rows, std::size_t columns, const auto& list) {
      matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
      matrix.setFromTriplets(list.begin(), list.end());
    };
    build(C, 3 * linear.faces.size(), 3 * n_, c);
    build(C_w, 3 * linear.faces.size(), 3 * cells.boundary.size(), c_w);
    build(S, 9 * n_, 3 * linear.faces.size(), s);
    build(H, 18 * n_, 3 * n_, h);
  }

  template <class Take>
  void add_cell(std::size_t a, const std::array<Mat3, 3>& dF, Result& r, Vector& gF, const Take& take) const {
    const Mat3 F = gradient(r.F, a);
    const double V = body_.cells.volume[a];
    const NeoHookean& law = std::get<NeoHookean>(m_.law);
    for (const ReferencePoint& q : cubature[a]) {
      const Mat3 F_q = F + q.p.x * dF[0] + q.p.y * dF[1] + q.p.z * dF[2];
      r.internal += V * q.weight * law.energy(F_q);
      const Mat3 P = (V * q.weight) * reference_stress(m_, F_q);
      add_gradient(gF, a, P);
      for (std::size_t k = 0; k < 3; ++k) take(k, q.p[static_cast<int>(k)] * P);
    }
  }

  /// The derivatives of F by weighted least squares from the neighbours' F.
  void add_unresolved(std::size_t a, Result& r, Vector& gF) const {
    const std::vector<Vec3>& X_c = body_.cells.centroid;
    Mat3 K;
    for (std::size_t b : linear.near[a]) K += (1.0 / norm2(X_c[b] - X_c[a])) * outer(X_c[b] - X_c[a], X_c[b] - X_c[a]);
    std::array<Mat3, 3> dF;
    std::map<std::size_t, Vec3> w;
    for (std::size_t b : linear.near[a]) {
      w[b] = (1.0 / norm2(X_c[b] - X_c[a])) * (inverse(K) * (X_c[b] - X_c[a]));
      for (int k = 0; k < 3; ++k) dF[static_cast<std::size_t>(k)] += w[b][k] * (gradient(r.F, b) - gradient(r.F, a));
    }
    add_cell(a, dF, r, gF, [&](std::size_t k, const Mat3& g) {
      for (const auto& [b, weight] : w) {
        add_gradient(gF, b, weight[static_cast<int>(k)] * g);
        add_gradient(gF, a, -weight[static_cast<int>(k)] * g);
      }
    });
  }

  void add_bond(const InteriorFace& f, const Vector& x, Result& r, Vector& gF) const {
    const auto a = static_cast<std::size_t>(f.a), b = static_cast<std::size_t>(f.b);
    const Vec3 X_ab = body_.X[b] - body_.X[a];
    const double k = norm(f.area) / norm(X_ab);
    const double Kn = m_.contact.normal * m_.young * k, Kt = m_.contact.tangential * m_.shear_modulus() * k;
    const Vec3 x_ab = part(x, b) - part(x, a), y_ab = 0.5 * ((gradient(r.F, a) + gradient(r.F, b)) * X_ab);
    const ReferenceBond bond = reference_bond(Kn, Kt, x_ab, y_ab);
    const Vec3 u = x_ab - y_ab, u_n = dot(u, normalized(x_ab)) * normalized(x_ab), u_t = u - u_n;
    r.contact += 0.5 * Kn * norm2(u_n) + 0.5 * Kt * norm2(u_t);
    add(r.gx, b, bond.dU_dx);
    add(r.gx, a, -bond.dU_dx);
    for (std::size_t end : {a, b}) add_gradient(gF, end, 0.5 * outer(bond.dU_dy, X_ab));
  }

  void add_boundary_bond(std::size_t i, const Vector& x, const Vector& c, Result& r, Vector& gF, Vector& gc) const {
    const BoundaryFace& f = body_.cells.boundary[i];
    const std::size_t a = static_cast<std::size_t>(f.owner), face = body_.cells.interior.size() + i;
    const Mat3& D = body_.D[i];
    const Vec3 N = normalized(f.area), Y = f.centroid - body_.X[a];
    const double L = std::max(2.0 * std::abs(dot(N, Y)), 0.25 * std::cbrt(body_.cells.volume[a]));
    const double k = 4.0 * norm(f.area) / L;
    const Vec3 u = D * (part(c, face) - part(x, a) - gradient(r.F, a) * Y);
    const ReferenceBoundaryBond bond = reference_boundary_bond(m_, k, D, N, u, gradient(r.F, a));
    r.contact += bond.energy;
    add(gc, face, bond.dU_du);
    add(r.gx, a, -bond.dU_du);
    add_gradient(gF, a, bond.dU_dF - outer(bond.dU_du, Y));
  }

  const VoronoiBody& body_;
  Material m_;
  std::size_t n_;
  std::vector<Weights> H_, W_;  // second derivatives, and those that cells use
  const SecondDerivatives& given_;
  std::vector<char> resolved_;
};

}  // namespace tessera::test
