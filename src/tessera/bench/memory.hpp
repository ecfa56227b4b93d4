#pragma once

#include <optional>

namespace tessera {

/// How much resident memory this process takes beyond what it has when the meter is made [bytes]. Nothing where the
/// system does not say (Linux does).
class PeakMemory {
 public:
  PeakMemory();
  /// The largest amount so far.
  std::optional<double> bytes() const;

 private:
  std::optional<double> before_;
};

}  // namespace tessera
