#include "tessera/mechanics/system.hpp"

#include <algorithm>

#include "tessera/discretization/rows.hpp"
#include "tessera/mechanics/cubature.hpp"

namespace tessera {

namespace {

std::vector<MaterialRange> material_ranges(const std::vector<Index>& material_of) {
  std::vector<MaterialRange> ranges;
  for (Index a = 0; a < static_cast<Index>(material_of.size()); ++a) {
    const Index m = material_of[static_cast<std::size_t>(a)];
    if (ranges.empty() || ranges.back().material != m) ranges.push_back({a, a, m});
    ranges.back().end = a + 1;
  }
  return ranges;
}

/// Boundary bond (theory, 14). The normal of a face that is wholly held turns with the body, so that no rotation costs
/// energy. Directions that are held one by one do not turn; nor do those of ghosts, [V 30, 49, 50].
NodeMechanics node_mechanics(const BoundaryNode& f, const Vec3& X_a, const Material& m, BoundaryForce force) {
  const Mat3 NN = outer(f.N, f.N);
  const double Kn = m.contact.normal * m.young * f.area_over_length;
  const double Kt = m.contact.tangential * m.shear_modulus() * f.area_over_length;
  if (is_identity(f.D) && force == BoundaryForce::potential) return {f.X - X_a, Kt * identity(), Kn - Kt};
  return {f.X - X_a, f.D * (Kn * NN + Kt * (identity() - NN)) * f.D, 0.0};
}

void group_owners(System& s) {
  for (Index f = 0; f < s.boundary_nodes(); ++f) {
    const Index owner = s.d.nodes[static_cast<std::size_t>(f)].owner;
    if (s.owners.empty() || s.owners.back() != owner) {
      s.owners.push_back(owner);
      s.first_node.push_back(f);
    }
  }
  s.first_node.push_back(s.boundary_nodes());
}

void transpose_closure(System& s) {
  using Target = RowItem<ReturnTerm>;
  std::vector<Target> to_particles, to_nodes;
  for (Index f = 0; f < s.boundary_nodes(); ++f)
    for (const ClosureTerm& t : s.d.closure.row(f)) {
      const ReturnTerm term{f, t.constrained, t.free};
      if (t.node < s.particles())
        to_particles.push_back({t.node, term});
      else
        to_nodes.push_back({t.node - s.particles(), term});
    }
  s.returned = group_by_used_row(std::move(to_particles), s.receivers);
  const Csr<Target> rows = group_by_row<Target>(s.boundary_nodes(), to_nodes, [](const Target& t) { return t.row; });
  s.returned_to_node.offset = rows.offset;
  for (const Target& t : rows.value) s.returned_to_node.value.push_back(t.item);
}

/// The transpose of the means that are moved, per volume.
MovedMeans returned_means(const Discretization& d) {
  std::vector<RowItem<MeanTerm>> parts;
  const MovedMeans& moved = d.measure->moved;
  for (Index row = 0; row < moved.terms.rows(); ++row) {
    const Index a = moved.particles[static_cast<std::size_t>(row)];
    double sum = 0.0;
    for (const MeanTerm& t : moved.terms.row(row)) {
      const double share = d.volume[static_cast<std::size_t>(a)] / d.volume[static_cast<std::size_t>(t.particle)];
      parts.push_back({t.particle, {a, share * t.weight}});
      sum += t.weight;
    }
    parts.push_back({a, {a, -sum}});
  }
  MovedMeans returned;
  returned.terms = group_by_used_row(std::move(parts), returned.particles);
  return returned;
}

/// The owners of each tile's boundary nodes.
void find_owners_of_tiles(System& s) {
  for (Tile& t : s.tiles.tiles)
    t.first_owner = static_cast<Index>(std::lower_bound(s.owners.begin(), s.owners.end(), t.begin) - s.owners.begin());
}

/// What of the bonds' lengths is needed later, and the viscosity's lengths.
void measure_bonds(System& s, const std::vector<Index>& material_of) {
  s.shortest_length = shortest_length(s.d);
  const std::vector<double> h = shortest_bonds(s.d);
  for (MaterialRange& r : s.ranges) r.shortest_bond = *std::min_element(h.begin() + r.begin, h.begin() + r.end);
  const bool viscous = std::any_of(s.materials.begin(), s.materials.end(), [](const Material& m) {
    return m.viscosity.linear > 0.0 || m.viscosity.quadratic > 0.0;
  });
  if (!viscous) return;
  for (std::size_t a = 0; a < h.size(); ++a)
    s.viscosity.push_back(viscosity_law(s.materials[static_cast<std::size_t>(material_of[a])], h[a]));
}

}  // namespace

System make_system(Discretization d, std::vector<Material> materials, const std::vector<Index>& material_of,
                   Index particles_per_tile, Volumetric volumetric) {
  System s;
  s.d = std::move(d);
  s.materials = std::move(materials);
  s.ranges = material_ranges(material_of);
  s.mass.resize(s.d.X.size());
  for (std::size_t a = 0; a < s.mass.size(); ++a)
    s.mass[a] = s.materials[static_cast<std::size_t>(material_of[a])].density * s.d.volume[a];
  for (const BoundaryNode& f : s.d.nodes) {
    const auto a = static_cast<std::size_t>(f.owner);
    const Material& m = s.materials[static_cast<std::size_t>(material_of[a])];
    s.nodes.push_back(node_mechanics(f, s.d.X[a], m, s.d.boundary_force));
  }
  group_owners(s);
  transpose_closure(s);
  measure_bonds(s, material_of);
  s.tiles = make_tiles(s.d, s.ranges, particles_per_tile > 0 ? particles_per_tile : tile_size(s.particles()));
  find_owners_of_tiles(s);
  if (s.d.second_order) {
    s.second_order = second_order_system(s.d, s.tiles);
    s.stress_points = stress_points_of_a_cell;
    s.d.second_order.reset();
    s.d.measure->second_moment = {};
  } else if (s.d.measure) {
    s.gradients = cell_gradients(s.d);
    s.returned_means = returned_means(s.d);
    s.d.measure->second_moment = {};
    s.stress_points = stress_points_of_a_cell;
  }
  if (volumetric == Volumetric::averaged) s.average = volume_average(s.d);
  s.d.bonds = {};
  return s;
}

}  // namespace tessera
