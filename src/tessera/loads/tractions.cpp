#include "tessera/loads/tractions.hpp"

#include <algorithm>

namespace tessera {

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
    sites_.push_back(std::move(loaded));
  }
}

void Tractions::evaluate(double t) {
  for (NodalForce& f : forces_) f.force = Vec3{};
  const BoundaryCondition* condition = nullptr;
  Vec3 traction;
  double pressure = 0.0;
  for (const Loaded& site : sites_) {
    if (const auto* p = std::get_if<NominalPressure>(&site.condition->kind)) {
      if (site.condition != condition || p->pressure.depends_on_position()) pressure = p->pressure(t, site.X);
      traction = -pressure * site.N;
    } else {
      const auto& T = std::get<NominalTraction>(site.condition->kind).components;
      const bool same = site.condition == condition;
      for (int i = 0; i < 3; ++i) {
        const Formula& component = T[static_cast<std::size_t>(i)];
        if (!same || component.depends_on_position()) traction[i] = component(t, site.X);
      }
    }
    condition = site.condition;
    const Vec3 T = site.free * traction;
    for (const Share& share : site.shares) forces_[share.force].force += share.area * T;
  }
}

}  // namespace tessera
