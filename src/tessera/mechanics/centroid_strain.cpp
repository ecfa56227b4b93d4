#include "tessera/mechanics/centroid_strain.hpp"

#include <algorithm>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

const Tensor* CentroidStrain::find(const Tensor* F) {
  parallel::for_ranges(0, s_.particles(), [&](std::int64_t begin, std::int64_t end) {
    std::copy(F + begin, F + end, F_.begin() + begin);
  });
  const MovedMeans& moved = s_.d.measure->moved;
  parallel::for_each(static_cast<std::int64_t>(moved.particles.size()), [&](std::int64_t row) {
    const Index a = moved.particles[static_cast<std::size_t>(row)];
    Tensor& F_a = F_[static_cast<std::size_t>(a)];
    for (const MeanTerm& t : moved.terms.row(static_cast<Index>(row)))
      for (int i = 0; i < 9; ++i) F_a.m[i] += t.weight * (F[t.particle].m[i] - F[a].m[i]);
  });
  return F_.data();
}

void CentroidStrain::give_back(const Tensor* P, Tensor* T) const {
  const MovedMeans& returned = s_.returned_means;
  parallel::for_each(static_cast<std::int64_t>(returned.particles.size()), [&](std::int64_t row) {
    Tensor& T_b = T[returned.particles[static_cast<std::size_t>(row)]];
    for (const MeanTerm& t : returned.terms.row(static_cast<Index>(row)))
      for (int i = 0; i < 9; ++i) T_b.m[i] += t.weight * P[t.particle].m[i];
  });
}

}  // namespace tessera
