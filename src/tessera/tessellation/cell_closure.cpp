#include "tessera/tessellation/cell_closure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

constexpr double kClosed = 1e-8;  // of the surface or volume: cells that miss more are wrong
constexpr double kThin = 1e-10;   // of a cell's width: what faces that nearly coincide are off by

/// What the faces of a cell add up to.
struct Balance {
  Vec3 area;
  double surface = 0.0, volume = 0.0;

  void add(const Vec3& A, const Vec3& from_particle) {
    area += A;
    surface += norm(A);
    volume += dot(A, from_particle) / 3.0;
  }
};

std::vector<Balance> balances_of(const Generators& points, const Cells& cells) {
  std::vector<Balance> balances(points.size());
  const auto add = [&](Index a, const Vec3& area, const Vec3& centroid) {
    const auto i = static_cast<std::size_t>(a);
    balances[i].add(area, centroid - points[i]);
  };
  for (const InteriorFace& f : cells.interior) add(f.a, f.area, f.centroid), add(f.b, -f.area, f.centroid);
  for (const BoundaryFace& f : cells.boundary) add(f.owner, f.area, f.centroid);
  return balances;
}

/// The volume of a thin cell is known to round-off of its faces only.
bool is_closed(const Balance& balance, const Vec3& X, double V) {
  const double noise = std::max(round_off(X, V), kThin * std::sqrt(balance.surface)) * balance.surface;
  return norm(balance.area) <= kClosed * balance.surface && std::abs(balance.volume - V) <= kClosed * V + noise;
}

[[noreturn]] void refuse_cell(const Generators& points, std::size_t a, const char* why) {
  throw GeometryError("the Voronoi cell of particle " + points.named(static_cast<Index>(a)) + why);
}

}  // namespace

double round_off(const Vec3& X, double V) {
  return 8.0 * std::numeric_limits<double>::epsilon() *
         std::max({std::abs(X.x), std::abs(X.y), std::abs(X.z), std::cbrt(V)});
}

void close_cells(const Generators& points, Cells& cells) {
  const std::vector<Balance> balances = balances_of(points, cells);
  for (std::size_t a = 0; a < points.size(); ++a) {
    double& V = cells.volume[a];
    if (!is_closed(balances[a], points[a], V))
      refuse_cell(points, a, " does not close; does the surface cross itself there?");
    V = balances[a].volume;
    if (!(V > 0.0))
      refuse_cell(points, a, " is thinner than round-off; move the particle away from the surface and from others");
  }
}

}  // namespace tessera
