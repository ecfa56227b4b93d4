#include "tessera/tessellation/voronoi_corner.hpp"

#include <functional>

#include "tessera/tessellation/plane_order.hpp"

namespace tessera {
namespace {

/// Planes whose unit normals span less volume than this do not fix a point.
constexpr double kParallel = 1e-9;
constexpr double kParallel2 = kParallel * kParallel;

/// Three equations normal . x = value. The normals may have any length.
struct System {
  std::array<Vec3, 3> normal;
  Vec3 value;

  Vec3 solve(const Vec3& right, double determinant) const {
    const Vec3 x = right.x * cross(normal[1], normal[2]) + right.y * cross(normal[2], normal[0]) +
                   right.z * cross(normal[0], normal[1]);
    return (1.0 / determinant) * x;
  }
  Vec3 residual(const Vec3& x) const { return value - Vec3{dot(normal[0], x), dot(normal[1], x), dot(normal[2], x)}; }
};

/// Puts `item` among the first `count` items so that they stay sorted.
template <class T, std::size_t N, class Before>
void insert_sorted(std::array<T, N>& items, int& count, const T& item, Before before) {
  auto i = static_cast<std::size_t>(count++);
  for (; i > 0 && before(item, items[i - 1]); --i) items[i] = items[i - 1];
  items[i] = item;
}

}  // namespace

void Corner::add(Index generator) { insert_sorted(generators_, generator_count_, generator, std::less<>()); }

void Corner::add(const Plane& wall) { insert_sorted(walls_, wall_count_, forward(wall), comes_before); }

Vec3 corner_position(const Generators& points, const Corner& corner, const Vec3& estimate) {
  const Index first = corner.generators()[0];
  const Vec3& base = points[static_cast<std::size_t>(first)];
  System system;
  int row = 0;
  const auto add_row = [&](const Vec3& normal, double value) {
    system.normal[static_cast<std::size_t>(row)] = normal;
    system.value[row++] = value;
  };
  for (const Index generator : corner.generators().subspan(1)) {
    const Vec3 branch = points[static_cast<std::size_t>(generator)] - base;
    add_row(branch, points.offset(first, generator, norm2(branch)));
  }
  for (const Plane& wall : corner.walls()) add_row(wall.normal, -wall.height(base));
  const double determinant = dot(system.normal[0], cross(system.normal[1], system.normal[2]));
  const double scale2 = norm2(system.normal[0]) * norm2(system.normal[1]) * norm2(system.normal[2]);
  if (determinant * determinant < kParallel2 * scale2) return estimate;
  Vec3 x = system.solve(system.value, determinant);
  x += system.solve(system.residual(x), determinant);  // leaves the corner on all planes to round-off
  return base + x;
}

}  // namespace tessera
