#pragma once

#include <string>
#include <vector>

#include "tessera/output/quality.hpp"
#include "tessera/simulation/body_builder.hpp"

namespace tessera {

/// Gathers the quality of all bodies, one after the other.
class QualitySurvey {
 public:
  void add(const BuiltBody& body);
  /// Of all that were added.
  Quality quality() const;

 private:
  struct Body {
    std::string name;
    std::size_t first;  // particle
  };
  PlacedParticle placed(std::size_t particle) const;

  std::vector<Body> bodies_;
  std::vector<Vec3> X_;
  std::vector<Index> user_number_, faces_;
  std::vector<double> volume_, shortest_, step_;
};

}  // namespace tessera
