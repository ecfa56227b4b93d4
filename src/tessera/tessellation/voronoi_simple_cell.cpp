#include "tessera/tessellation/voronoi_simple_cell.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

// Sine of the angle to the plane, squared, below which an edge counts as parallel: where it is crossed is then known to
// 1e-11 of its length, far better than the margins that are asked for.
constexpr double kParallel2 = 1e-10;

}  // namespace

void SimpleCell::start(double half_width) {
  vertices_ = 0;
  faces_ = 6;
  std::fill(tag_.begin(), tag_.begin() + faces_, kBox);
  for (unsigned v = 0; v < 8; ++v) {  // bit d: on the upper face across axis d
    const auto sign = [&](unsigned axis) { return v >> axis & 1U ? 1.0 : -1.0; };
    const auto face = [&](unsigned axis) { return static_cast<std::uint8_t>(2U * axis + (v >> axis & 1U)); };
    const bool is_even = sign(0) * sign(1) * sign(2) > 0.0;
    put(vertices_++, half_width * Vec3{sign(0), sign(1), sign(2)},
        is_even ? Triple{face(0), face(1), face(2)} : Triple{face(0), face(2), face(1)});
  }
  radius2_ = 3.0 * half_width * half_width;
}

SimpleCell::Outcome SimpleCell::clip(const Vec3& normal, double offset, double margin, Index tag) {
  const double normal2 = norm2(normal);
  if (!measure_heights(normal, offset, margin * std::sqrt(normal2))) return Outcome::in_doubt;
  if (dropped_count_ == 0) return Outcome::untouched;
  if (dropped_count_ == vertices_ || faces_ == kMostFaces) return Outcome::in_doubt;
  const auto face = static_cast<std::uint8_t>(faces_++);
  tag_[face] = tag;
  if (!cross_edges(normal2, face)) return Outcome::in_doubt;
  replace_dropped();
  update_radius();
  return Outcome::cut;
}

std::array<Index, 3> SimpleCell::tags(int vertex) const {
  const Triple& t = triple_[static_cast<std::size_t>(vertex)];
  return {tag_[t[0]], tag_[t[1]], tag_[t[2]]};
}

void SimpleCell::put(int vertex, const Vec3& X, const Triple& faces) {
  const auto v = static_cast<std::size_t>(vertex);
  x_[v] = X.x, y_[v] = X.y, z_[v] = X.z;
  triple_[v] = faces;
  for (std::size_t e = 0; e < 3; ++e)
    vertex_at_[edge(faces[e], faces[(e + 1) % 3])] = static_cast<std::uint8_t>(vertex);
}

void SimpleCell::move(int from, int to) { put(to, position(from), triple_[static_cast<std::size_t>(from)]); }

/// Heights of all vertices and the list of those above the plane. Is none within the margin?
bool SimpleCell::measure_heights(const Vec3& normal, double offset, double margin) {
  const auto n = static_cast<std::size_t>(vertices_);
  for (std::size_t v = 0; v < n; ++v) height_[v] = normal.x * x_[v] + normal.y * y_[v] + normal.z * z_[v] - offset;
  int above = 0, close = 0;
  for (std::size_t v = 0; v < n; ++v) {
    dropped_[static_cast<std::size_t>(above)] = static_cast<std::uint8_t>(v);
    above += height_[v] > 0.0;
    close += std::abs(height_[v]) <= margin;
  }
  dropped_count_ = above;
  return close == 0;
}

/// Makes a vertex on every edge that leads from above the plane to below.
bool SimpleCell::cross_edges(double normal2, std::uint8_t face) {
  added_count_ = 0;
  for (int d = 0; d < dropped_count_; ++d) {
    const std::size_t v = dropped_[static_cast<std::size_t>(d)];
    const Triple& t = triple_[v];
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint8_t i = t[e], j = t[(e + 1) % 3];
      const std::size_t w = vertex_at_[edge(j, i)];
      if (height_[w] > 0.0) continue;
      const Vec3 V = position(static_cast<int>(v)), W = position(static_cast<int>(w));
      const double drop = height_[v] - height_[w];
      if (drop * drop < kParallel2 * normal2 * norm2(W - V)) return false;
      if (added_count_ == kMostVertices) return false;
      const double s = height_[v] / drop;
      added_[static_cast<std::size_t>(added_count_++)] = {(1.0 - s) * V + s * W, {i, j, face}};
    }
  }
  return added_count_ >= 3 && vertices_ - dropped_count_ + added_count_ <= kMostVertices;
}

/// New vertices take the places of dropped ones; where there are fewer, the last vertices close the gaps.
void SimpleCell::replace_dropped() {
  for (int i = 0; i < added_count_; ++i) {
    const NewVertex& n = added_[static_cast<std::size_t>(i)];
    put(i < dropped_count_ ? dropped_[static_cast<std::size_t>(i)] : vertices_++, n.X, n.faces);
  }
  for (int i = dropped_count_; i-- > added_count_;) {
    const int gap = dropped_[static_cast<std::size_t>(i)];
    if (gap != --vertices_) move(vertices_, gap);
  }
}

void SimpleCell::update_radius() {
  radius2_ = 0.0;
  for (int v = 0; v < vertices_; ++v) radius2_ = std::max(radius2_, norm2(position(v)));
}

}  // namespace tessera
