#include "tessera/geometry/polygon_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tessera/geometry/box_grid.hpp"
#include "tessera/geometry/polygon.hpp"

namespace tessera {
namespace {

constexpr double kCoincidence = 1e-12;  // of the size: coordinates closer than this are made equal

/// Makes coordinates that differ by round-off equal, so that edges along an axis are exactly so.
std::vector<Point2> snapped(std::vector<Point2> points) {
  for (std::size_t d = 0; d < 2; ++d) {
    std::vector<double> values;
    for (const Point2& p : points) values.push_back(p[d]);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double tolerance = kCoincidence * (*most - *least);
    const std::vector<double> merged = merge_close(values, tolerance);
    for (Point2& p : points) p[d] = merged[static_cast<std::size_t>(nearest_plane(merged, p[d]))];
  }
  return points;
}

/// The upright plane through an edge, outward normal to the right of a -> b. The same numbers, with opposite signs,
/// for b -> a, so that two pieces see the same wall.
Plane upright_plane(const Point2& a, const Point2& b) {
  if (b < a) {
    const Plane other = upright_plane(b, a);
    return {-other.normal, -other.offset};
  }
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const Vec3 normal{(b[1] - a[1]) / length, -(b[0] - a[0]) / length, 0.0};
  return {normal, normal.x * a[0] + normal.y * a[1]};
}

class Builder {
 public:
  Builder(const Shape& shape, const PolygonShape& polygon) : shape_(shape), polygon_(polygon) {
    if (!std::isfinite(polygon.base) || !std::isfinite(polygon.thickness) || polygon.thickness <= 0)
      throw InputError(shape.origin,
                       fmt::format("the polygon's thickness must be positive, not {:g} m", polygon.thickness));
    check_polygon(polygon.points, shape.origin);
    points_ = snapped(polygon.points);
    is_reversed_ = polygon_area(points_) < 0;
    if (is_reversed_) std::reverse(points_.begin(), points_.end());
  }

  Solid build() {
    find_bounds();
    add_sides();
    for (const std::vector<int>& part : convex_parts(points_)) add_piece(part);
    solid_.volume = polygon_area(points_) * polygon_.thickness;
    return std::move(solid_);
  }

 private:
  Point2 point(int i) const { return points_[static_cast<std::size_t>(i) % points_.size()]; }
  int size() const { return static_cast<int>(points_.size()); }

  /// Number, counted from one in the user's order, of the edge from point i to the next.
  int users_edge(int i) const {
    const int n = size();
    return is_reversed_ ? (n - 2 - i + n) % n + 1 : i + 1;
  }

  void find_bounds() {
    solid_.lower = {points_[0][0], points_[0][1], polygon_.base};
    solid_.upper = {points_[0][0], points_[0][1], polygon_.base + polygon_.thickness};
    for (const Point2& p : points_)
      for (int d = 0; d < 2; ++d) {
        solid_.lower[d] = std::min(solid_.lower[d], p[static_cast<std::size_t>(d)]);
        solid_.upper[d] = std::max(solid_.upper[d], p[static_cast<std::size_t>(d)]);
      }
  }

  /// The plain name of an outermost face along an axis, such as "-x"; empty for any other plane.
  std::string plain_name(const Plane& plane) const {
    for (int d = 0; d < 3; ++d) {
      if (std::abs(plane.normal[d]) != 1.0) continue;
      const bool is_upper = plane.normal[d] > 0;
      const double outermost = is_upper ? solid_.upper[d] : -solid_.lower[d];
      if (plane.offset == outermost) return {is_upper ? '+' : '-', "xyz"[d]};
    }
    return {};
  }

  void add_side(const Plane& plane, const std::string& own_name) {
    std::vector<std::string> names{plain_name(plane), own_name};
    std::erase(names, std::string());
    const std::size_t plain = names.size();
    for (std::size_t i = 0; i < plain && !shape_.name.empty(); ++i) names.push_back(shape_.name + "." + names[i]);
    solid_.sides.push_back({names, plane});
  }

  Plane base() const { return {{0, 0, -1}, -solid_.lower.z}; }
  Plane top() const { return {{0, 0, 1}, solid_.upper.z}; }

  void add_sides() {
    std::vector<std::pair<int, int>> order;  // the user's number, our number
    for (int i = 0; i < size(); ++i) order.emplace_back(users_edge(i), i);
    std::sort(order.begin(), order.end());
    for (const auto& [number, i] : order) {
      side_of_edge_[{i, (i + 1) % size()}] = static_cast<Index>(solid_.sides.size());
      add_side(upright_plane(point(i), point(i + 1)), fmt::format("edge{}", number));
    }
    add_side(base(), "");
    add_side(top(), "");
  }

  void add_piece(const std::vector<int>& loop) {
    ConvexPiece piece;
    piece.lower = solid_.upper;
    piece.upper = solid_.lower;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      const auto side = side_of_edge_.find({a, b});
      piece.walls.push_back({upright_plane(point(a), point(b)), side == side_of_edge_.end() ? -1 : side->second});
      for (int d = 0; d < 2; ++d) {
        piece.lower[d] = std::min(piece.lower[d], point(a)[static_cast<std::size_t>(d)]);
        piece.upper[d] = std::max(piece.upper[d], point(a)[static_cast<std::size_t>(d)]);
      }
    }
    std::swap(piece.lower.z, piece.upper.z);
    piece.walls.push_back({base(), static_cast<Index>(solid_.sides.size()) - 2});
    piece.walls.push_back({top(), static_cast<Index>(solid_.sides.size()) - 1});
    solid_.pieces.push_back(std::move(piece));
  }

  const Shape& shape_;
  const PolygonShape& polygon_;
  std::vector<Point2> points_;  // counter-clockwise
  bool is_reversed_ = false;
  std::map<std::pair<int, int>, Index> side_of_edge_;
  Solid solid_;
};

}  // namespace

Solid build_polygon_solid(const Shape& shape, const PolygonShape& polygon) { return Builder(shape, polygon).build(); }

}  // namespace tessera
