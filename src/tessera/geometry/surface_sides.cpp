#include "tessera/geometry/surface_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "tessera/base/text.hpp"
#include "tessera/geometry/surface_edges.hpp"

namespace tessera {
namespace {

constexpr double kSameArea = 1e-9;   // relative
constexpr double kSamePlace = 1e-9;  // of the surface's size

/// Angle between two normals [rad], accurate also near 0 and pi.
double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// Per triangle the number of its patch, counted by first triangles.
std::vector<Index> find_patches(const TriangleSurface& surface, double split_angle) {
  const double limit = split_angle * std::numbers::pi / 180 * (1 + 1e-9);
  ParitySets sets(surface.size());
  for_each_edge(edge_uses(surface), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const Index s = uses[0].triangle, t = uses[1].triangle;
    if (angle_between(area_vector(surface, s), area_vector(surface, t)) <= limit) sets.join(s, t, false);
  });
  std::vector<Index> number(surface.triangles.size(), -1), patch;  // number: per root
  Index patches = 0;
  for (Index t = 0; t < surface.size(); ++t) {
    Index& n = number[static_cast<std::size_t>(sets.find(t).root)];
    if (n < 0) n = patches++;
    patch.push_back(n);
  }
  return patch;
}

/// Where each side comes when they are sorted by area, then by place. Both are compared in coarse steps: round-off,
/// which depends on the order of triangles, must not decide.
std::vector<Index> ranks(const std::vector<SideSummary>& sides, double size) {
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sides[a].area > sides[b].area; });
  const auto step = [&](double x) { return std::round(x / (kSamePlace * size)); };
  const auto place = [&](std::size_t s) {
    const Vec3& X = sides[s].center;
    return std::tuple(step(X.x), step(X.y), step(X.z));
  };
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && sides[order[last]].area >= (1 - kSameArea) * sides[order[first]].area) ++last;
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.begin() + static_cast<std::ptrdiff_t>(last),
              [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  }
  std::vector<Index> rank(sides.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<Index>(i);
  return rank;
}

}  // namespace

void split_sides_at_edges(TriangleSurface& surface, double split_angle) {
  surface.side = find_patches(surface, split_angle);
  const Index sides = surface.side.empty() ? 0 : *std::max_element(surface.side.begin(), surface.side.end()) + 1;
  surface.side_names.assign(static_cast<std::size_t>(sides), "");
  const std::vector<Index> rank = ranks(summarize_sides(surface), norm(bounds(surface).size()));
  for (Index& side : surface.side) side = rank[static_cast<std::size_t>(side)];
  for (std::size_t s = 0; s < surface.side_names.size(); ++s) surface.side_names[s] = fmt::format("side{}", s + 1);
}

void name_sides(TriangleSurface& surface, std::span<const NamedSide> sides) {
  const Bounds box = bounds(surface);
  const std::vector<std::string> old_names = surface.side_names;
  std::vector<std::ptrdiff_t> taken_by(surface.triangles.size(), -1);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Selection selection(sides[s].where, old_names, box.lower, box.upper);
    bool takes_any = false;
    for (Index t = 0; t < surface.size(); ++t) {
      std::ptrdiff_t& taker = taken_by[static_cast<std::size_t>(t)];
      const auto [a, b, c] = surface.corners(t);
      const auto side = static_cast<std::size_t>(surface.side[static_cast<std::size_t>(t)]);
      if (!selection.takes({(a + b + c) / 3.0, {&old_names[side], 1}})) continue;
      if (taker >= 0)
        throw InputError(sides[s].where.origin,
                         fmt::format("the sides {} and {} both take the triangle around ({:.6g}, {:.6g}, {:.6g}) m",
                                     quoted(sides[static_cast<std::size_t>(taker)].name), quoted(sides[s].name),
                                     (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3));
      taker = static_cast<std::ptrdiff_t>(s);
      takes_any = true;
    }
    if (!takes_any)
      throw InputError(sides[s].where.origin,
                       fmt::format("the side {} takes no triangle of the surface", quoted(sides[s].name)));
  }
  for (std::size_t t = 0; t < taken_by.size(); ++t) {
    if (taken_by[t] < 0) continue;
    const std::string& name = sides[static_cast<std::size_t>(taken_by[t])].name;
    const auto place =
        std::find(surface.side_names.begin(), surface.side_names.end(), name) - surface.side_names.begin();
    if (place == static_cast<std::ptrdiff_t>(surface.side_names.size())) surface.side_names.push_back(name);
    surface.side[t] = static_cast<Index>(place);
  }
  remove_unused_sides(surface);
}

std::vector<SideSummary> summarize_sides(const TriangleSurface& surface) {
  std::vector<SideSummary> sides(surface.side_names.size());
  for (std::size_t s = 0; s < sides.size(); ++s) sides[s].name = surface.side_names[s];
  for (Index t = 0; t < surface.size(); ++t) {
    SideSummary& side = sides[static_cast<std::size_t>(surface.side[static_cast<std::size_t>(t)])];
    const auto [a, b, c] = surface.corners(t);
    const Vec3 A = area_vector(surface, t);
    ++side.triangles;
    side.box.include(bounds(surface, t));
    side.area += norm(A);
    side.normal += A;
    side.center += norm(A) * ((a + b + c) / 3.0);
  }
  constexpr double kCancelled = 1e-12;  // of the area: what is left of area vectors that cancel
  for (SideSummary& side : sides) {
    if (side.triangles == 0) continue;
    side.center = side.center / side.area;
    side.normal = norm(side.normal) > kCancelled * side.area ? normalized(side.normal) : Vec3{};
  }
  return sides;
}

void remove_unused_sides(TriangleSurface& surface) {
  std::vector<Index> number(surface.side_names.size(), -1);
  for (const Index side : surface.side) number[static_cast<std::size_t>(side)] = 0;
  std::vector<std::string> names;
  for (std::size_t s = 0; s < number.size(); ++s) {
    if (number[s] < 0) continue;
    number[s] = static_cast<Index>(names.size());
    names.push_back(std::move(surface.side_names[s]));
  }
  surface.side_names = std::move(names);
  for (Index& side : surface.side) side = number[static_cast<std::size_t>(side)];
}

}  // namespace tessera
