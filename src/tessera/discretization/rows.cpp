#include "tessera/discretization/rows.hpp"

#include <cmath>
#include <limits>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

Offset Bonds::find(Index a, Index b) const {
  const auto first = neighbour.begin() + begin(a);
  const auto last = neighbour.begin() + end(a);
  const auto it = std::lower_bound(first, last, b);
  return it != last && *it == b ? it - neighbour.begin() : -1;
}

std::vector<Vec3> diagonal_vectors(const Discretization& d) {
  std::vector<Vec3> B_aa(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t row) {
    const auto a = static_cast<Index>(row);
    Vec3 sum;
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i) sum -= d.bonds.B_ab[static_cast<std::size_t>(i)];
    B_aa[static_cast<std::size_t>(a)] = sum;
  });
  for (const BoundaryNode& f : d.nodes) B_aa[static_cast<std::size_t>(f.owner)] -= f.B_af;
  return B_aa;
}

bool is_zero(const Mat3& D) { return contract(D, D) < 1e-24; }

bool is_identity(const Mat3& D) {
  const Mat3 rest = identity() - D;
  return contract(rest, rest) < 1e-24;
}

namespace {

template <class Values>
void move_to_end(Values& all, Values& more) {
  all.insert(all.end(), more.begin(), more.end());
}

template <class T>
void append_rows(Csr<T>& all, const Csr<T>& more) {
  const Offset base = all.offset.back();
  for (std::size_t r = 1; r < more.offset.size(); ++r) all.offset.push_back(base + more.offset[r]);
  all.value.insert(all.value.end(), more.value.begin(), more.value.end());
}

void append_bonds(Bonds& all, Bonds& more, Index shift) {
  const Offset base = all.offset.back();
  for (std::size_t r = 1; r < more.offset.size(); ++r) all.offset.push_back(base + more.offset[r]);
  for (Index b : more.neighbour) all.neighbour.push_back(b + shift);
  move_to_end(all.B_ab, more.B_ab);
  move_to_end(all.area_over_length, more.area_over_length);
}

void append_second_order(SecondOrder& all, SecondOrder more, Index shift) {
  for (CurvedSurface& s : more.surfaces) s.particle += shift;
  for (Index& b : more.derivatives.far.value) b += shift;
  move_to_end(all.derivatives.fit, more.derivatives.fit);
  append_rows(all.derivatives.far, more.derivatives.far);
  move_to_end(all.derivatives.resolved, more.derivatives.resolved);
  move_to_end(all.derivatives.averaged, more.derivatives.averaged);
  move_to_end(all.derivatives.weight, more.derivatives.weight);
  move_to_end(all.derivatives.amplification, more.derivatives.amplification);
  const auto faces = static_cast<Index>(all.M.size());
  for (const Index f : more.face) all.face.push_back(f < 0 ? f : f + faces);
  move_to_end(all.M, more.M);
  move_to_end(all.surfaces, more.surfaces);
}

void append_means(MovedMeans& all, MovedMeans more, Index shift) {
  for (const Index a : more.particles) all.particles.push_back(a + shift);
  for (MeanTerm& t : more.terms.value) t.particle += shift;
  append_rows(all.terms, more.terms);
}

}  // namespace

void append(Discretization& all, Discretization body) {
  if (all.X.empty()) {
    all = std::move(body);
    return;
  }
  const Index particles = all.particles(), sites = static_cast<Index>(all.sites.size());
  const Index nodes = static_cast<Index>(all.nodes.size());
  // Boundary nodes are numbered after all particles, so both ranges of a closure row move.
  for (ClosureTerm& t : all.closure.value)
    if (t.node >= particles) t.node += body.particles();
  for (ClosureTerm& t : body.closure.value) t.node += t.node >= body.particles() ? particles + nodes : particles;
  for (BoundaryNode& f : body.nodes) f.owner += particles, f.site += sites;
  for (BoundarySite& s : body.sites) {
    s.owner += particles;
    for (Index& corner : s.corners)
      if (corner >= 0) corner += particles;
  }
  for (LoadShare& l : body.load.value) l.particle += particles;
  for (ParticleConstraint& c : body.constraints) c.particle += particles;

  move_to_end(all.X, body.X);
  move_to_end(all.volume, body.volume);
  move_to_end(all.B_aa, body.B_aa);
  append_bonds(all.bonds, body.bonds, particles);
  move_to_end(all.nodes, body.nodes);
  append_rows(all.closure, body.closure);
  move_to_end(all.sites, body.sites);
  append_rows(all.load, body.load);
  move_to_end(all.constraints, body.constraints);
  all.boundary_force = body.boundary_force;
  if (body.direct) {
    if (!all.direct) all.direct.emplace();
    move_to_end(all.direct->B_ba, body.direct->B_ba);
    move_to_end(all.direct->B_aa, body.direct->B_aa);
  }
  if (body.measure) {
    move_to_end(all.measure->centroid, body.measure->centroid);
    move_to_end(all.measure->second_moment, body.measure->second_moment);
    append_means(all.measure->moved, std::move(body.measure->moved), particles);
  }
  if (body.second_order) append_second_order(*all.second_order, std::move(*body.second_order), particles);
  all.body_volume += body.body_volume;
}

bool has_potential(const Discretization& d) {
  return !d.direct && (d.boundary_force == BoundaryForce::potential || d.nodes.empty());
}

std::vector<double> shortest_bonds(const Discretization& d) {
  std::vector<double> h(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t row) {
    const auto a = static_cast<Index>(row);
    double shortest = std::numeric_limits<double>::infinity();
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
      if (d.bonds.area_over_length[static_cast<std::size_t>(i)] > 0.0)
        shortest = std::min(shortest, norm(d.branch(a, i)));
    const auto k = static_cast<std::size_t>(a);
    h[k] = std::isfinite(shortest) ? shortest : std::cbrt(d.volume[k]);  // a body of one particle has no bond
  });
  return h;
}

double shortest_length(const Discretization& d) {
  double L = std::numeric_limits<double>::infinity();
  for (double h : shortest_bonds(d)) L = std::min(L, h);
  for (const BoundaryNode& f : d.nodes)
    if (f.wall_share == 2.0) L = std::min(L, norm(f.X - d.X[static_cast<std::size_t>(f.owner)]));
  return L;
}

}  // namespace tessera
