#include "tessera/discretization/neighbour_rings.hpp"

#include <algorithm>
#include <utility>

namespace tessera {

namespace {

// Distances that differ by less than this fraction are equal.
constexpr double equally_far = 1e-6;

Vec3 branch(const Discretization& d, Index a, Index b) {
  return d.X[static_cast<std::size_t>(b)] - d.X[static_cast<std::size_t>(a)];
}

}  // namespace

void NeighbourRings::find_near(const Discretization& d, Index a) {
  particles_.clear();
  branches_.clear();
  d.for_each_face_neighbour(a, [&](Offset, Index b) {
    particles_.push_back(b);
    branches_.push_back(branch(d, a, b));
  });
  near_ = particles_.size();
}

void NeighbourRings::find_far(const Discretization& d, Index a, int within) {
  particles_.resize(near_);
  branches_.resize(near_);
  seen_.resize(d.X.size());
  see(a);
  for (const Index b : particles_) see(b);
  std::size_t begin = 0;
  for (int ring = 1; ring < within; ++ring)
    for (const std::size_t end = particles_.size(); begin < end; ++begin)
      d.for_each_face_neighbour(particles_[begin], [&](Offset, Index c) {
        if (see(c)) particles_.push_back(c);
      });
  seen_[static_cast<std::size_t>(a)] = 0;
  for (const Index b : particles_) seen_[static_cast<std::size_t>(b)] = 0;
  sort_far(d, a);
}

bool NeighbourRings::ends_within_equals(std::size_t far) const {
  const std::size_t next = near_ + far;
  return far > 0 && next < branches_.size() && norm(branches_[next]) < (1.0 + equally_far) * norm(branches_[next - 1]);
}

/// For the first time?
bool NeighbourRings::see(Index a) { return std::exchange(seen_[static_cast<std::size_t>(a)], char{1}) == 0; }

void NeighbourRings::sort_far(const Discretization& d, Index a) {
  const auto square = [&](Index b) { return norm2(branch(d, a, b)); };
  std::sort(particles_.begin() + static_cast<std::ptrdiff_t>(near_), particles_.end(),
            [&](Index l, Index r) { return std::pair(square(l), l) < std::pair(square(r), r); });
  for (std::size_t i = near_; i < particles_.size(); ++i) branches_.push_back(branch(d, a, particles_[i]));
}

}  // namespace tessera
