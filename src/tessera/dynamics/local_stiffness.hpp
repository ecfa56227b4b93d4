#pragma once

#include <span>
#include <vector>

#include "tessera/mechanics/system.hpp"

namespace tessera {

/// k_a, the sum over row a of the sizes of the stiffness matrix' entries about the reference state [N/m], estimated from
/// above entry by entry: by Gershgorin's theorem no frequency is above max_a sqrt(k_a / m_a), whatever the masses. Takes
/// about the time of one evaluation of the forces. Only for forces with a potential.
std::vector<double> local_stiffness(const System& system);

/// max_a sqrt(k_a / m_a) [1/s].
double frequency_bound(const std::vector<double>& local_stiffness, std::span<const double> mass);

}  // namespace tessera
