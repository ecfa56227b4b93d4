#include "tessera/mechanics/curvature_rows.hpp"

#include <algorithm>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

constexpr Index quad = 4;

CurvatureRows::FaceFactors factors(const Symmetric3& m) {
  return {m.xx, 2.0 * m.xy, 2.0 * m.xz, m.yy, 2.0 * m.yz, m.zz};
}

/// Calls body(bond, b) for the bonds of a that have a face.
template <class Body>
void for_each_face(const Discretization& d, Index a, Body&& body) {
  for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
    if (const auto bond = static_cast<std::size_t>(i); d.bonds.area_over_length[bond] > 0.0)
      body(bond, d.bonds.neighbour[bond]);
}

/// How many entries a tile's rows have, and how many faces they name.
CurvatureRows::Start sizes(const Discretization& d, const Tile& tile) {
  CurvatureRows::Start count;
  for (Index a = tile.begin; a < tile.end; ++a)
    for_each_face(d, a, [&](std::size_t, Index b) {
      ++count.neighbour;
      if (b < tile.begin || b >= tile.end || a < b) ++count.face;
    });
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
    start[k].face += start[k - 1].face;
  }
  return start;
}

/// Fills the arrays of one tile.
class TileRows {
 public:
  TileRows(const Discretization& d, const Tiles& t, Index k, CurvatureRows& rows)
      : d_(d),
        s_(*d.second_order),
        t_(t),
        tile_(t.tiles[static_cast<std::size_t>(k)]),
        nodes_(static_cast<std::size_t>(t.end_of(k).node - tile_.node)),
        r_(rows),
        start_(rows.start[static_cast<std::size_t>(k)]),
        place_(static_cast<std::size_t>(tile_.size())) {}

  void fill() {
    const std::vector<Offset> slot = first_slots();
    for (Index row = 0; row < tile_.size(); ++row) fill_row(tile_.begin + row, slot[static_cast<std::size_t>(row)]);
    fill_senders();
  }

 private:
  /// Of the first bonds of the own particles, by local number.
  std::vector<Offset> first_slots() const {
    const std::uint16_t* order = t_.order.data() + quad * tile_.quad;
    const std::uint16_t* length = t_.length.data() + tile_.quad;
    std::vector<Offset> slots(place_.size());
    Offset slot = tile_.slot;
    for (Index row = 0; row < tile_.size(); ++row) {
      slots[order[row]] = slot + row % quad;
      if (row % quad == quad - 1) slot += quad * length[row / quad];
    }
    return slots;
  }

  /// `slot`: of the first bond.
  void fill_row(Index a, Offset slot) {
    const auto k = static_cast<std::size_t>(a);
    place_[static_cast<std::size_t>(a - tile_.begin)] = {next_, next_};
    Vec3 offset;
    Index named = 0;
    for_each_face(d_, a, [&](std::size_t bond, Index b) {
      const Offset i = static_cast<Offset>(bond) - d_.bonds.begin(a);
      const std::uint16_t cell = t_.neighbour[static_cast<std::size_t>(slot + quad * i)];
      std::uint16_t face = number_of(cell, static_cast<std::uint16_t>(a - tile_.begin));
      if (face == faces_) {
        put_face(bond, a, b);
        ++named;
      }
      neighbour(next_++) = {cell, face};
      place_[static_cast<std::size_t>(a - tile_.begin)].end = next_;
      offset += d_.measure->centroid[static_cast<std::size_t>(b)] - d_.measure->centroid[static_cast<std::size_t>(a)];
    });
    const Span& own = place_[static_cast<std::size_t>(a - tile_.begin)];
    r_.rows[k] = {static_cast<std::uint16_t>(own.end - own.begin), static_cast<std::uint16_t>(named)};
    r_.offset[k] = offset;
    const double weight = s_.derivatives.weight[static_cast<std::size_t>(a)];
    for (std::size_t m = 0; m < r_.map[k].size(); ++m)
      r_.map[k][m] = weight * s_.derivatives.map[static_cast<std::size_t>(a)][m];
  }

  /// Of the face that an own particle has in common with a cell; the next one if no row has named it.
  std::uint16_t number_of(std::uint16_t cell, std::uint16_t own) {
    if (cell >= tile_.size()) return faces_;
    const Span& row = place_[cell];
    for (Offset i = row.begin; i < row.end; ++i)
      if (neighbour(i).cell == own) return neighbour(i).face;
    return faces_;
  }

  void put_face(std::size_t bond, Index a, Index b) {
    const double sum =
        s_.derivatives.weight[static_cast<std::size_t>(a)] + s_.derivatives.weight[static_cast<std::size_t>(b)];
    const double scale = sum > 0.0 ? d_.bonds.area_over_length[bond] / sum : 0.0;
    r_.M[static_cast<std::size_t>(start_.face + faces_++)] = factors(scale * s_.M[bond]);
  }

  void fill_senders() {
    std::uint16_t* count = r_.sender_count.data() + tile_.node;
    std::vector<Offset> next(nodes_ + 1, 0);
    for (Offset i = 0; i < next_; ++i) ++next[neighbour(i).cell + std::size_t{1}];
    for (std::size_t b = 0; b < nodes_; ++b) {
      count[b] = static_cast<std::uint16_t>(next[b + 1]);
      next[b + 1] += next[b];
    }
    std::uint16_t* senders = r_.senders.data() + start_.neighbour;
    for (Index a = 0; a < tile_.size(); ++a) {
      const Span& row = place_[static_cast<std::size_t>(a)];
      for (Offset i = row.begin; i < row.end; ++i) senders[next[neighbour(i).cell]++] = static_cast<std::uint16_t>(a);
    }
  }

  CurvatureRows::Neighbour& neighbour(Offset i) {
    return r_.neighbours[static_cast<std::size_t>(start_.neighbour + i)];
  }

  struct Span {
    Offset begin = 0, end = 0;
  };

  const Discretization& d_;
  const SecondOrder& s_;
  const Tiles& t_;
  const Tile& tile_;
  std::size_t nodes_;
  CurvatureRows& r_;
  const CurvatureRows::Start& start_;
  std::vector<Span> place_;  // rows of the own particles that have been filled, by local number
  Offset next_ = 0;
  std::uint16_t faces_ = 0;
};

std::vector<double> inverse_sums(const Discretization& d) {
  const std::vector<double>& weight = d.second_order->derivatives.weight;
  std::vector<double> inverse(d.X.size(), 0.0);
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    if (weight[a] == 0.0) return;
    double sum = weight[a];
    for_each_face(d, static_cast<Index>(i), [&](std::size_t, Index b) { sum += weight[static_cast<std::size_t>(b)]; });
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
  rows.map.resize(d.X.size());
  rows.offset.resize(d.X.size());
  rows.sender_count.resize(static_cast<std::size_t>(tiles.tiles.back().node));
  rows.senders.resize(static_cast<std::size_t>(end.neighbour));
  rows.inverse_sum = inverse_sums(d);
  parallel::for_tasks(tiles.size(), [&](std::int64_t k) { TileRows(d, tiles, static_cast<Index>(k), rows).fill(); });
  return rows;
}

}  // namespace tessera
