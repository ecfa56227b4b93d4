#include "tessera/tessellation/mesh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

constexpr double flatness = 1e-12;  // of the longest edge cubed
constexpr double nearness = 1e-9;   // of the mesh's size

bool is_finite(const Vec3& X) { return std::isfinite(X.x) && std::isfinite(X.y) && std::isfinite(X.z); }

void refuse_infinite_points(const FileMesh& file) {
  for (std::size_t i = 0; i < file.points.size(); ++i)
    // A hundred orders of magnitude below the largest double, so that volumes are finite too.
    if (!is_finite(file.points[i]) || norm2(file.points[i]) > 1e200)
      throw GeometryError(
          fmt::format("{}: {} is not a finite position: correct it", file.path, describe_point(file, i)));
}

void refuse_isolated_points(const FileMesh& file) {
  std::vector<char> used(file.points.size(), 0);
  for (const auto& element : file.tetrahedra)
    for (const Index v : element.vertices) used[static_cast<std::size_t>(v)] = 1;
  const auto first = std::find(used.begin(), used.end(), 0);
  if (first == used.end()) return;
  throw GeometryError(
      fmt::format("{}: {} of {} nodes belong to no tetrahedron, first {}: write only the volume's nodes (in Gmsh: give "
                  "the volume a physical group, "
                  "or switch Mesh.SaveAll off)",
                  file.path, std::count(used.begin(), used.end(), 0), used.size(),
                  describe_point(file, static_cast<std::size_t>(first - used.begin()))));
}

/// The points in the order of their projection on a direction that no regular mesh has, so that few share one.
std::vector<std::pair<double, std::size_t>> in_order_of_projection(std::span<const Vec3> points) {
  const Vec3 direction{0.48507125007, 0.72760687511 / 1.3, 0.67082039325};
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(dot(direction, points[i]), i);
  std::sort(order.begin(), order.end());
  return order;
}

double size_of(std::span<const Vec3> points) {
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& X : points)
    for (int d = 0; d < 3; ++d) lower[d] = std::min(lower[d], X[d]), upper[d] = std::max(upper[d], X[d]);
  return norm(upper - lower);
}

void refuse_doubled_points(const FileMesh& file) {
  const double near = nearness * size_of(file.points);
  const auto order = in_order_of_projection(file.points);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j].first - order[i].first <= 2.0 * near; ++j) {
      const std::size_t a = std::min(order[i].second, order[j].second), b = std::max(order[i].second, order[j].second);
      if (norm(file.points[b] - file.points[a]) > near) continue;
      throw GeometryError(fmt::format(
          "{}: {} and {} are the same point: merge doubled nodes (in Gmsh: Coherence Mesh, or fragment the volumes)",
          file.path, describe_point(file, a), describe_point(file, b)));
    }
}

double longest_edge(const Tetrahedron& t, std::span<const Vec3> points) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      longest =
          std::max(longest, norm(points[static_cast<std::size_t>(t[j])] - points[static_cast<std::size_t>(t[i])]));
  return longest;
}

[[noreturn]] void throw_not_positive(const FileMesh& file, const FileElement<Tetrahedron>& element, double volume,
                                     std::string_view what) {
  const Vec3 X = centroid(element.vertices, file.points);
  throw GeometryError(fmt::format("{} at ({:.6g}, {:.6g}, {:.6g}) is {} (volume {:.3g} m3): mesh again{}",
                                  describe_element(file, element), X.x, X.y, X.z, what, volume,
                                  what == "inverted" ? ", or swap two of its nodes" : ""));
}

}  // namespace

void refuse_bad_points(const FileMesh& file) {
  refuse_infinite_points(file);
  refuse_isolated_points(file);
  refuse_doubled_points(file);
}

void refuse_bad_tetrahedra(const FileMesh& file) {
  for (const auto& element : file.tetrahedra) {
    Tetrahedron sorted = element.vertices;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      throw GeometryError(describe_element(file, element) + " has one node twice: remove or correct it");
    const double volume = six_volume(element.vertices, file.points) / 6.0;
    const double limit = flatness * std::pow(longest_edge(element.vertices, file.points), 3);
    if (volume <= limit) throw_not_positive(file, element, volume, volume < -limit ? "inverted" : "flat");
  }
}

}  // namespace tessera
