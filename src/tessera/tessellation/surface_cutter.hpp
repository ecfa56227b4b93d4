#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/symmetric.hpp"
#include "tessera/tessellation/surface_lines.hpp"

namespace tessera {

/// A flat piece of a cell's boundary, of any outline. Positions are relative to the particle.
struct FlatArea {
  Vec3 area;          // out of the cell [m2]
  Vec3 moment;        // area times centroid [m3]
  double size = 0.0;  // area along the outward normal [m2]
};

struct FlatPiece : FlatArea {
  Symmetric3 second;  // second moment about the particle [m4]

  void add(const FlatPiece& other) {
    area += other.area, moment += other.moment, size += other.size, second += other.second;
  }
};

/// What bounds a cell within the solid: a face towards a neighbour or a flat patch of the surface.
struct CutFace {
  Index neighbour = -1;  // the generator behind it, or -1
  Index patch = -1;      // of SurfacePlanes, or -1
  Index part = 0;        // of the cell
  FlatPiece piece;
  SurfaceLines::Name name{};  // the least of its points
};

/// The part of a cell in the solid. Where that falls into several parts, every closed line around a face towards a
/// neighbour has an entry of its own, so that the parts on its other side can be told apart.
struct CutCell {
  struct Part {
    double volume = 0.0;  // [m3]
    Vec3 moment;          // volume times centroid, relative to the particle [m4]
    Symmetric3 second;    // second moment about the particle [m5]
  };
  std::vector<CutFace> faces;
  std::vector<Part> parts;
  Index home = 0;  // the part around the particle
};

/// Cuts one cell after the other by a surface: areas, volumes and moments as sums over lines. Not thread-safe: one
/// cutter belongs to one thread.
class SurfaceCutter {
 public:
  /// All must outlive the cutter.
  SurfaceCutter(Generators generators, const SurfaceIndex& index, const SurfacePlanes& planes)
      : generators_(generators), planes_(planes), lines_(generators, index, planes) {}

  /// Valid until the next call. Throws GeometryError when the surface is not closed there.
  const CutCell& cut(const DualCell& cell);

  /// Lines around a flat piece of what bounds a part of the cell, counter-clockwise seen from outside; each leads from
  /// one of points() to another.
  struct Outline {
    Index part = 0;
    Vec3 normal;  // out of the part
    std::vector<std::array<Index, 2>> lines;
  };
  /// All pieces of the cell that was cut last.
  std::vector<Outline> outlines() const;
  const std::vector<SurfaceLines::Point>& points() const { return lines_.points(); }
  std::size_t parts() const { return result_.parts.size(); }

 private:
  /// A line and what it belongs to.
  struct Member {
    Index carrier, shell, from, to;
  };
  /// The part of the boundary of the cell in the solid that hangs together by lines: all of it, or the outside of a
  /// part, or the inside of a cavity or of a tunnel.
  struct Shell {
    double volume = 0.0;
    Vec3 moment;
    Symmetric3 second;
    double free_area = 0.0;  // of faces towards neighbours
    Index part = -1;
  };

  const SurfaceLines::Point& point(Index p) const { return lines_.points()[static_cast<std::size_t>(p)]; }
  Vec3 normal_of(Index carrier) const;
  Vec3 origin_of(std::span<const Member> lines) const { return point(lines.front().from).X; }
  FlatPiece measure(std::span<const Member> lines) const;
  template <class Visit>
  void for_each_piece(Visit&& visit) const;
  void find_shells();
  void measure_shells();
  void find_parts();
  double winding(Index shell, const Vec3& X) const;
  CutFace face_of(Index carrier) const;
  void add_faces();
  void add_loops(std::span<const Member> lines);
  void merge_patches();

  Generators generators_;
  const SurfacePlanes& planes_;
  SurfaceLines lines_;
  const DualCell* cell_ = nullptr;
  std::vector<Index> root_;
  std::vector<Member> members_;  // by carrier, then by shell
  std::vector<Shell> shells_;
  CutCell result_;
};

}  // namespace tessera
