#include <algorithm>

#include "tessera/mechanics/contact_bonds.hpp"
#include "tessera/mechanics/sweeps.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

namespace {

/// What the sweep reads and writes of a tile.
struct ContactTile {
  ContactTile(const System& s, Index k, Double4* f, TileScratch& scratch)
      : tile(tile_of(s, k)),
        nodes(scratch.nodes.data()),
        order(s.tiles.order.data() + quad * tile.quad),
        length(s.tiles.length.data() + tile.quad),
        volume(s.d.volume.data() + tile.begin),
        f_own(f + tile.begin),
        T(scratch.T.data()) {
    const Material& m = s.materials[static_cast<std::size_t>(tile.material)];
    const double Kn = m.contact.normal * m.young, Kt = m.contact.tangential * m.shear_modulus();
    stiffness = {Kt, Kn - Kt};
  }

  const Tile& tile;
  const TileNode* nodes;
  const std::uint16_t *order, *length;
  const double* volume;
  Double4* __restrict f_own;
  Columns* __restrict T;
  ContactStiffness stiffness{};
};

/// Forces follow in the same pass over the tiles.
bool forces_come_next(const System& s) { return !s.second_order && !s.gradients; }

/// The bonds of a quad that come next.
struct QuadBonds {
  QuadBonds(const System& s, const Tile& tile)
      : neighbour(s.tiles.neighbour.data() + tile.slot),
        area_over_length(s.tiles.area_over_length.data() + tile.slot),
        B(forces_come_next(s) ? reinterpret_cast<const char*>(s.tiles.B.data() + tile.slot)
                              : reinterpret_cast<const char*>(neighbour)),
        B_bytes(forces_come_next(s) ? static_cast<std::ptrdiff_t>(quad * sizeof(Vec3)) : 0) {}

  Double4 A_L() const {
    return Double4{area_over_length[0], area_over_length[1], area_over_length[2], area_over_length[3]};
  }
  /// The force sweep reads the gradient vectors of the tile in another order, so they are brought near, unless it
  /// comes in another pass: then the same line is fetched again and again.
  void fetch_B() const {
    fetch_ahead<0>(B);
    fetch_ahead<64>(B);
  }
  void fetch() const {
    fetch_B();
    fetch_ahead<640>(neighbour);
    fetch_ahead<2560>(area_over_length);
  }
  void advance(Index bonds) {
    neighbour += quad * bonds;
    area_over_length += quad * bonds;
    B += B_bytes * bonds;
  }

  const std::uint16_t* neighbour;
  const double* area_over_length;
  const char* B;
  std::ptrdiff_t B_bytes;  // of a bond of each particle
};

/// Writes the sums of quad q.
inline void keep(const ContactTile& c, Index q, const BondSums<Double4>& sums) {
  const std::uint16_t* order = c.order + quad * q;
  fetch_ahead<1024>(order);
  fetch_ahead<1024>(c.volume + quad * q);
  fetch_to_write<2048>(c.f_own + quad * q);
  fetch_to_write<2112>(c.f_own + quad * q);
  const Double4 share = -0.5 / Double4{c.volume[order[0]], c.volume[order[1]], c.volume[order[2]], c.volume[order[3]]};
  const FourVectors force = transposed(sums.force), T0 = transposed(share * sums.moment_0),
                    T1 = transposed(share * sums.moment_1), T2 = transposed(share * sums.moment_2);
  // Backwards: lanes that fill up the last quad repeat its last particle and come before it.
  for (Index lane = quad; lane-- > 0;) {
    c.f_own[order[lane]] = force.v[lane];
    c.T[order[lane]] = {T0.v[lane], T1.v[lane], T2.v[lane]};
  }
}

}  // namespace

TESSERA_KERNEL double contact_sweep_of_four(const System& s, Index k, const Double4* x, const Tensor* F, Double4* f,
                                            TileScratch& scratch) {
  fill_nodes(s, k, x, F, scratch.nodes.data());
  const ContactTile c(s, k, f, scratch);
  QuadBonds bonds(s, c.tile);
  Double4 energy{};
  for (Index q = 0; q < c.tile.quads(); ++q) {
    const Nodes<Double4> a = load_nodes(c.nodes, c.order + quad * q);
    BondSums<Double4> sums;
    for (Index i = 0; i < c.length[q]; ++i, bonds.advance(1)) {
      bonds.fetch();
      add_bonds(a, load_nodes(c.nodes, bonds.neighbour), bonds.A_L(), c.stiffness, sums);
    }
    energy += sums.energy;
    keep(c, q, sums);
  }
  return 0.25 * sum(energy);
}

#ifdef TESSERA_WIDE_KERNEL

namespace {

template <class Half>
inline BondSums<Double4> half_of(const BondSums<Double8>& sums, const Half& half) {
  const auto vector = [&](const Lanes3Of<Double8>& v) { return Lanes3{half(v.x), half(v.y), half(v.z)}; };
  return {vector(sums.force), vector(sums.moment_0), vector(sums.moment_1), vector(sums.moment_2), half(sums.energy)};
}

/// Adds the bonds that the longer of two quads has more; the lanes of the other one do as it does, without stiffness.
template <class Join>
inline void add_rest(const ContactTile& c, QuadBonds& bonds, Index q, Index count, const Join& join,
                     BondSums<Double8>& sums) {
  if (count <= 0) return;
  const std::uint16_t* order = c.order + quad * q;
  const Nodes<Double8> a = load_nodes(c.nodes, order, order);
  for (Index i = 0; i < count; ++i, bonds.advance(1)) {
    bonds.fetch();
    add_bonds(a, load_nodes(c.nodes, bonds.neighbour, bonds.neighbour), join(bonds.A_L()), c.stiffness, sums);
  }
}

TESSERA_WIDE_KERNEL double contact_sweep_of_eight(const System& s, Index k, const Double4* x, const Tensor* F,
                                                  Double4* f, TileScratch& scratch) {
  fill_nodes(s, k, x, F, scratch.nodes.data());
  const ContactTile c(s, k, f, scratch);
  const Index quads = c.tile.quads();
  QuadBonds first(s, c.tile);
  const Double4 none{};
  Double8 energy{};
  for (Index q = 0; q < quads; q += 2) {
    const Index r = std::min(q + 1, quads - 1);  // the last quad may be alone
    const Index length_1 = c.length[q], length_2 = r > q ? c.length[r] : 0, both = std::min(length_1, length_2);
    QuadBonds second = first;
    second.advance(length_1);
    const Nodes<Double8> a = load_nodes(c.nodes, c.order + quad * q, c.order + quad * r);
    BondSums<Double8> sums;
    for (Index i = 0; i < both; ++i, first.advance(1), second.advance(1)) {
      first.fetch();
      second.fetch_B();  // the rest is near what the first quad fetches
      add_bonds(a, load_nodes(c.nodes, first.neighbour, second.neighbour), joined(first.A_L(), second.A_L()),
                c.stiffness, sums);
    }
    add_rest(
        c, first, q, length_1 - both, [&](const Double4& A_L) { return joined(A_L, none); }, sums);
    add_rest(
        c, second, r, length_2 - both, [&](const Double4& A_L) { return joined(none, A_L); }, sums);
    energy += sums.energy;
    keep(c, q, half_of(sums, [](const Double8& l) { return first_half(l); }));
    if (r > q) keep(c, r, half_of(sums, [](const Double8& l) { return second_half(l); }));
    first = second;
  }
  return 0.25 * (sum(first_half(energy)) + sum(second_half(energy)));
}

}  // namespace

double contact_sweep(const System& s, Index k, const Double4* x, const Tensor* F, Double4* f, TileScratch& scratch) {
  static const bool wide = has_wide_registers();
  return wide ? contact_sweep_of_eight(s, k, x, F, f, scratch) : contact_sweep_of_four(s, k, x, F, f, scratch);
}

#else

double contact_sweep(const System& s, Index k, const Double4* x, const Tensor* F, Double4* f, TileScratch& scratch) {
  return contact_sweep_of_four(s, k, x, F, f, scratch);
}

#endif

}  // namespace tessera
