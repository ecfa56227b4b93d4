#include "tessera/mechanics/boundary.hpp"

#include <vector>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

/// Calls body(f) for every boundary node of owner number `k`.
template <class Body>
void for_each_node(const System& s, Index k, Body&& body) {
  const auto i = static_cast<std::size_t>(k);
  for (Index f = s.first_node[i]; f < s.first_node[i + 1]; ++f) body(f);
}

/// Calls body(f, k) for every boundary node, owner by owner; k is the owner's number.
template <class Body>
void for_each_owned(const System& s, Body&& body) {
  parallel::for_each(static_cast<std::int64_t>(s.owners.size()), [&](std::int64_t i) {
    const auto k = static_cast<Index>(i);
    for_each_node(s, k, [&](Index f) { body(f, k); });
  });
}

const BoundaryNode& node(const System& s, Index f) { return s.d.nodes[static_cast<std::size_t>(f)]; }
const NodeMechanics& mechanics(const System& s, Index f) { return s.nodes[static_cast<std::size_t>(f)]; }

/// Energy of a boundary bond and its derivatives.
struct BoundaryBond {
  double energy = 0.0;  // [J]
  Vec3 dU_du;           // [N]
  Vec3 dU_dw;           // with respect to w = F_a N, at fixed u [N m]
};

/// Theory, (14); u is the bond's displacement.
BoundaryBond boundary_bond(const NodeMechanics& m, const Vec3& u, const Vec3& w) {
  const double p = dot(u, w) / norm2(w);
  const Vec3 pull = m.stiffness * u + (m.along_N * p) * w;
  return {0.5 * dot(u, pull), pull, (m.along_N * p) * (u - p * w)};
}

}  // namespace

void fill_boundary_nodes(const System& s, std::span<const Vec3> walls, Double4* x) {
  // Within an owner fully prescribed nodes come first, so nodes that follow them see their new position.
  for_each_owned(s, [&](Index f, Index) {
    Double4 constrained{}, free{};
    for (const ClosureTerm& t : s.d.closure.row(f)) {
      constrained += t.constrained * x[t.node];
      free += t.free * x[t.node];
    }
    const BoundaryNode& n = node(s, f);
    const Vec3 prescribed = n.wall_share * walls[static_cast<std::size_t>(f)] + to_vec3(constrained);
    const Vec3 follows = to_vec3(free);
    x[s.particles() + f] = to_kernel(n.D * (prescribed - follows) + follows);
  });
}

void add_boundary_strain(const System& s, const Double4* x, Tensor* F) {
  for_each_owned(s, [&](Index f, Index) {
    const BoundaryNode& n = node(s, f);
    const double inverse_volume = 1.0 / s.d.volume[static_cast<std::size_t>(n.owner)];
    Columns F_a = to_kernel(F[n.owner]);
    add_outer(F_a, x[s.particles() + f] - x[n.owner], inverse_volume * n.B_af);
    F[n.owner] = to_tensor(F_a);
  });
}

double add_boundary_bonds(const System& s, Index k, const Double4* x, const Tensor& F, Columns& T, Double4& f,
                          Double4* R) {
  double energy = 0.0;
  for_each_node(s, k, [&](Index g) {
    const BoundaryNode& n = node(s, g);
    const NodeMechanics& m = mechanics(s, g);
    const Vec3 u = to_vec3(x[s.particles() + g] - x[n.owner] - apply(to_kernel(F), m.X_af));
    const BoundaryBond bond = boundary_bond(m, u, to_mat3(F) * n.N);
    const double inverse_volume = 1.0 / s.d.volume[static_cast<std::size_t>(n.owner)];
    const Double4 force = to_kernel(bond.dU_du);
    add_outer(T, force, -inverse_volume * m.X_af);
    add_outer(T, to_kernel(bond.dU_dw), inverse_volume * n.N);
    f += force;
    R[g] = -force;
    energy += bond.energy;
  });
  return energy;
}

void add_node_forces(const System& s, Index k, const Columns& T, Double4* R) {
  for_each_node(s, k, [&](Index f) { R[f] -= apply(T, node(s, f).B_af); });
}

void drain_boundary_nodes(const System& s, Double4* R, Double4* f, std::span<Vec3> reactions) {
  const auto received = [&](std::span<const ReturnTerm> terms) {
    Vec3 sum;
    for (const ReturnTerm& t : terms) {
      const Vec3 R_f = to_vec3(R[t.node]);
      const Vec3 constrained = node(s, t.node).D * R_f;
      sum += t.constrained * constrained + t.free * (R_f - constrained);
    }
    return to_kernel(sum);
  };
  for_each_owned(s, [&](Index g, Index) { R[g] += received(s.returned_to_node.row(g)); });
  parallel::for_each(static_cast<std::int64_t>(s.receivers.size()), [&](std::int64_t i) {
    f[s.receivers[static_cast<std::size_t>(i)]] += received(s.returned.row(static_cast<Index>(i)));
  });
  for_each_owned(s, [&](Index g, Index) {
    reactions[static_cast<std::size_t>(g)] += node(s, g).wall_share * (node(s, g).D * to_vec3(R[g]));
  });
}

void drain_with_held_branches(const System& s, const Columns* P, Double4* R, Double4* f) {
  for_each_owned(s, [&](Index g, Index k) { R[g] = -apply(P[k], node(s, g).B_af); });
  std::vector<Vec3> to_walls(s.nodes.size());
  drain_boundary_nodes(s, R, f, to_walls);
  for_each_owned(s, [&](Index g, Index) { f[node(s, g).owner] += to_kernel(to_walls[static_cast<std::size_t>(g)]); });
}

void add_direct_reactions(const System& s, const Columns* P, Double4* f, std::span<Vec3> reactions) {
  for_each_owned(s, [&](Index g, Index k) {
    const BoundaryNode& n = node(s, g);
    const Vec3 reaction = n.D * to_vec3(apply(P[k], n.area));
    f[n.owner] += to_kernel(reaction);
    reactions[static_cast<std::size_t>(g)] -= reaction;
  });
}

}  // namespace tessera
