#include "tessera/output/displacement_error.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {

DisplacementError displacement_error(const Snapshot& snapshot, const std::function<Vec3(const Vec3&)>& reference) {
  double difference = 0.0, size = 0.0, volume = 0.0, largest = 0.0;
  for (std::size_t a = 0; a < snapshot.position.size(); ++a) {
    const Vec3 expected = reference(snapshot.reference_position[a]);
    const double distance2 = norm2(snapshot.position[a] - snapshot.reference_position[a] - expected);
    difference += snapshot.volume[a] * distance2;
    size += snapshot.volume[a] * norm2(expected);
    volume += snapshot.volume[a];
    // A distance that is not a number must not hide behind finite ones.
    if (!(distance2 <= largest)) largest = distance2;
    if (std::isnan(distance2)) break;
  }
  const ErrorMeasure measure = size > 0.0 ? ErrorMeasure::relative : ErrorMeasure::absolute;
  const double scale = measure == ErrorMeasure::relative ? size : volume;
  return {std::sqrt(difference / scale), std::sqrt(largest), measure};
}

DisplacementError displacement_error(const Snapshot& snapshot, const ReferenceSpec& reference) {
  return displacement_error(snapshot,
                            [&](const Vec3& X) { return evaluate(reference.displacement, snapshot.time, X); });
}

}  // namespace tessera
