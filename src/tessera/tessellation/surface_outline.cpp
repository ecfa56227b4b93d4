#include "tessera/tessellation/surface_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "tessera/geometry/surface_reader.hpp"

namespace tessera {
namespace {

using Loop = std::vector<Index>;

/// Chains lines to closed loops, whatever their order; corners in one place become one.
std::vector<Loop> loops_of(std::span<const std::array<Index, 2>> lines, std::span<const Vec3> places) {
  std::multimap<Index, Index> next;
  for (const auto& [from, to] : lines)
    if (from != to) next.emplace(from, to);
  const auto place = [&](Index p) { return places[static_cast<std::size_t>(p)]; };
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    Index at = next.begin()->first;
    for (auto line = next.begin(); line != next.end(); line = next.find(at)) {
      if (loop.empty() || place(loop.back()) != place(at)) loop.push_back(at);
      at = line->second;
      next.erase(line);
    }
    if (loop.size() > 1 && place(loop.front()) == place(loop.back())) loop.pop_back();
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

/// Polygons of corners in one plane.
class Plate {
 public:
  Plate(std::span<const Vec3> places, const Vec3& normal) : places_(places), normal_(normal) {}

  const Vec3& place(Index p) const { return places_[static_cast<std::size_t>(p)]; }

  double area(const Loop& loop) const {
    Vec3 sum;
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += cross(place(loop[i]) - place(loop[0]), place(loop[(i + 1) % loop.size()]) - place(loop[0]));
    return 0.5 * dot(normal_, sum);
  }

  bool is_convex(const Loop& loop) const {
    double turned = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 &a = place(loop[i]), &b = place(loop[(i + 1) % loop.size()]), &c = place(loop[(i + 2) % loop.size()]);
      const double sine = dot(normal_, cross(b - a, c - b)), cosine = dot(b - a, c - b);
      if (sine < -kStraight * norm(b - a) * norm(c - b)) return false;
      turned += std::atan2(sine, cosine);
    }
    return turned < 7.0;  // once around, not twice
  }

  bool is_around(const Loop& loop, const Vec3& X) const {
    double angle = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 u = place(loop[i]) - X, v = place(loop[(i + 1) % loop.size()]) - X;
      angle += std::atan2(dot(normal_, cross(u, v)), dot(u, v));
    }
    return angle > 3.0;
  }

  /// Makes one polygon of a loop and a hole in it: over the shortest way that crosses neither, and back.
  Loop bridged(const Loop& outside, const Loop& hole) const {
    std::vector<std::tuple<double, std::size_t, std::size_t>> ways;
    for (std::size_t i = 0; i < outside.size(); ++i)
      for (std::size_t j = 0; j < hole.size(); ++j) ways.emplace_back(norm2(place(hole[j]) - place(outside[i])), i, j);
    std::sort(ways.begin(), ways.end());
    const auto free = std::find_if(ways.begin(), ways.end(), [&](const auto& way) {
      const auto [length2, i, j] = way;
      return !is_crossed(outside, outside[i], hole[j]) && !is_crossed(hole, outside[i], hole[j]);
    });
    const auto [length2, i, j] = free == ways.end() ? ways.front() : *free;
    const auto way = static_cast<std::ptrdiff_t>(i), turn = static_cast<std::ptrdiff_t>(j);
    Loop all(outside.begin(), outside.begin() + way + 1);
    all.insert(all.end(), hole.begin() + turn, hole.end());
    all.insert(all.end(), hole.begin(), hole.begin() + turn + 1);
    all.insert(all.end(), outside.begin() + way, outside.end());
    return all;
  }

 private:
  static constexpr double kStraight = 1e-9;  // sine of an angle below which an edge goes straight on

  double turn(Index a, Index b, Index c) const { return dot(normal_, cross(place(b) - place(a), place(c) - place(a))); }

  bool is_crossed(const Loop& loop, Index p, Index q) const {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Index a = loop[i], b = loop[(i + 1) % loop.size()];
      if (a == p || a == q || b == p || b == q) continue;
      if (turn(p, q, a) * turn(p, q, b) <= 0 && turn(a, b, p) * turn(a, b, q) <= 0) return true;
    }
    return false;
  }

  std::span<const Vec3> places_;
  Vec3 normal_;
};

/// Triangles of a polygon; itself when it touches itself in a way that ears cannot be cut from.
void add_triangles(const Loop& polygon, std::span<const Vec3> places, std::vector<Loop>& out) {
  std::vector<Vec3> corners;
  for (const Index p : polygon) corners.push_back(places[static_cast<std::size_t>(p)]);
  const auto ears = cut_ears(corners);
  if (ears.empty()) out.push_back(polygon);
  for (const auto& [a, b, c] : ears) out.push_back({polygon[a], polygon[b], polygon[c]});
}

}  // namespace

std::vector<Loop> polygons_within(std::vector<Loop> loops, std::span<const Vec3> places, const Vec3& normal) {
  const Plate plate(places, normal);
  const auto hole = std::stable_partition(loops.begin(), loops.end(), [&](const Loop& l) { return plate.area(l) > 0; });
  const std::span<const Loop> outsides(loops.begin(), hole), holes(hole, loops.end());
  std::vector<Loop> polygons;
  for (const Loop& outside : outsides) {
    Loop whole = outside;
    bool has_holes = false;
    for (const Loop& h : holes)
      if (plate.is_around(outside, plate.place(h[0]))) {
        whole = plate.bridged(whole, h);
        has_holes = true;
      }
    if (!has_holes && plate.is_convex(whole))
      polygons.push_back(std::move(whole));
    else
      add_triangles(whole, places, polygons);
  }
  return polygons;
}

std::vector<Polyhedron> outlines_of(const SurfaceCutter& cutter, Index particle, const Vec3& X) {
  std::vector<Vec3> places;
  for (const SurfaceLines::Point& point : cutter.points()) places.push_back(point.X);
  std::vector<Polyhedron> parts(cutter.parts(), Polyhedron{particle, {}, {}});
  std::vector<std::vector<Index>> numbers(parts.size(), std::vector<Index>(places.size(), -1));
  for (const SurfaceCutter::Outline& outline : cutter.outlines()) {
    const auto p = static_cast<std::size_t>(outline.part);
    for (Loop& polygon : polygons_within(loops_of(outline.lines, places), places, outline.normal)) {
      for (Index& corner : polygon) {
        const Vec3& place = places[static_cast<std::size_t>(corner)];
        Index& number = numbers[p][static_cast<std::size_t>(corner)];
        if (number < 0) {
          number = static_cast<Index>(parts[p].vertices.size());
          parts[p].vertices.push_back(X + place);
        }
        corner = number;
      }
      parts[p].faces.push_back(std::move(polygon));
    }
  }
  return parts;
}

}  // namespace tessera
