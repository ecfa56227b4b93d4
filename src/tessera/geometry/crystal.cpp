#include "tessera/geometry/crystal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/geometry/random.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {
namespace {

constexpr double kMostSites = 2e9;

/// A unit cell with one particle per unit of volume. Sites are fractions of the edges, so placed that the cell looks
/// alike from opposite faces and no site is near one.
struct UnitCell {
  Vec3 edges;
  std::vector<Vec3> sites;
};

UnitCell unit_cell(LatticeKind kind) {
  constexpr double root2_3 = 1.2599210498948732, root4_3 = 1.5874010519681994;  // cube roots of 2 and 4
  constexpr double a = 1.122462048309373;                                       // sixth root of 2
  constexpr double root3 = 1.7320508075688772, root8_3rds = 1.632993161855452;
  switch (kind) {
    case LatticeKind::bcc:
      return {{root2_3, root2_3, root2_3}, {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}};
    case LatticeKind::fcc:
      return {{root4_3, root4_3, root4_3},
              {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}}};
    case LatticeKind::hcp:
      return {{a, root3 * a, root8_3rds * a},
              {{0.25, 5.0 / 6, 0.25}, {0.75, 1.0 / 3, 0.25}, {0.75, 2.0 / 3, 0.75}, {0.25, 1.0 / 6, 0.75}}};
    case LatticeKind::cubic:
      break;
  }
  return {{1.0, 1.0, 1.0}, {{0.5, 0.5, 0.5}}};
}

/// Unit cells over the bounding box.
struct Lay {
  std::array<std::int64_t, 3> counts{};
  Vec3 lower, pitch;  // [m]
};

Lay lay(const LatticeSpec& spec, const Origin& origin, const UnitCell& cell, const Bounds& box) {
  Lay lay;
  lay.lower = box.lower;
  double sites = static_cast<double>(cell.sites.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int d = static_cast<int>(axis);
    const double size = box.size()[d];
    const double count =
        spec.counts ? (*spec.counts)[axis] : std::max(1.0, std::round(size / (cell.edges[d] * *spec.spacing)));
    sites *= count;
    if (sites > kMostSites)
      throw InputError(origin,
                       fmt::format("the lattice has more than {:g} sites; choose a larger spacing", kMostSites));
    lay.counts[axis] = static_cast<std::int64_t>(count);
    lay.pitch[d] = size / count;
  }
  return lay;
}

class Crystal {
 public:
  Crystal(const LatticeSpec& spec, const UnitCell& cell, const Lay& lay, const Region& region)
      : spec_(spec), cell_(cell), lay_(lay), region_(region) {
    spacing_ = std::cbrt(lay.pitch.x * lay.pitch.y * lay.pitch.z / static_cast<double>(cell.sites.size()));
  }

  double spacing() const { return spacing_; }

  std::vector<Vec3> particles() const {
    const std::int64_t cells = lay_.counts[0] * lay_.counts[1] * lay_.counts[2];
    return parallel::collect_rows<Vec3>(static_cast<Index>(cells),
                                        [&](Index c, parallel::RowCollector<Vec3>& out) {
                                          for (std::size_t s = 0; s < cell_.sites.size(); ++s)
                                            if (const Vec3 X = site(c, cell_.sites[s]); is_fine(X))
                                              out.add(moved(X, static_cast<std::uint64_t>(c) * cell_.sites.size() + s));
                                        })
        .value;
  }

 private:
  Vec3 site(std::int64_t c, const Vec3& fraction) const {
    const auto [nx, ny, nz] = lay_.counts;
    const std::array<std::int64_t, 3> ijk{c % nx, c / nx % ny, c / nx / ny};
    Vec3 X = lay_.lower;
    for (int d = 0; d < 3; ++d)
      X[d] += (static_cast<double>(ijk[static_cast<std::size_t>(d)]) + fraction[d]) * lay_.pitch[d];
    return X;
  }
  bool is_fine(const Vec3& X) const { return region_.is_deep(X, kLeastDepth * spacing_); }

  /// A random move, shorter where there is no room for it.
  Vec3 moved(const Vec3& X, std::uint64_t number) const {
    Vec3 move;
    for (int d = 0; d < 3; ++d)
      move[d] =
          spec_.jitter * spacing_ * (2.0 * random_number(spec_.seed, 3 * number + static_cast<std::uint64_t>(d)) - 1.0);
    for (double part = 1.0; spec_.jitter > 0.0 && part > 0.1; part *= 0.5)
      if (is_fine(X + part * move)) return X + part * move;
    return X;
  }

  const LatticeSpec& spec_;
  const UnitCell& cell_;
  const Lay& lay_;
  const Region& region_;
  double spacing_;
};

}  // namespace

std::vector<Vec3> place_crystal(const LatticeSpec& spec, const Origin& origin, const Region& region) {
  const UnitCell cell = unit_cell(spec.kind);
  const Lay cells = lay(spec, origin, cell, bounds(region.index.surface()));
  const Crystal crystal(spec, cell, cells, region);
  std::vector<Vec3> particles = crystal.particles();
  if (particles.empty())
    throw InputError(origin, fmt::format("no site of the lattice, with a spacing of {:g} m, lies in the solid and {:g} "
                                         "spacings away from its surface; choose a finer one",
                                         crystal.spacing(), kLeastDepth));
  return particles;
}

}  // namespace tessera
