#pragma once

#include <algorithm>
#include <map>
#include <set>

#include "support/reference_sums.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera::test {

/// The formulation of [D] written from its sums: clusters, their boundary triangles, dense tables.
class DelaunayReference {
 public:
  explicit DelaunayReference(const TetrahedralMesh& mesh) : X(mesh.points), B(X.size()), V(X.size()), near(X.size()) {
    for (std::size_t a = 0; a < X.size(); ++a) add_cluster(mesh, a);
  }

  /// F_a = 1/V_a sum_b x_b (x) B_ab, [D 28].
  Mat3 deformation_gradient(const std::vector<Vec3>& x, std::size_t a) const {
    Mat3 F;
    for (std::size_t b : near[a]) F += outer(x[b], B(a, b));
    return (1.0 / V[a]) * F;
  }

  /// [D 45]
  std::vector<Vec3> internal_force(const std::vector<Vec3>& x, const Material& m) const {
    std::vector<Vec3> f(X.size());
    for (std::size_t a = 0; a < X.size(); ++a)
      for (std::size_t b : near[a]) f[a] -= reference_stress(m, deformation_gradient(x, b)) * B(b, a);
    return f;
  }

  /// [D 50] with H of [D 39].
  std::vector<Vec3> contact_force(const std::vector<Vec3>& x, const Material& m) const {
    std::vector<Vec3> f(X.size());
    for (std::size_t a = 0; a < X.size(); ++a) {
      for (std::size_t b : near[a])
        if (b != a) f[a] += bond(x, m, a, b).dU_dx;
      for (std::size_t b : near[a])
        for (std::size_t c : near[b])
          if (c != b) f[a] -= (0.5 * dot(X[c] - X[b], B(b, a)) / V[b]) * bond(x, m, b, c).dU_dy;
    }
    return f;
  }

  std::vector<Vec3> X;
  Table<Vec3> B;  // [D 27]
  std::vector<double> V;
  std::vector<std::vector<std::size_t>> near;  // P_a: neighbours and the particle itself

 private:
  using Triangle = std::array<Index, 3>;

  /// Triangles that only one tetrahedron of a's cluster has make up the cluster's boundary.
  void add_cluster(const TetrahedralMesh& mesh, std::size_t a) {
    std::map<Triangle, std::pair<int, Vec3>> faces;  // how often, outward area vector
    std::set<std::size_t> all;
    for (const auto& t : mesh.tetrahedra) {
      if (std::find(t.begin(), t.end(), static_cast<Index>(a)) == t.end()) continue;
      all.insert(t.begin(), t.end());
      for (std::size_t apex = 0; apex < 4; ++apex) {
        Triangle key{};
        std::size_t k = 0;
        for (std::size_t i = 0; i < 4; ++i)
          if (i != apex) key[k++] = t[i];
        const Vec3 &p = at(key[0]), &q = at(key[1]), &r = at(key[2]);
        Vec3 area = 0.5 * cross(q - p, r - p);
        const double height = dot(at(t[apex]) - p, area);
        if (height > 0.0) area = -area;
        V[a] += std::abs(height) / 3.0 / 4.0;  // V = V_cluster / (n + 1)
        std::sort(key.begin(), key.end());
        ++faces[key].first;
        faces[key].second = area;
      }
    }
    V[a] /= 4.0;  // each tetrahedron was met once for every face
    near[a].assign(all.begin(), all.end());
    for (const auto& [triangle, face] : faces)
      if (face.first == 1)
        for (Index b : triangle) B(a, static_cast<std::size_t>(b)) += (1.0 / 12.0) * face.second;
  }

  ReferenceBond bond(const std::vector<Vec3>& x, const Material& m, std::size_t a, std::size_t b) const {
    const double area = 4.0 * 0.5 * (norm(B(a, b)) + norm(B(b, a))), L = norm(X[b] - X[a]);
    const Mat3 F_ab = 0.5 * (deformation_gradient(x, a) + deformation_gradient(x, b));
    return reference_bond(m.contact.normal * m.young * area / L, m.contact.tangential * m.shear_modulus() * area / L,
                          x[b] - x[a], F_ab * (X[b] - X[a]));
  }

  const Vec3& at(Index i) const { return X[static_cast<std::size_t>(i)]; }
};

}  // namespace tessera::test
