#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/geometry/bounds.hpp"
#include "tessera/simulation/model.hpp"

namespace tessera {

/// Watches whether bodies come to each other, which they do not feel: a particle of one nearer to one of another than
/// half a spacing means that they touch or have gone into each other.
class Approach {
 public:
  explicit Approach(const Model& model);

  /// Looks at the present positions, boundary nodes after the particles [m]. Costs next to nothing while the bodies'
  /// boxes are apart.
  void look(const Field<Double4>& x, double time);

  /// For the user, one line for each pair of bodies, in the order of the case file.
  std::vector<std::string> warnings() const;

 private:
  struct Meeting {
    double time = 0.0;  // when it was seen first [s]
    Vec3 x;             // where [m]
  };
  struct Pair {
    std::size_t first, second;  // bodies
    std::optional<Meeting> meeting;
  };

  Bounds box_of(std::size_t body, const Field<Double4>& x) const;
  std::vector<Vec3> positions_in(const Bounds& box, std::size_t body, const Field<Double4>& x) const;

  const Model& model_;
  std::vector<std::vector<Index>> particles_;  // of each body
  std::vector<double> spacing_;                // of each body, mean [m]
  std::vector<Pair> pairs_;
};

}  // namespace tessera
