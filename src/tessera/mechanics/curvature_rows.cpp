#include "tessera/mechanics/curvature_rows.hpp"

#include <algorithm>
#include <span>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

CurvatureRows::FaceFactors factors(const Symmetric3& m) {
  return {m.xx, 2.0 * m.xy, 2.0 * m.xz, m.yy, 2.0 * m.yz, m.zz};
}

/// Calls body(bond, b) for the bonds of a that have no face.
template <class Body>
void for_each_other(const Discretization& d, Index a, Body&& body) {
  for (Offset bond = d.bonds.begin(a); bond < d.bonds.end(a); ++bond)
    if (d.bonds.area_over_length[static_cast<std::size_t>(bond)] == 0.0)
      body(bond, d.bonds.neighbour[static_cast<std::size_t>(bond)]);
}

/// How many entries a tile's rows have, and how many faces they name.
CurvatureRows::Start sizes(const Discretization& d, const Tile& tile) {
  CurvatureRows::Start count;
  const SecondDerivatives& s = d.second_order->derivatives;
  for (Index a = tile.begin; a < tile.end; ++a) {
    d.for_each_face_neighbour(a, [&](Offset, Index b) {
      ++count.neighbour;
      if (s.averaged[static_cast<std::size_t>(b)]) ++count.mean;
      if (b < tile.begin || b >= tile.end || a < b) ++count.face;
    });
    for_each_other(d, a, [&](Offset, Index) { ++count.other; });
    if (s.averaged[static_cast<std::size_t>(a)]) ++count.averaged;
    count.far += static_cast<Offset>(s.far.row(a).size());
  }
  return count;
}

std::vector<CurvatureRows::Start> starts(const Discretization& d, const Tiles& t) {
  std::vector<CurvatureRows::Start> start(t.tiles.size());
  parallel::for_tasks(t.size(), [&](std::int64_t k) {
    const auto tile = static_cast<std::size_t>(k);
    start[tile + 1] = sizes(d, t.tiles[tile]);
  });
  for (std::size_t k = 1; k < start.size(); ++k) {
    start[k].neighbour += start[k - 1].neighbour;
    start[k].other += start[k - 1].other;
    start[k].mean += start[k - 1].mean;
    start[k].far += start[k - 1].far;
    start[k].face += start[k - 1].face;
    start[k].averaged += start[k - 1].averaged;
  }
  return start;
}

/// Fills the arrays of one tile.
class TileRows {
 public:
  TileRows(const Discretization& d, const Tiles& t, Index k, CurvatureRows& rows)
      : d_(d),
        s_(d.second_order->derivatives),
        tile_(t.tiles[static_cast<std::size_t>(k)]),
        rim_(t.rim.data() + tile_.rim, static_cast<std::size_t>(t.rim_size(k))),
        r_(rows),
        next_(rows.start[static_cast<std::size_t>(k)]),
        first_(next_),
        place_(static_cast<std::size_t>(tile_.size())) {}

  void fill() {
    for (Index a = tile_.begin; a < tile_.end; ++a) fill_row(a);
  }

 private:
  void fill_row(Index a) {
    const auto k = static_cast<std::size_t>(a);
    const CurvatureRows::Start before = next_;
    Span& own = place_[static_cast<std::size_t>(a - tile_.begin)];
    own = {next_.neighbour, next_.neighbour};
    d_.for_each_face_neighbour(a, [&](Offset bond, Index b) {
      put_neighbour(bond, a, b);
      own.end = next_.neighbour;
    });
    for_each_other(d_, a, [&](Offset bond, Index b) {
      put_B(bond);
      r_.others[static_cast<std::size_t>(next_.other++)] = local(b);
    });
    for (const Index b : s_.far.row(a)) r_.far[static_cast<std::size_t>(next_.far++)] = local(b);
    const auto count = [](Offset from, Offset to) { return static_cast<std::uint16_t>(to - from); };
    r_.rows[k] = {count(before.neighbour, next_.neighbour),
                  count(before.other, next_.other),
                  count(before.far, next_.far),
                  count(before.mean, next_.mean),
                  count(before.face, next_.face),
                  static_cast<std::uint16_t>(s_.averaged[k])};
    r_.fit[k] = s_.fit[k];
    for (double& S : r_.fit[k].S) S *= s_.weight[k];
  }

  void put_neighbour(Offset bond, Index a, Index b) {
    const std::uint16_t cell = local(b);
    const std::uint16_t next = static_cast<std::uint16_t>(next_.face - first_.face);
    const std::uint16_t face = number_of(cell, static_cast<std::uint16_t>(a - tile_.begin), next);
    if (face == next) put_face(static_cast<std::size_t>(bond), a, b);
    put_B(bond);
    r_.neighbours[static_cast<std::size_t>(next_.neighbour++)] = {cell, face};
    if (s_.averaged[static_cast<std::size_t>(b)]) r_.means[static_cast<std::size_t>(next_.mean++)] = b;
  }

  /// Of the face that an own particle has in common with a cell; the next one if no row has named it.
  std::uint16_t number_of(std::uint16_t cell, std::uint16_t own, std::uint16_t next) const {
    if (cell >= tile_.size()) return next;
    const Span& row = place_[cell];
    for (Offset i = row.begin; i < row.end; ++i)
      if (const auto& n = r_.neighbours[static_cast<std::size_t>(i)]; n.cell == own) return n.face;
    return next;
  }

  void put_face(std::size_t bond, Index a, Index b) {
    const double sum = s_.weight[static_cast<std::size_t>(a)] + s_.weight[static_cast<std::size_t>(b)];
    const double scale = sum > 0.0 ? d_.bonds.area_over_length[bond] / sum : 0.0;
    r_.M[static_cast<std::size_t>(next_.face++)] =
        factors(scale * d_.second_order->M_of_bond(static_cast<Offset>(bond)));
  }

  void put_B(Offset bond) {
    r_.B[static_cast<std::size_t>(next_.neighbour + next_.other)] = d_.bonds.B_ab[static_cast<std::size_t>(bond)];
  }

  std::uint16_t local(Index b) const {
    if (b >= tile_.begin && b < tile_.end) return static_cast<std::uint16_t>(b - tile_.begin);
    const auto at = std::lower_bound(rim_.begin(), rim_.end(), b) - rim_.begin();
    return static_cast<std::uint16_t>(tile_.size() + at);
  }

  struct Span {
    Offset begin = 0, end = 0;
  };

  const Discretization& d_;
  const SecondDerivatives& s_;
  const Tile& tile_;
  std::span<const Index> rim_;
  CurvatureRows& r_;
  CurvatureRows::Start next_, first_;
  std::vector<Span> place_;  // rows of the own particles that have been filled, by local number
};

std::vector<double> inverse_sums(const Discretization& d) {
  const SecondDerivatives& s = d.second_order->derivatives;
  std::vector<double> inverse(d.X.size(), 0.0);
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    if (!s.resolved[a]) return;
    double sum = s.weight[a];
    if (s.averaged[a])
      d.for_each_face_neighbour(static_cast<Index>(i),
                                [&](Offset, Index b) { sum += s.weight[static_cast<std::size_t>(b)]; });
    inverse[a] = 1.0 / sum;
  });
  return inverse;
}

}  // namespace

CurvatureRows curvature_rows(const Discretization& d, const Tiles& tiles) {
  CurvatureRows rows;
  rows.start = starts(d, tiles);
  const CurvatureRows::Start& end = rows.start.back();
  rows.rows.resize(d.X.size());
  rows.neighbours.resize(static_cast<std::size_t>(end.neighbour));
  rows.M.resize(static_cast<std::size_t>(end.face));
  rows.others.resize(static_cast<std::size_t>(end.other));
  rows.far.resize(static_cast<std::size_t>(end.far));
  rows.means.resize(static_cast<std::size_t>(end.mean + CurvatureRows::padding));
  std::fill(rows.means.end() - CurvatureRows::padding, rows.means.end(), 0);
  rows.B.resize(static_cast<std::size_t>(end.neighbour + end.other));
  rows.fit.resize(d.X.size());
  rows.inverse_sum = inverse_sums(d);
  parallel::for_tasks(tiles.size(), [&](std::int64_t k) { TileRows(d, tiles, static_cast<Index>(k), rows).fill(); });
  return rows;
}

}  // namespace tessera
