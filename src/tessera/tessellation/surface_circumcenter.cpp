#include "tessera/tessellation/surface_circumcenter.hpp"

#include <cmath>
#include <limits>

namespace tessera {
namespace {

constexpr double kPlain = 1e-6;        // of normals that span more volume than this, ordinary arithmetic will do
constexpr long double kFlat = 1e-15L;  // normals that span less volume than this lie in one plane

template <class Real>
using Vector = std::array<Real, 3>;

template <class Real>
Vector<Real> cross_of(const Vector<Real>& a, const Vector<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Real>
Real dot_of(const Vector<Real>& a, const Vector<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The equations normal . x = value of three bisectors, x relative to the first generator.
template <class Real>
struct Bisectors {
  std::array<Vector<Real>, 3> normal;
  Vector<Real> value;

  Bisectors(const Generators& points, const std::array<Index, 4>& generators) {
    const Vec3& base = points[static_cast<std::size_t>(generators[0])];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& X = points[static_cast<std::size_t>(generators[i + 1])];
      for (int d = 0; d < 3; ++d)
        normal[i][static_cast<std::size_t>(d)] = static_cast<Real>(X[d]) - static_cast<Real>(base[d]);
      const Real length = std::sqrt(dot_of(normal[i], normal[i]));
      for (Real& n : normal[i]) n /= length;
      value[i] = length / 2;
      if (points.has_weights())
        value[i] +=
            (static_cast<Real>(points.weight(generators[0])) - static_cast<Real>(points.weight(generators[i + 1]))) /
            (2 * length);
    }
  }
  Real determinant() const { return dot_of(normal[0], cross_of(normal[1], normal[2])); }
  Vector<Real> solve(const Vector<Real>& right, Real det) const {
    const auto a = cross_of(normal[1], normal[2]), b = cross_of(normal[2], normal[0]),
               c = cross_of(normal[0], normal[1]);
    Vector<Real> x;
    for (std::size_t d = 0; d < 3; ++d) x[d] = (right[0] * a[d] + right[1] * b[d] + right[2] * c[d]) / det;
    return x;
  }
  Vector<Real> residual(const Vector<Real>& x) const {
    return {value[0] - dot_of(normal[0], x), value[1] - dot_of(normal[1], x), value[2] - dot_of(normal[2], x)};
  }
  Vector<Real> refined_solution(Real det) const {
    Vector<Real> x = solve(value, det);
    const Vector<Real> correction = solve(residual(x), det);
    for (std::size_t d = 0; d < 3; ++d) x[d] += correction[d];
    return x;
  }
  /// The point nearest to the first generator on the line that the two most different bisectors have in common.
  Vector<Real> on_common_line() const {
    std::size_t best = 0;
    Real largest = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = cross_of(normal[i], normal[(i + 1) % 3]);
      if (const Real size = dot_of(axis, axis); size > largest) best = i, largest = size;
    }
    const Vector<Real>&m = normal[best], &n = normal[(best + 1) % 3];
    const auto axis = cross_of(m, n), from_m = cross_of(n, axis), from_n = cross_of(axis, m);
    Vector<Real> x;
    for (std::size_t d = 0; d < 3; ++d) x[d] = (value[best] * from_m[d] + value[(best + 1) % 3] * from_n[d]) / largest;
    return x;
  }
};

template <class Real>
Vec3 moved(const Vec3& base, const Vector<Real>& x) {
  return {static_cast<double>(static_cast<Real>(base.x) + x[0]), static_cast<double>(static_cast<Real>(base.y) + x[1]),
          static_cast<double>(static_cast<Real>(base.z) + x[2])};
}

}  // namespace

Circumcenter circumcenter(const Generators& points, const std::array<Index, 4>& generators) {
  const Vec3& base = points[static_cast<std::size_t>(generators[0])];
  const Bisectors<double> plain(points, generators);
  const double determinant = plain.determinant();
  if (std::abs(determinant) > kPlain)
    return {moved(base, plain.refined_solution(determinant)), 1.0 / std::abs(determinant)};
  const Bisectors<long double> precise(points, generators);
  const long double flatness = precise.determinant();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (std::abs(flatness) > kFlat) return {moved(base, precise.refined_solution(flatness)), infinity};
  return {moved(base, precise.on_common_line()), infinity};
}

}  // namespace tessera
