#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// What a user wrote after `where`: side or surface names, or one formula.
struct SelectionSpec {
  std::vector<std::string> items;
  Origin origin;
};

/// A place that a selection may take: the centroid of a boundary face, or a particle.
struct Site {
  Vec3 X;                              // material position [m]
  std::span<const std::string> names;  // of the sides or surfaces that it belongs to
};

/// A selection compiled for one body. An item that equals one of `known_names` is a name; anything else is a formula
/// in X, Y, Z (and x, y, z == min|max of the body's bounding box, to within 1e-9 of its size).
class Selection {
 public:
  /// Throws InputError at the spec's origin for unknown names (lists the known ones) and bad formulas.
  Selection(const SelectionSpec& spec, std::span<const std::string> known_names, const Vec3& lower, const Vec3& upper);
  Selection(Selection&&) noexcept;
  Selection& operator=(Selection&&) noexcept;
  ~Selection();

  bool takes(const Site& site) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tessera
