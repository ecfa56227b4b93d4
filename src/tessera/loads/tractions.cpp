#include "tessera/loads/tractions.hpp"

#include <algorithm>
#include <optional>

#include "tessera/loads/condition_values.hpp"

namespace tessera {

namespace {

/// The values of one entry after the other; sites of an entry come together.
class ValuesOf {
 public:
  explicit ValuesOf(double t) : t_(t) {}

  const TractionValues& operator()(const BoundaryCondition* condition) {
    if (condition != condition_) values_.emplace(*condition, t_);
    condition_ = condition;
    return *values_;
  }

 private:
  double t_;
  const BoundaryCondition* condition_ = nullptr;
  std::optional<TractionValues> values_;
};

}  // namespace

Tractions::Tractions(const Discretization& d, std::vector<LoadedSite> sites) {
  std::vector<Index> particles;
  for (const LoadedSite& l : sites)
    for (const LoadShare& share : d.load.row(l.site)) particles.push_back(share.particle);
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  for (Index a : particles) forces_.push_back({a, Vec3{}});

  for (const LoadedSite& l : sites) {
    const BoundarySite& site = d.sites[static_cast<std::size_t>(l.site)];
    Loaded loaded{site.X, site.N, l.free, l.condition, {}};
    for (const LoadShare& share : d.load.row(l.site)) {
      const auto it = std::lower_bound(particles.begin(), particles.end(), share.particle);
      loaded.shares.push_back({static_cast<std::size_t>(it - particles.begin()), share.area});
    }
    const bool follows = std::holds_alternative<FollowingPressure>(l.condition->kind);
    if (follows) following_sites_.push_back(l.site);
    (follows ? following_ : sites_).push_back(std::move(loaded));
  }
}

void Tractions::add(const Loaded& site, const Vec3& traction) {
  const Vec3 T = site.free * traction;
  for (const Share& share : site.shares) forces_[share.force].force += share.area * T;
}

void Tractions::evaluate(double t) {
  for (NodalForce& f : forces_) f.force = Vec3{};
  ValuesOf values(t);
  for (const Loaded& site : sites_) add(site, values(site.condition).at(site.X, site.N));
  if (following_.empty()) return;
  pressures_.clear();
  for (const Loaded& site : following_) pressures_.push_back(values(site.condition).pressure_at(site.X, site.N));
  dead_ = forces_;
}

void Tractions::follow(std::span<const Vec3> normals) {
  if (following_.empty()) return;
  forces_ = dead_;
  for (std::size_t i = 0; i < following_.size(); ++i) add(following_[i], -pressures_[i] * normals[i]);
}

}  // namespace tessera
