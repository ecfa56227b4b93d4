#include "tessera/mechanics/following.hpp"

#include <vector>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

Vec3 present_normal(const System& s, Index site, const Double4* x, const Tensor* F) {
  const BoundarySite& face = s.d.sites[static_cast<std::size_t>(site)];
  if (face.corners[0] < 0) return cofactor(to_mat3(F[face.owner])) * face.N;
  const auto [a, b, c] = face.corners;
  const auto reference = [&](Index v) { return s.d.X[static_cast<std::size_t>(v)]; };
  const double twice_area = norm(cross(reference(b) - reference(a), reference(c) - reference(a)));
  return cross(to_vec3(x[b] - x[a]), to_vec3(x[c] - x[a])) / twice_area;
}

void follow_faces(const System& s, const Double4* x, const Tensor* F, Tractions& tractions) {
  const std::span<const Index> sites = tractions.following_sites();
  std::vector<Vec3> normals(sites.size());
  parallel::for_each(static_cast<std::int64_t>(sites.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    normals[k] = present_normal(s, sites[k], x, F);
  });
  tractions.follow(normals);
}

}  // namespace tessera
