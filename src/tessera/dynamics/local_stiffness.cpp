#include "tessera/dynamics/local_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/dynamics/vectors.hpp"

namespace tessera {

namespace {

/// The sweeps with sizes in place of vectors and tensors: every product is replaced by the product of the sizes, every
/// sum by the sum of sizes, and all free particles are displaced by one.
class SizeSweeps {
 public:
  explicit SizeSweeps(const System& s);
  std::vector<double> stiffness();

 private:
  double share(Index f, double constrained, double free) const;
  void fill();
  void strain();
  void stress(const Material& m, Index a);
  void boundary_bonds();
  void drain();

  std::size_t node(Index f) const { return static_cast<std::size_t>(s_.particles() + f); }

  const System& s_;
  std::vector<double> x_, F_, T_, f_, R_;
};

SizeSweeps::SizeSweeps(const System& s) : s_(s) {
  const auto n = static_cast<std::size_t>(s.particles());
  x_.assign(n + s.d.nodes.size(), 1.0);
  F_.resize(n);
  T_.resize(n);
  f_.resize(n);
  R_.resize(s.d.nodes.size());
  for (const ParticleConstraint& c : s.d.constraints)
    if (c.D == identity()) x_[static_cast<std::size_t>(c.particle)] = 0.0;
}

/// Size of c D + f (I - D) for node f's projection.
double SizeSweeps::share(Index f, double constrained, double free) const {
  const Mat3& D = s_.d.nodes[static_cast<std::size_t>(f)].D;
  const double along = D == Mat3{} ? 0.0 : std::abs(constrained), across = D == identity() ? 0.0 : std::abs(free);
  return std::max(along, across);
}

void SizeSweeps::fill() {
  for (Index f = 0; f < s_.boundary_nodes(); ++f) {
    double sum = 0.0;
    for (const ClosureTerm& t : s_.d.closure.row(f))
      sum += share(f, t.constrained, t.free) * x_[static_cast<std::size_t>(t.node)];
    x_[node(f)] = sum;
  }
}

void SizeSweeps::strain() {
  parallel::for_each(s_.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    const Bonds& bonds = s_.d.bonds;
    double sum = norm(s_.d.B_aa[a]) * x_[a];
    for (Offset k = bonds.offset[a]; k < bonds.offset[a + 1]; ++k) {
      const auto bond = static_cast<std::size_t>(k);
      sum += norm(bonds.B_ab[bond]) * x_[static_cast<std::size_t>(bonds.neighbour[bond])];
    }
    F_[a] = sum / s_.d.volume[a];
  });
  for (Index f = 0; f < s_.boundary_nodes(); ++f) {
    const BoundaryNode& n = s_.d.nodes[static_cast<std::size_t>(f)];
    const auto a = static_cast<std::size_t>(n.owner);
    F_[a] += norm(n.B_af) * x_[node(f)] / s_.d.volume[a];
  }
}

/// The largest stiffness of an isotropic material at rest is 3 K (all round) or 2 G (shear).
void SizeSweeps::stress(const Material& m, Index particle) {
  const auto a = static_cast<std::size_t>(particle);
  const double G = m.shear_modulus(), three_K = 3.0 * m.plane_wave_modulus() - 4.0 * G;
  const double per_area = std::max(m.contact.normal * m.young, m.contact.tangential * G);
  const Bonds& bonds = s_.d.bonds;
  double force = 0.0, moment = 0.0;
  for (Offset k = bonds.offset[a]; k < bonds.offset[a + 1]; ++k) {
    const auto bond = static_cast<std::size_t>(k), b = static_cast<std::size_t>(bonds.neighbour[bond]);
    const double L = norm(s_.d.branch(particle, k));
    const double u = x_[a] + x_[b] + 0.5 * (F_[a] + F_[b]) * L;
    const double bond_force = per_area * bonds.area_over_length[bond] * u;
    force += bond_force;
    moment += bond_force * L;
  }
  f_[a] = force;
  T_[a] = std::max(three_K, 2.0 * G) * F_[a] + 0.5 * moment / s_.d.volume[a];
}

void SizeSweeps::boundary_bonds() {
  for (Index g = 0; g < s_.boundary_nodes(); ++g) {
    const auto f = static_cast<std::size_t>(g), a = static_cast<std::size_t>(s_.d.nodes[f].owner);
    const double L = norm(s_.nodes[f].X_af);
    const double force = std::sqrt(contract(s_.nodes[f].stiffness, s_.nodes[f].stiffness)) * (x_[node(g)] + x_[a] + F_[a] * L);
    f_[a] += force;
    T_[a] += force * L / s_.d.volume[a];
    R_[f] = force;
  }
}

void SizeSweeps::drain() {
  const auto received = [&](std::span<const ReturnTerm> terms) {
    double sum = 0.0;
    for (const ReturnTerm& t : terms) sum += share(t.node, t.constrained, t.free) * R_[static_cast<std::size_t>(t.node)];
    return sum;
  };
  for (std::size_t f = 0; f < R_.size(); ++f)
    R_[f] += T_[static_cast<std::size_t>(s_.d.nodes[f].owner)] * norm(s_.d.nodes[f].B_af);
  for (Index f = 0; f < s_.boundary_nodes(); ++f) R_[static_cast<std::size_t>(f)] += received(s_.returned_to_node.row(f));
  for (std::size_t i = 0; i < s_.receivers.size(); ++i)
    f_[static_cast<std::size_t>(s_.receivers[i])] += received(s_.returned.row(static_cast<Index>(i)));
}

std::vector<double> SizeSweeps::stiffness() {
  fill();
  strain();
  for (const MaterialRange& r : s_.ranges)
    parallel::for_ranges(r.begin, r.end, [&](std::int64_t begin, std::int64_t end) {
      for (auto a = static_cast<Index>(begin); a < static_cast<Index>(end); ++a)
        stress(s_.materials[static_cast<std::size_t>(r.material)], a);
    });
  boundary_bonds();
  drain();
  parallel::for_each(s_.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    const Bonds& bonds = s_.d.bonds;
    double sum = T_[a] * norm(s_.d.B_aa[a]);
    for (Offset k = bonds.offset[a]; k < bonds.offset[a + 1]; ++k) {
      const auto bond = static_cast<std::size_t>(k);
      sum += T_[static_cast<std::size_t>(bonds.neighbour[bond])] * norm(bonds.B_ba[bond]);
    }
    f_[a] += sum;
  });
  for (std::size_t a = 0; a < f_.size(); ++a)
    if (x_[a] == 0.0) f_[a] = 0.0;  // held
  return std::move(f_);
}

}  // namespace

std::vector<double> local_stiffness(const System& system) { return SizeSweeps(system).stiffness(); }

double frequency_bound(const std::vector<double>& local_stiffness, std::span<const double> mass) {
  return std::sqrt(largest_of(static_cast<std::int64_t>(mass.size()), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    return local_stiffness[a] / mass[a];
  }));
}

}  // namespace tessera
