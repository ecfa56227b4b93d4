#include "tessera/discretization/identities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/error.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

constexpr double tolerance = 1e-10;

/// The larger one; NaN stays.
double larger(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

double magnitude(const Mat3& m) { return std::sqrt(contract(m, m)); }

/// A sum that should vanish, and the size of its terms.
struct Balance {
  Vec3 sum;
  double size = 0.0;

  void add(const Vec3& v) {
    sum += v;
    size += norm(v);
  }
  double violation() const { return size == 0.0 ? 0.0 : norm(sum) / size; }
};

double worst(const std::vector<Balance>& balances) {
  double w = 0.0;
  for (const Balance& b : balances) w = larger(w, b.violation());
  return w;
}

double duality(const Discretization& d) {
  std::vector<Mat3> sum(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t row) {
    const auto a = static_cast<Index>(row);
    Mat3& sum_a = sum[static_cast<std::size_t>(a)];
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
      sum_a += outer(d.branch(a, i), d.bonds.B_ab[static_cast<std::size_t>(i)]);
  });
  for (const BoundaryNode& f : d.nodes) {
    const auto a = static_cast<std::size_t>(f.owner);
    sum[a] += outer(f.X - d.X[a], f.B_af);
  }
  double w = 0.0;
  for (std::size_t a = 0; a < sum.size(); ++a) w = larger(w, magnitude((1.0 / d.volume[a]) * sum[a] - identity()));
  return w;
}

/// What free faces hand to particles through the second derivatives of their cells.
void add_curvature(const Discretization& d, std::vector<Balance>& columns) {
  for (const CurvedSurface& s : d.second_order->surfaces) {
    const auto a = static_cast<std::size_t>(s.particle);
    for (const CurvatureTerm& t : cell_curvature(d, d.second_order->derivatives, s.particle)) {
      const std::array<Vec3, 6>& m = s.area_moment;
      const Symmetric3& W = t.W;
      const Vec3 B = W.xx * m[0] + W.xy * m[1] + W.xz * m[2] + W.yy * m[3] + W.yz * m[4] + W.zz * m[5];
      columns[static_cast<std::size_t>(t.particle)].add(B);
      columns[a].add(-B);
    }
  }
}

/// Those of a quadratic function, against its own. Particles in one plane do not see all of them.
double second_derivatives(const Discretization& d) {
  const Symmetric3 q{0.3, -0.7, 0.2, 1.1, 0.5, -0.4};
  const SecondDerivatives& s = d.second_order->derivatives;
  std::vector<double> violation(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t row) {
    const auto a = static_cast<std::size_t>(row);
    const double size = std::cbrt(d.volume[a]);
    Symmetric3 H;
    Mat3 extent;
    for (const CurvatureTerm& t : curvature(d, s, static_cast<Index>(row))) {
      const Vec3 y = d.X[static_cast<std::size_t>(t.particle)] - d.X[a];
      H += (0.5 * dot(y, q * y) + size * (y.x - y.y + y.z)) * t.W;
      extent += outer(y, y);
    }
    if (s.resolved[a] && determinant(extent) >= 1e-14 * std::pow(trace(extent), 3))
      violation[a] = magnitude(to_mat3(H - q));
  });
  double w = 0.0;
  for (const double v : violation) w = larger(w, v);
  return w;
}

/// Under a constant stress P the force on b is - P sum_a B_ab; tractions P N on the free faces must balance it. Faces
/// with a node balance by themselves: their closure hands - P A_f back with the weights of the traction.
double columns(const Discretization& d, const std::vector<char>& checked) {
  std::vector<Balance> columns(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t row) {
    const auto b = static_cast<Index>(row);
    Balance& column = columns[static_cast<std::size_t>(b)];
    column.add(d.B_aa[static_cast<std::size_t>(b)]);
    for (Offset i = d.bonds.begin(b); i < d.bonds.end(b); ++i) column.add(d.bonds.B_ba(b, i));
  });
  if (d.second_order) add_curvature(d, columns);
  std::vector<char> held(d.sites.size(), 0);
  for (const BoundaryNode& f : d.nodes) held[static_cast<std::size_t>(f.site)] = 1;
  for (std::size_t s = 0; s < d.sites.size(); ++s)
    if (!held[s])
      for (const LoadShare& l : d.load.row(static_cast<Index>(s)))
        columns[static_cast<std::size_t>(l.particle)].add(-l.area * d.sites[s].N);
  for (std::size_t b = 0; b < columns.size(); ++b)
    if (!checked[b]) columns[b] = Balance{};
  return worst(columns);
}

}  // namespace

Identities identities_of_delaunay(const Discretization& d, double solid_volume) {
  Identities result;
  double volume = 0.0;
  for (double V : d.volume) volume += V;
  result["volume"] = std::abs(volume - solid_volume) / solid_volume;

  std::vector<char> on_boundary(d.X.size(), 0);
  for (const BoundarySite& s : d.sites) on_boundary[static_cast<std::size_t>(s.owner)] = 1;
  std::vector<Balance> rows(d.X.size());
  double antisymmetry = 0.0;
  for (Index a = 0; a < d.particles(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    rows[k].add(d.B_aa[k]);
    double size = 0.0;
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
      size = std::max(size, norm(d.bonds.B_ab[static_cast<std::size_t>(i)]));
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i) {
      const auto ab = static_cast<std::size_t>(i);
      rows[k].add(d.bonds.B_ab[ab]);
      if (on_boundary[k] && on_boundary[static_cast<std::size_t>(d.bonds.neighbour[ab])]) continue;
      antisymmetry = larger(antisymmetry, norm(d.bonds.B_ab[ab] + d.bonds.B_ba(a, i)) / size);
    }
  }
  result["rows"] = worst(rows);
  result["columns"] = columns(d, std::vector<char>(d.X.size(), 1));
  result["duality"] = duality(d);
  result["antisymmetry"] = antisymmetry;
  return result;
}

Identities identities_of_voronoi(const Discretization& d, const Cells& cells, double solid_volume) {
  Identities result;
  double volume = 0.0;
  for (double V : d.volume) volume += V;
  result["volume"] = std::abs(volume - solid_volume) / solid_volume;

  std::vector<Balance> rows(d.X.size());
  double antisymmetry = 0.0, area = 0.0;
  for (const InteriorFace& f : cells.interior) {
    rows[static_cast<std::size_t>(f.a)].add(f.area);
    rows[static_cast<std::size_t>(f.b)].add(-f.area);
    if (!f.bisects) continue;
    const Vec3 &X_a = d.X[static_cast<std::size_t>(f.a)], &X_b = d.X[static_cast<std::size_t>(f.b)];
    const double A = norm(f.area), L = norm(X_b - X_a);
    const Vec3 B_ab = (A / L) * (f.centroid - X_a), B_ba = (A / L) * (f.centroid - X_b);
    const double size = std::cbrt(d.volume[static_cast<std::size_t>(f.a)]);
    const double asymmetry = dot(B_ab + B_ba, normalized(X_b - X_a)) - (2.0 * f.cut - 1.0) * A;
    antisymmetry = larger(antisymmetry, std::abs(asymmetry) / (size * size));
    area = larger(area, norm(B_ab - B_ba - f.area) / (size * size));
  }
  for (const BoundaryFace& f : cells.boundary) rows[static_cast<std::size_t>(f.owner)].add(f.area);
  result["rows"] = worst(rows);

  std::vector<char> checked(d.X.size(), 1);
  if (d.boundary_force == BoundaryForce::direct)
    for (const BoundarySite& s : d.sites) {
      checked[static_cast<std::size_t>(s.owner)] = 0;
      for (Offset i = d.bonds.begin(s.owner); i < d.bonds.end(s.owner); ++i)
        checked[static_cast<std::size_t>(d.bonds.neighbour[static_cast<std::size_t>(i)])] = 0;
    }
  result["columns"] = columns(d, checked);
  result["duality"] = duality(d);
  if (d.second_order) result["second derivatives"] = second_derivatives(d);
  result["antisymmetry"] = antisymmetry;
  result["area"] = area;
  return result;
}

Identities worst_of(const Identities& a, const Identities& b) {
  Identities result = a;
  for (const auto& [name, value] : b) result[name] = larger(result[name], value);
  return result;
}

void require(const Identities& identities) {
  for (const auto& [name, value] : identities)
    if (!(value <= tolerance))
      throw GeometryError(fmt::format(
          "the identity \"{}\" of the discretization is violated by {:.1e} (allowed {:.0e}); the cells "
          "are damaged: move or remove particles that nearly coincide, and shift a body that is a hundred thousand "
          "spacings or more away from the origin nearer to it",
          name, value, tolerance));
}

}  // namespace tessera
