#include "tessera/geometry/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/geometry/boundary.hpp"
#include "tessera/geometry/random.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

constexpr double kOnBoundary = 1e-9;  // of the spacing: nodes closer to the boundary than this lie on it
constexpr double kLargestJitter = 0.49;
constexpr double kMostNodes = 2e9;

/// A number between -1 and 1.
double uniform(std::uint64_t seed, std::uint64_t counter) { return 2.0 * random_number(seed, counter) - 1.0; }

void check(const LatticeSpec& spec, const Origin& origin, Placement placement) {
  if (spec.counts.has_value() == spec.spacing.has_value())
    throw InputError(origin, "a lattice needs either counts or a spacing, and not both");
  if (!(spec.jitter >= 0.0 && spec.jitter <= kLargestJitter))
    throw InputError(origin, fmt::format("jitter = {:g} is not between 0 and {:g}", spec.jitter, kLargestJitter));
  if (spec.spacing && !(*spec.spacing > 0.0 && std::isfinite(*spec.spacing)))
    throw InputError(origin, fmt::format("spacing = {:g} m must be positive", *spec.spacing));
  const int least = placement == Placement::vertices ? 2 : 1;
  if (!spec.counts) return;
  for (const int count : *spec.counts)
    if (count < least)
      throw InputError(
          origin, fmt::format("counts = [{}] must be at least {} in every direction{}", fmt::join(*spec.counts, ", "),
                              least, least == 2 ? ": particles lie on both ends" : ""));
}

Lattice lay_lattice(const LatticeSpec& spec, const Origin& origin, const Solid& solid, Placement placement) {
  const bool on_vertices = placement == Placement::vertices;
  Lattice lattice;
  double nodes = 1.0;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const double size = solid.upper[d] - solid.lower[d];
    const double extra = on_vertices ? 1.0 : 0.0;
    const double count = spec.counts ? (*spec.counts)[axis] : std::max(1.0, std::round(size / *spec.spacing)) + extra;
    nodes *= count;
    if (nodes > kMostNodes)
      throw InputError(origin,
                       fmt::format("the lattice has more than {:g} nodes; choose a larger spacing", kMostNodes));
    lattice.nodes[axis] = static_cast<Index>(count);
    lattice.spacing[d] = size / (count - extra);
    lattice.origin[d] = solid.lower[d] + (on_vertices ? 0.0 : 0.5 * lattice.spacing[d]);
  }
  lattice.particle.assign(static_cast<std::size_t>(nodes), -1);
  return lattice;
}

class Placer {
 public:
  Placer(const LatticeSpec& spec, const Solid& solid, Placement placement, Lattice lattice)
      : spec_(spec), solid_(solid), placement_(placement), lattice_(std::move(lattice)) {
    const Vec3& h = lattice_.spacing;
    tolerance_ = kOnBoundary * std::min({h.x, h.y, h.z});
  }

  PointSet place() {
    const auto nodes = static_cast<std::int64_t>(lattice_.particle.size());
    std::vector<Block> blocks(static_cast<std::size_t>((nodes + parallel::block_size - 1) / parallel::block_size));
    const auto block = [](std::int64_t begin) { return static_cast<std::size_t>(begin / parallel::block_size); };
    parallel::for_ranges(0, nodes, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t node = begin; node < end; ++node)
        place_node(static_cast<std::size_t>(node), blocks[block(begin)]);
    });
    std::size_t particles = 0;
    for (Block& b : blocks) {
      if (b.lost) refuse(b.points[*b.lost], particles + *b.lost);
      b.first = particles;
      particles += b.points.size();
    }
    PointSet set;
    set.points.resize(particles);
    parallel::for_ranges(0, nodes, [&](std::int64_t begin, std::int64_t end) {
      const Block& b = blocks[block(begin)];
      std::copy(b.points.begin(), b.points.end(), set.points.begin() + static_cast<std::ptrdiff_t>(b.first));
      for (auto node = static_cast<std::size_t>(begin); node < static_cast<std::size_t>(end); ++node)
        if (lattice_.particle[node] >= 0) lattice_.particle[node] += static_cast<Index>(b.first);
    });
    set.lattice = std::move(lattice_);
    return set;
  }

 private:
  /// The particles of consecutive nodes.
  struct Block {
    std::vector<Vec3> points;
    std::size_t first = 0;
    std::optional<std::size_t> lost;  // the first one that was moved out of the solid
  };

  /// Numbers particles within the block.
  void place_node(std::size_t node, Block& block) {
    const auto nx = static_cast<std::size_t>(lattice_.nodes[0]), ny = static_cast<std::size_t>(lattice_.nodes[1]);
    const Vec3 ijk{static_cast<double>(node % nx), static_cast<double>(node / nx % ny),
                   static_cast<double>(node / nx / ny)};
    const Vec3& h = lattice_.spacing;
    Vec3 X = lattice_.origin + Vec3{ijk.x * h.x, ijk.y * h.y, ijk.z * h.z};
    if (!solid_.contains(X, tolerance_)) return;
    const std::vector<Index> sides = sides_at(solid_, X, tolerance_);
    if (placement_ == Placement::cell_centres && !sides.empty()) return;
    X = moved_onto(solid_, sides, X) + along_sides(solid_, sides, random_move(node));
    lattice_.particle[node] = static_cast<Index>(block.points.size());
    if (spec_.jitter > 0.0 && !block.lost && !is_fine(X)) block.lost = block.points.size();
    block.points.push_back(X);
  }

  Vec3 random_move(std::size_t node) const {
    Vec3 move;
    for (int d = 0; d < 3; ++d)
      move[d] = spec_.jitter * lattice_.spacing[d] * uniform(spec_.seed, 3 * node + static_cast<std::uint64_t>(d));
    return move;
  }

  bool is_fine(const Vec3& X) const {
    return placement_ == Placement::vertices ? solid_.contains(X, tolerance_) : is_well_inside(solid_, X, tolerance_);
  }

  [[noreturn]] void refuse(const Vec3& X, std::size_t particle) const {
    throw GeometryError(
        fmt::format("jitter = {:g} with seed = {} moves particle {} out of the solid, to ({:g}, {:g}, "
                    "{:g}) m; choose a smaller jitter or another seed",
                    spec_.jitter, spec_.seed, particle, X.x, X.y, X.z));
  }

  const LatticeSpec& spec_;
  const Solid& solid_;
  Placement placement_;
  Lattice lattice_;
  double tolerance_ = 0.0;
};

}  // namespace

PointSet place_lattice(const LatticeSpec& spec, const Origin& origin, const Solid& solid, Placement placement) {
  check(spec, origin, placement);
  PointSet set = Placer(spec, solid, placement, lay_lattice(spec, origin, solid, placement)).place();
  if (set.points.empty())
    throw InputError(origin, "the lattice leaves no particle in the solid; choose a smaller spacing or more counts");
  return set;
}

}  // namespace tessera
