#include "tessera/simulation/approach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tessera {

namespace {

constexpr double nearest = 0.5;  // of the smaller spacing of two bodies

using Cell = std::array<std::int64_t, 3>;

Bounds grown(Bounds box, double distance) {
  const Vec3 d{distance, distance, distance};
  return {box.lower - d, box.upper + d};
}

Cell cell_of(const Vec3& x, double size) {
  Cell cell{};
  for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(x[i] / size));
  return cell;
}

/// The middle of the first pair of points that are nearer to each other than `distance`.
std::optional<Vec3> near_pair(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double distance) {
  std::vector<std::pair<Cell, Index>> cells;
  cells.reserve(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) cells.emplace_back(cell_of(b[i], distance), static_cast<Index>(i));
  std::sort(cells.begin(), cells.end());
  for (const Vec3& x : a) {
    const Cell middle = cell_of(x, distance);
    for (int k = 0; k < 9; ++k) {
      const Cell row{middle[0] + k / 3 - 1, middle[1] + k % 3 - 1, middle[2] - 1};
      const Cell end{row[0], row[1], row[2] + 3};
      for (auto i = std::lower_bound(cells.begin(), cells.end(), std::pair{row, Index{0}});
           i != cells.end() && i->first < end; ++i) {
        const Vec3& y = b[static_cast<std::size_t>(i->second)];
        if (norm(y - x) < distance) return 0.5 * (x + y);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Approach::Approach(const Model& model) : model_(model), particles_(model.bodies.size()) {
  std::vector<double> volume(model.bodies.size(), 0.0);
  if (model.bodies.size() < 2) return;
  for (std::size_t a = 0; a < model.body_of.size(); ++a) {
    const auto body = static_cast<std::size_t>(model.body_of[a]);
    particles_[body].push_back(static_cast<Index>(a));
    volume[body] += model.system.d.volume[a];
  }
  for (std::size_t i = 0; i < volume.size(); ++i) {
    spacing_.push_back(std::cbrt(volume[i] / static_cast<double>(particles_[i].size())));
    for (std::size_t j = i + 1; j < volume.size(); ++j) pairs_.push_back({i, j, std::nullopt});
  }
}

Bounds Approach::box_of(std::size_t body, const Field<Double4>& x) const {
  Bounds box;
  for (const Index a : particles_[body]) box.include(to_vec3(x[static_cast<std::size_t>(a)]));
  return box;
}

std::vector<Vec3> Approach::positions_in(const Bounds& box, std::size_t body, const Field<Double4>& x) const {
  std::vector<Vec3> positions;
  for (const Index a : particles_[body])
    if (const Vec3 position = to_vec3(x[static_cast<std::size_t>(a)]); box.contains(position))
      positions.push_back(position);
  return positions;
}

void Approach::look(const Field<Double4>& x, double time) {
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < spacing_.size(); ++i) boxes.push_back(box_of(i, x));
  for (Pair& pair : pairs_) {
    if (pair.meeting) continue;
    const double distance = nearest * std::min(spacing_[pair.first], spacing_[pair.second]);
    const Bounds reach = grown(boxes[pair.first], distance);
    if (!reach.meets(boxes[pair.second])) continue;
    const std::vector<Vec3> first = positions_in(grown(boxes[pair.second], distance), pair.first, x);
    if (const auto middle = near_pair(first, positions_in(reach, pair.second, x), distance))
      pair.meeting = Meeting{time, *middle};
  }
}

std::vector<std::string> Approach::warnings() const {
  std::vector<std::string> list;
  for (const Pair& pair : pairs_)
    if (pair.meeting)
      list.push_back(fmt::format(
          "bodies \"{}\" and \"{}\" came to each other at ({:.4g}, {:.4g}, {:.4g}) m, seen first at t = {:.4g} s, "
          "and go through each other, for bodies do not feel each other yet: trust the time before, keep them apart, "
          "or make them one shape (union)",
          model_.bodies[pair.first].name, model_.bodies[pair.second].name, pair.meeting->x.x, pair.meeting->x.y,
          pair.meeting->x.z, pair.meeting->time));
  return list;
}

}  // namespace tessera
