#include "tessera/geometry/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace tessera {
namespace {

constexpr double kTouch = 1e-9;     // of the size: points closer than this touch
constexpr double kStraight = 1e-9;  // sine of the turn at a corner that still counts as straight

using Loop = std::vector<int>;

Point2 operator-(const Point2& a, const Point2& b) { return {a[0] - b[0], a[1] - b[1]}; }
double cross(const Point2& a, const Point2& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Point2& a, const Point2& b) { return a[0] * b[0] + a[1] * b[1]; }
double length(const Point2& a) { return std::hypot(a[0], a[1]); }

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 ab = b - a;
  const double s = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  return length(p - Point2{a[0] + s * ab[0], a[1] + s * ab[1]});
}

bool cross_properly(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const bool ab_splits = (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0);
  const bool cd_splits = (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
  return ab_splits && cd_splits;
}

bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d, double tolerance) {
  return cross_properly(a, b, c, d) || distance_to_segment(a, c, d) <= tolerance ||
         distance_to_segment(b, c, d) <= tolerance || distance_to_segment(c, a, b) <= tolerance ||
         distance_to_segment(d, a, b) <= tolerance;
}

double polygon_size(const std::vector<Point2>& points) {
  Point2 low = points[0], high = points[0];
  for (const Point2& p : points)
    for (std::size_t d = 0; d < 2; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  return length(high - low);
}

void check_points(const std::vector<Point2>& points, const Origin& origin) {
  if (points.size() < 3)
    throw InputError(origin, fmt::format("a polygon needs at least three points, not {}", points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i][0]) || !std::isfinite(points[i][1]))
      throw InputError(origin, fmt::format("point {} of the polygon is not finite", i + 1));
  const double tolerance = kTouch * polygon_size(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      if (length(points[i] - points[j]) <= tolerance)
        throw InputError(origin,
                         fmt::format("points {} and {} of the polygon coincide at ({:g}, {:g}) m; give each corner "
                                     "once (the last edge closes by itself)",
                                     i + 1, j + 1, points[i][0], points[i][1]));
}

/// Sine of the turn from edge u -> v to edge v -> w: positive to the left.
double turn(const Point2& u, const Point2& v, const Point2& w) {
  return cross(v - u, w - v) / (length(v - u) * length(w - v));
}

/// The share of its longest edge that a triangle is high: small for needles.
double shape_quality(const Point2& a, const Point2& b, const Point2& c) {
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  return cross(b - a, c - a) / (longest * longest);
}

class EarClipper {
 public:
  explicit EarClipper(const std::vector<Point2>& points) : points_(points), rest_(points.size()) {
    std::iota(rest_.begin(), rest_.end(), 0);
    tolerance_ = kTouch * polygon_size(points);
  }

  std::vector<Loop> triangles() {
    std::vector<Loop> triangles;
    while (rest_.size() > 3) {
      const std::size_t ear = best_ear();
      triangles.push_back({rest_[before(ear)], rest_[ear], rest_[after(ear)]});
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back(rest_);
    return triangles;
  }

 private:
  std::size_t before(std::size_t i) const { return i == 0 ? rest_.size() - 1 : i - 1; }
  std::size_t after(std::size_t i) const { return i + 1 == rest_.size() ? 0 : i + 1; }
  const Point2& at(std::size_t i) const { return points_[static_cast<std::size_t>(rest_[i])]; }

  bool is_ear(std::size_t ear) const {
    const Point2 &a = at(before(ear)), &b = at(ear), &c = at(after(ear));
    if (turn(a, b, c) <= kStraight) return false;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (i == before(ear) || i == ear || i == after(ear)) continue;
      const Point2& p = at(i);
      const bool in_triangle = cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
      if (in_triangle || distance_to_segment(p, a, c) <= tolerance_) return false;
    }
    return true;
  }

  std::size_t best_ear() const {
    double best = 0.0;
    std::optional<std::size_t> ear;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const double quality = shape_quality(at(before(i)), at(i), at(after(i)));
      if (quality > best && is_ear(i)) best = quality, ear = i;
    }
    if (!ear)
      throw GeometryError("the polygon cannot be split into triangles: its corners are too close to each other");
    return *ear;
  }

  const std::vector<Point2>& points_;
  Loop rest_;
  double tolerance_;
};

bool is_strictly_convex(const std::vector<Point2>& points, const Loop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(loop[k % loop.size()])]; };
    if (turn(at(i), at(i + 1), at(i + 2)) <= kStraight) return false;
  }
  return true;
}

/// Both loops as one, without their common edge, which runs u -> v in `first` and v -> u in `second`; empty when there
/// is none.
Loop joined(const Loop& first, const Loop& second) {
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j) {
      const int u = first[i], v = first[(i + 1) % first.size()];
      if (second[j] != v || second[(j + 1) % second.size()] != u) continue;
      Loop loop;
      for (std::size_t k = 1; k < first.size(); ++k) loop.push_back(first[(i + k) % first.size()]);
      for (std::size_t k = 1; k < second.size(); ++k) loop.push_back(second[(j + k) % second.size()]);
      return loop;
    }
  return {};
}

bool join_one_pair(const std::vector<Point2>& points, std::vector<Loop>& parts) {
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = a + 1; b < parts.size(); ++b) {
      const Loop loop = joined(parts[a], parts[b]);
      if (loop.empty() || !is_strictly_convex(points, loop)) continue;
      parts[a] = loop;
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(b));
      return true;
    }
  return false;
}

}  // namespace

double polygon_area(const std::vector<Point2>& points) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) twice += cross(points[i] - points[0], points[i + 1] - points[0]);
  return 0.5 * twice;
}

void check_polygon(const std::vector<Point2>& points, const Origin& origin) {
  check_points(points, origin);
  const double size = polygon_size(points);
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 &a = points[i], &b = points[(i + 1) % n], &next = points[(i + 2) % n];
    if (std::abs(turn(a, b, next)) <= kStraight && dot(b - a, next - b) < 0)
      throw InputError(origin, fmt::format("edges {} and {} of the polygon lie on each other", i + 1, (i + 1) % n + 1));
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segments_meet(a, b, points[j], points[(j + 1) % n], kTouch * size))
        throw InputError(origin, fmt::format("edges {} and {} of the polygon cross or touch; list the corners in order "
                                             "around the outline",
                                             i + 1, j + 1));
    }
  }
  if (std::abs(polygon_area(points)) <= kTouch * size * size)
    throw InputError(origin, "the polygon has no area: all its points lie on a line");
}

std::vector<std::vector<int>> convex_parts(const std::vector<Point2>& points) {
  std::vector<Loop> parts = EarClipper(points).triangles();
  while (join_one_pair(points, parts)) {
  }
  return parts;
}

}  // namespace tessera
