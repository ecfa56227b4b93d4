#include "tessera/discretization/neighbour_rings.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tessera {

namespace {

// Distances that differ by less than this fraction are equal.
constexpr double equally_far = 1e-6;

/// Puts values from `begin` on into this order.
template <class T>
void arrange(std::vector<T>& values, std::size_t begin, const std::vector<std::size_t>& order) {
  const std::vector<T> before(values.begin() + static_cast<std::ptrdiff_t>(begin), values.end());
  for (std::size_t i = 0; i < order.size(); ++i) values[begin + i] = before[order[i]];
}

}  // namespace

void NeighbourRings::start(const Discretization& d, Index a) {
  centre_ = a;
  particles_.clear();
  branches_.clear();
  d.for_each_face_neighbour(a, [&](Offset, Index b) { add(d, b); });
  ends_.assign(1, particles_.size());
}

void NeighbourRings::widen(const Discretization& d, int rings) {
  cut(1);
  seen_.resize(d.X.size());
  see(centre_);
  for (const Index b : particles_) see(b);
  std::size_t begin = 0;
  for (int ring = 1; ring < rings; ++ring) {
    for (const std::size_t end = particles_.size(); begin < end; ++begin)
      d.for_each_face_neighbour(particles_[begin], [&](Offset, Index c) {
        if (see(c)) add(d, c);
      });
    ends_.push_back(particles_.size());
  }
  seen_[static_cast<std::size_t>(centre_)] = 0;
  for (const Index b : particles_) seen_[static_cast<std::size_t>(b)] = 0;
}

void NeighbourRings::cut(int rings) {
  ends_.resize(static_cast<std::size_t>(rings));
  particles_.resize(ends_.back());
  branches_.resize(ends_.back());
}

void NeighbourRings::sort_far() {
  std::vector<double> square;
  for (std::size_t i = near(); i < branches_.size(); ++i) square.push_back(norm2(branches_[i]));
  order_.resize(far());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(), [&](std::size_t l, std::size_t r) {
    return std::pair(square[l], particles_[near() + l]) < std::pair(square[r], particles_[near() + r]);
  });
  arrange(particles_, near(), order_);
  arrange(branches_, near(), order_);
}

bool NeighbourRings::ends_within_equals(std::size_t far) const {
  const std::size_t next = near() + far;
  return far > 0 && next < branches_.size() && norm(branches_[next]) < (1.0 + equally_far) * norm(branches_[next - 1]);
}

/// For the first time?
bool NeighbourRings::see(Index a) { return std::exchange(seen_[static_cast<std::size_t>(a)], char{1}) == 0; }

void NeighbourRings::add(const Discretization& d, Index b) {
  particles_.push_back(b);
  branches_.push_back(d.X[static_cast<std::size_t>(b)] - d.X[static_cast<std::size_t>(centre_)]);
}

}  // namespace tessera
