#include "tessera/geometry/box_solid.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "tessera/geometry/box_grid.hpp"

namespace tessera {
namespace {

using Cell = std::array<int, 3>;

/// The face of a grid cell seen along +axis (sign 1) or -axis (sign -1).
struct Direction {
  int axis;
  int sign;
};
constexpr std::array<Direction, 6> kDirections{{{0, -1}, {0, 1}, {1, -1}, {1, 1}, {2, -1}, {2, 1}}};

std::string side_label(Direction d) { return {d.sign > 0 ? '+' : '-', "xyz"[d.axis]}; }

/// One side: all walls in one plane that bear the same names.
struct SideKey {
  int axis, sign, plane;
  std::vector<std::string> names;
  auto tie() const { return std::tie(axis, sign, plane, names); }
  bool operator<(const SideKey& other) const { return tie() < other.tie(); }
};

class Builder {
 public:
  explicit Builder(const Shape& shape) : shape_(grid_shape(shape)) {}

  Solid build() {
    find_sides();
    drop_needless_planes();
    Solid solid;
    add_sides(solid);
    add_pieces(solid);
    return solid;
  }

 private:
  const BoxGrid& grid() const { return shape_.grid; }

  bool inside(const GridPart& part, const Cell& c) const {
    for (int d = 0; d < 3; ++d)
      if (c[static_cast<std::size_t>(d)] < 0 || c[static_cast<std::size_t>(d)] >= grid().cells(d)) return false;
    return part.inside[grid().cell(c)];
  }

  static Cell neighbour(Cell c, Direction d) {
    c[static_cast<std::size_t>(d.axis)] += d.sign;
    return c;
  }

  static int plane_of(const Cell& c, Direction d) { return c[static_cast<std::size_t>(d.axis)] + (d.sign > 0 ? 1 : 0); }

  template <class Visit>
  void for_each_inner_cell(Visit visit) const {
    for (int k = 0; k < grid().cells(2); ++k)
      for (int j = 0; j < grid().cells(1); ++j)
        for (int i = 0; i < grid().cells(0); ++i)
          if (inside(shape_.parts[0], {i, j, k})) visit(Cell{i, j, k});
  }

  /// The side of `part` that the wall of cell c in direction d belongs to, as the part's own outermost face; empty if
  /// none.
  std::string label_on(const GridPart& part, const Cell& c, Direction d) const {
    const bool here = inside(part, c);
    if (here == inside(part, neighbour(c, d))) return {};
    const Direction own{d.axis, here ? d.sign : -d.sign};
    const std::size_t axis = static_cast<std::size_t>(d.axis);
    const int outermost = own.sign > 0 ? part.upper[axis] : part.lower[axis];
    return plane_of(c, d) == outermost ? side_label(own) : std::string();
  }

  std::vector<std::string> names_of(const Cell& c, Direction d) const {
    std::vector<std::string> names;
    std::string by_place;
    for (const GridPart& part : shape_.parts) {
      const std::string label = label_on(part, c, d);
      if (label.empty()) continue;
      if (&part == &shape_.parts[0]) names.push_back(label);
      if (part.is_named) names.push_back(part.path + "." + label);
      if (by_place.empty()) by_place = part.path + "." + label;
    }
    if (names.empty()) names.push_back(by_place);
    return names;
  }

  void find_sides() {
    std::vector<std::pair<std::size_t, SideKey>> walls;
    for_each_inner_cell([&](const Cell& c) {
      for (std::size_t f = 0; f < 6; ++f) {
        const Direction d = kDirections[f];
        if (inside(shape_.parts[0], neighbour(c, d))) continue;
        walls.push_back({6 * grid().cell(c) + f, {d.axis, d.sign, plane_of(c, d), names_of(c, d)}});
      }
    });
    for (const auto& [wall, key] : walls) sides_.emplace(key, 0);
    Index number = 0;
    for (auto& [key, side] : sides_) side = number++;
    side_of_wall_.assign(6 * grid().size(), -1);
    for (const auto& [wall, key] : walls) side_of_wall_[wall] = sides_.at(key);
  }

  Index side_of(const Cell& c, std::size_t f) const { return side_of_wall_[6 * grid().cell(c) + f]; }

  /// Are the slabs of cells before and behind plane p alike, so that one cell can take the place of two?
  bool is_needless(int axis, int p) const {
    const std::size_t u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
    Cell before{}, behind{};
    before[static_cast<std::size_t>(axis)] = p - 1;
    behind[static_cast<std::size_t>(axis)] = p;
    for (int i = 0; i < grid().cells(static_cast<int>(u)); ++i)
      for (int j = 0; j < grid().cells(static_cast<int>(v)); ++j) {
        before[u] = behind[u] = i;
        before[v] = behind[v] = j;
        if (inside(shape_.parts[0], before) != inside(shape_.parts[0], behind)) return false;
        for (std::size_t f = 0; f < 6; ++f)
          if (kDirections[f].axis != axis && side_of(before, f) != side_of(behind, f)) return false;
      }
    return true;
  }

  void drop_needless_planes() {
    for (int axis = 0; axis < 3; ++axis)
      for (int p = 0; p <= grid().cells(axis); ++p)
        if (p == 0 || p == grid().cells(axis) || !is_needless(axis, p))
          kept_[static_cast<std::size_t>(axis)].push_back(p);
  }

  double coordinate(int axis, int plane) const {
    return grid().planes[static_cast<std::size_t>(axis)][static_cast<std::size_t>(plane)];
  }

  Plane plane(int axis, int sign, int number) const {
    Plane plane;
    plane.normal[axis] = sign;
    plane.offset = sign * coordinate(axis, number);
    return plane;
  }

  void add_sides(Solid& solid) const {
    for (const auto& [key, number] : sides_) solid.sides.push_back({key.names, plane(key.axis, key.sign, key.plane)});
    const GridPart& whole = shape_.parts[0];
    for (int d = 0; d < 3; ++d) {
      solid.lower[d] = coordinate(d, whole.lower[static_cast<std::size_t>(d)]);
      solid.upper[d] = coordinate(d, whole.upper[static_cast<std::size_t>(d)]);
    }
  }

  void add_pieces(Solid& solid) const {
    for (std::size_t k = 0; k + 1 < kept_[2].size(); ++k)
      for (std::size_t j = 0; j + 1 < kept_[1].size(); ++j)
        for (std::size_t i = 0; i + 1 < kept_[0].size(); ++i) {
          const Cell first{kept_[0][i], kept_[1][j], kept_[2][k]};
          const Cell last{kept_[0][i + 1] - 1, kept_[1][j + 1] - 1, kept_[2][k + 1] - 1};
          if (inside(shape_.parts[0], first)) add_piece(first, last, solid);
        }
  }

  /// The box of the grid cells first .. last. Where it has a wall, all its grid cells on that wall have the same side.
  void add_piece(const Cell& first, const Cell& last, Solid& solid) const {
    ConvexPiece piece;
    for (std::size_t f = 0; f < 6; ++f) {
      const Direction d = kDirections[f];
      const Cell& corner = d.sign > 0 ? last : first;
      piece.walls.push_back({plane(d.axis, d.sign, plane_of(corner, d)), side_of(corner, f)});
      (d.sign > 0 ? piece.upper : piece.lower)[d.axis] = coordinate(d.axis, plane_of(corner, d));
    }
    const Vec3 size = piece.upper - piece.lower;
    solid.volume += size.x * size.y * size.z;
    solid.pieces.push_back(std::move(piece));
  }

  GriddedShape shape_;
  std::map<SideKey, Index> sides_;
  std::vector<Index> side_of_wall_;       // 6 per grid cell, in the order of kDirections; -1 is no boundary
  std::array<std::vector<int>, 3> kept_;  // grid planes that pieces end at
};

}  // namespace

Solid build_box_solid(const Shape& shape) { return Builder(shape).build(); }

}  // namespace tessera
