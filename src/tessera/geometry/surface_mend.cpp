#include "tessera/geometry/surface_mend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/geometry/surface_edges.hpp"

namespace tessera {
namespace {

/// The vertices that were kept, in a hash of cubes wider than the tolerance. Only looked up, never walked.
class WeldingGrid {
 public:
  explicit WeldingGrid(double tolerance) : tolerance_(tolerance), width_(8 * tolerance) {}

  /// The kept vertex nearest to X within the tolerance, -1 when there is none.
  Index find(const Vec3& X, std::span<const Vec3> kept) const {
    std::pair<double, Index> best{tolerance_ * tolerance_, -1};
    const Vec3 reach{tolerance_, tolerance_, tolerance_};
    const Cube low = cube_of(X - reach), high = cube_of(X + reach);
    for (std::int64_t i = low.x; i <= high.x; ++i)
      for (std::int64_t j = low.y; j <= high.y; ++j)
        for (std::int64_t k = low.z; k <= high.z; ++k) {
          const auto found = last_in_.find(key({i, j, k}));
          for (Index v = found == last_in_.end() ? -1 : found->second; v >= 0; v = before_[static_cast<std::size_t>(v)])
            if (const double d = norm2(kept[static_cast<std::size_t>(v)] - X);
                d < best.first || (d == best.first && (best.second < 0 || v < best.second)))
              best = {d, v};
        }
    return best.second;
  }

  void add(Index v, const Vec3& X) {
    const auto [entry, is_new] = last_in_.try_emplace(key(cube_of(X)), v);
    before_.push_back(is_new ? -1 : std::exchange(entry->second, v));
  }

 private:
  struct Cube {
    std::int64_t x, y, z;
  };

  Cube cube_of(const Vec3& X) const {
    const auto number = [this](double x) { return static_cast<std::int64_t>(std::floor(x / width_)); };
    return {number(X.x), number(X.y), number(X.z)};
  }
  static std::uint64_t key(const Cube& c) {
    const auto mixed = [](std::uint64_t h) {
      h = (h ^ (h >> 31)) * 0x9e3779b97f4a7c15;
      return h ^ (h >> 29);
    };
    return mixed(mixed(mixed(static_cast<std::uint64_t>(c.x)) + static_cast<std::uint64_t>(c.y)) +
                 static_cast<std::uint64_t>(c.z));
  }

  double tolerance_, width_;
  std::unordered_map<std::uint64_t, Index> last_in_;  // per cube the vertex added last
  std::vector<Index> before_;                         // per kept vertex the one added to its cube before
};

void remove_unused_vertices(TriangleSurface& surface) {
  std::vector<Index> number(surface.vertices.size(), -1);
  for (const Triangle& t : surface.triangles)
    for (const Index v : t) number[static_cast<std::size_t>(v)] = 0;
  Index used = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      surface.vertices[static_cast<std::size_t>(used)] = surface.vertices[v];
      number[v] = used++;
    }
  surface.vertices.resize(static_cast<std::size_t>(used));
  for (Triangle& t : surface.triangles)
    for (Index& v : t) v = number[static_cast<std::size_t>(v)];
}

}  // namespace

double weld_tolerance(const TriangleSurface& surface) {
  double largest = 0.0;
  for (const Vec3& X : surface.vertices)
    for (int d = 0; d < 3; ++d) largest = std::max(largest, std::abs(X[d]));
  Bounds box;
  for (const Vec3& X : surface.vertices) box.include(X);
  // Neighbouring single-precision numbers differ by up to 1.2e-7, and sqrt(3) times as much in space. Far from the
  // origin that would be too much of the solid.
  return surface.vertices.empty() ? 0.0 : std::min(2.5e-7 * largest, 1e-6 * norm(box.size()));
}

void weld_vertices(TriangleSurface& surface, SurfaceRepairs& repairs) {
  if (!(repairs.tolerance > 0)) return remove_unused_vertices(surface);
  WeldingGrid grid(repairs.tolerance);
  std::vector<Vec3> kept;
  std::vector<Index> number;
  number.reserve(surface.vertices.size());
  for (const Vec3& X : surface.vertices) {
    Index v = grid.find(X, kept);
    if (v < 0) {
      v = static_cast<Index>(kept.size());
      kept.push_back(X);
      grid.add(v, X);
    } else if (kept[static_cast<std::size_t>(v)] != X) {
      ++repairs.moved_vertices;
    }
    number.push_back(v);
  }
  surface.vertices = std::move(kept);
  for (Triangle& t : surface.triangles)
    for (Index& v : t) v = number[static_cast<std::size_t>(v)];
  remove_unused_vertices(surface);
}

void turn_contrary_triangles(FileSurface& file, SurfaceRepairs& repairs) {
  TriangleSurface& surface = file.surface;
  ParitySets patches(surface.size());
  for_each_edge(edge_uses(surface), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const bool contradict = uses[0].is_forward == uses[1].is_forward;
    if (patches.join(uses[0].triangle, uses[1].triangle, contradict)) return;
    throw GeometryError(fmt::format(
        "{}: the surface has one side only, as a Moebius strip: it cannot be said what is inside; it closes on itself "
        "the wrong way round at the edge from {} to {}",
        file.path, describe_point(surface.vertex(uses[0].a)), describe_point(surface.vertex(uses[0].b))));
  });
  std::vector<std::array<Index, 2>> votes(surface.triangles.size());
  for (Index t = 0; t < surface.size(); ++t) {
    const ParitySets::Root root = patches.find(t);
    ++votes[static_cast<std::size_t>(root.root)][root.differs ? 1 : 0];
  }
  for (Index t = 0; t < surface.size(); ++t) {
    const ParitySets::Root root = patches.find(t);
    const auto [same, other] = votes[static_cast<std::size_t>(root.root)];
    const bool turns = root.differs == (same >= other);
    if (!turns || std::min(same, other) == 0) continue;
    if (4 * std::min(same, other) > same + other)
      throw GeometryError(fmt::format(
          "{}: {} of {} connected triangles run the other way round than the rest, {} for example, so it cannot be "
          "said what is inside: let the program that wrote it orient all faces outwards",
          file.path, std::min(same, other), same + other, describe_triangle(file, t)));
    std::swap(surface.triangles[static_cast<std::size_t>(t)][1], surface.triangles[static_cast<std::size_t>(t)][2]);
    ++repairs.turned_triangles;
  }
}

}  // namespace tessera
