#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// A convex cell in which exactly three faces meet in every vertex, and whose cuts leave no doubt on which side of the
/// plane any vertex lies. Then the cell is its list of vertices as triples of faces: a cut drops some and adds one for
/// each edge that it crosses. Positions are relative to the particle [m].
///
///          j \   / i          vertex (i, j, k): its faces counter-clockwise, seen from outside;
///             \ /             along its edge between i and j lies the vertex that has (j, i)
///              |
///            k | (face k below)
class SimpleCell {
 public:
  /// Vertices and planes that one cell may take; cells with more are for another method.
  static constexpr int kMostVertices = 192;
  static constexpr int kMostFaces = 96;
  /// Tag of the faces of the box that the cell starts from.
  static constexpr Index kBox = -1;

  enum class Outcome { untouched, cut, in_doubt };

  /// The cube of this half width [m] around the particle.
  void start(double half_width);

  /// Keeps what is below the plane normal . X = offset (`normal` of any length). In doubt, and to be thrown away, when
  /// a vertex is closer than `margin` [m] to the plane, when an edge is nearly parallel to it, when nothing would be
  /// left or the cell is full.
  Outcome clip(const Vec3& normal, double offset, double margin, Index tag);

  /// Distance of the farthest vertex, squared [m2].
  double radius2() const { return radius2_; }

  int vertices() const { return vertices_; }
  Vec3 position(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {x_[v], y_[v], z_[v]};
  }
  /// Tags of the three faces that meet in a vertex.
  std::array<Index, 3> tags(int vertex) const;

  /// Calls take(tag, vertices) for every face, its vertices counter-clockwise seen from outside.
  template <class Take>
  void for_faces(Take&& take) const;

 private:
  using Triple = std::array<std::uint8_t, 3>;
  struct NewVertex {
    Vec3 X;
    Triple faces;
  };

  static std::size_t edge(std::uint8_t i, std::uint8_t j) { return std::size_t{i} * kMostFaces + j; }
  void put(int vertex, const Vec3& X, const Triple& faces);
  void move(int from, int to);
  bool measure_heights(const Vec3& normal, double offset, double margin);
  bool cross_edges(double normal2, std::uint8_t face);
  void replace_dropped();
  void update_radius();

  int vertices_ = 0;
  int faces_ = 0;  // planes so far, also those that later cuts have taken all vertices from
  double radius2_ = 0.0;
  std::array<double, kMostVertices> x_, y_, z_, height_;
  std::array<Triple, kMostVertices> triple_;
  std::array<Index, kMostFaces> tag_;
  std::array<std::uint8_t, kMostFaces * kMostFaces> vertex_at_;  // edge (i, j): the vertex that has it
  int dropped_count_ = 0, added_count_ = 0;
  std::array<std::uint8_t, kMostVertices> dropped_;
  std::array<NewVertex, kMostVertices> added_;
};

template <class Take>
void SimpleCell::for_faces(Take&& take) const {
  std::array<std::int16_t, kMostFaces> start;
  std::array<Index, kMostVertices> loop;
  start.fill(-1);
  for (int v = 0; v < vertices_; ++v)
    for (const std::uint8_t face : triple_[static_cast<std::size_t>(v)]) start[face] = static_cast<std::int16_t>(v);
  for (std::uint8_t face = 0; face < faces_; ++face) {
    if (start[face] < 0) continue;
    std::size_t n = 0;
    int v = start[face];
    do {
      loop[n++] = v;
      const Triple& t = triple_[static_cast<std::size_t>(v)];
      const std::uint8_t before = t[0] == face ? t[2] : (t[1] == face ? t[0] : t[1]);
      v = vertex_at_[edge(face, before)];
    } while (v != start[face] && n < loop.size());
    take(tag_[face], std::span<const Index>(loop.data(), n));
  }
}

}  // namespace tessera
