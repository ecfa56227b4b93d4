#include "tessera/simulation/quality_survey.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

constexpr std::size_t kListed = 5;
// Particles are few that need not be there when the shortest step is below this share of that which one particle in
// twenty is below.
constexpr double kFewShare = 0.6;
constexpr double kManyShare = 0.05;

/// Stiffness of each particle's own motion for a modulus of one [m]: of the strain of all cells that it shapes, the sum
/// of |B_ca|^2 / V_c over the particles c, and of its bonds, the sum of A / L.
std::vector<double> stiffness(const Discretization& d) {
  std::vector<double> k(d.X.size(), 0.0);
  for (Index c = 0; c < d.particles(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    k[i] += norm2(d.B_aa[i]) / d.volume[i];
    for (Offset bond = d.bonds.begin(c); bond < d.bonds.end(c); ++bond) {
      const auto b = static_cast<std::size_t>(bond);
      k[static_cast<std::size_t>(d.bonds.neighbour[b])] += norm2(d.bonds.B_ab[b]) / d.volume[i];
      k[i] += static_cast<double>(d.bonds.area_over_length[b]);
    }
  }
  for (const BoundaryNode& node : d.nodes) k[static_cast<std::size_t>(node.owner)] += node.area_over_length;
  return k;
}

double quantile(std::vector<double> values, double share) {
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + std::min(n, static_cast<std::ptrdiff_t>(values.size()) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

void QualitySurvey::add(const BuiltBody& body) {
  const Discretization& d = body.d;
  bodies_.push_back({body.surface.body, X_.size()});
  const std::size_t first = X_.size();
  X_.insert(X_.end(), d.X.begin(), d.X.end());
  user_number_.insert(user_number_.end(), body.user_number.begin(), body.user_number.end());
  volume_.insert(volume_.end(), d.volume.begin(), d.volume.end());
  const std::vector<double> shortest = shortest_bonds(d), k = stiffness(d);
  shortest_.insert(shortest_.end(), shortest.begin(), shortest.end());
  faces_.resize(X_.size(), 0);
  for (Index a = 0; a < d.particles(); ++a) {
    const auto i = static_cast<std::size_t>(a);
    step_.push_back(std::sqrt(d.volume[i] / k[i]));
    for (Offset bond = d.bonds.begin(a); bond < d.bonds.end(a); ++bond)
      faces_[first + i] += d.bonds.area_over_length[static_cast<std::size_t>(bond)] > 0.0;
  }
  // A site is a boundary face of a cell; those of triangles are no faces of their particles.
  if (body.sites_per_piece == 1)
    for (const BoundarySite& s : d.sites) ++faces_[first + static_cast<std::size_t>(s.owner)];
}

PlacedParticle QualitySurvey::placed(std::size_t particle) const {
  auto body = bodies_.begin();
  while (body + 1 != bodies_.end() && (body + 1)->first <= particle) ++body;
  return {body->name, user_number_[particle], X_[particle]};
}

Quality QualitySurvey::quality() const {
  Quality q;
  const std::size_t n = X_.size();
  const auto [smallest, largest] = std::minmax_element(volume_.begin(), volume_.end());
  q.smallest_volume = *smallest;
  q.largest_volume = *largest;
  double volume = 0.0, faces = 0.0;
  for (std::size_t a = 0; a < n; ++a) volume += volume_[a], faces += faces_[a];
  q.mean_volume = volume / static_cast<double>(n);
  q.mean_faces = faces / static_cast<double>(n);
  const auto [fewest, most] = std::minmax_element(faces_.begin(), faces_.end());
  q.fewest_faces = *fewest;
  q.most_faces = *most;
  const auto shortest = std::min_element(shortest_.begin(), shortest_.end());
  q.shortest_bond = *shortest;
  q.typical_bond = quantile(shortest_, 0.5);
  q.at_shortest_bond = placed(static_cast<std::size_t>(shortest - shortest_.begin()));

  const double typical = quantile(step_, 0.5), short_one = quantile(step_, kManyShare);
  std::vector<std::size_t> order(n);
  for (std::size_t a = 0; a < n; ++a) order[a] = a;
  const std::size_t listed = std::min(kListed, n);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(listed), order.end(),
                    [&](std::size_t a, std::size_t b) { return step_[a] != step_[b] ? step_[a] < step_[b] : a < b; });
  for (std::size_t i = 0; i < listed; ++i)
    if (std::isfinite(typical)) q.shortest_steps.push_back({placed(order[i]), step_[order[i]] / typical});
  q.few = std::count_if(step_.begin(), step_.end(), [&](double step) { return step < kFewShare * short_one; });
  return q;
}

}  // namespace tessera
