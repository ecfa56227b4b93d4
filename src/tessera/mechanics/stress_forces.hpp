#pragma once

#include <span>

#include "tessera/mechanics/stress_integration.hpp"

namespace tessera {

/// Boundary nodes or rows treat the elastic stress and the contact stress differently ([V 42, 43]): scratches need room
/// for P.
bool treats_stresses_apart(const System& s);

/// What stresses do: forces on particles, [D 45], [V 41], and on boundary nodes, from which they are drained. Tile by
/// tile on a tile's own particles, its nodes and its rim; rims are collected last.
class StressForces {
 public:
  explicit StressForces(const System& s);

  Field<Double4>& f() { return f_; }  // [N]; what bonds have put there stays
  const Field<Double4>& f() const { return f_; }
  /// Takes forces away, where no bonds put theirs.
  void clear();
  BondTarget bonds() { return {f_.data(), R_.data()}; }

  /// Everything that the integration makes of the task, but for rims: bonds, stresses and their forces, which are
  /// drained from boundary nodes. Sets `reactions`, the force on what prescribes each node [N].
  StressSums find(StressIntegration& integration, const StressTask& task, StressIntegration::Scratches& scratches,
                  std::span<Vec3> reactions);
  /// The forces on the particles in [first, last) with what tiles have done to their rims; `total` begins with `first`.
  void collect(Index first, Index last, Double4* total) const;

 private:
  void act_on_nodes(Index tile, const TileScratch& scratch);
  void act_on_particles(const StressIntegration& integration, Index tile, TileScratch& scratch);
  void drain(std::span<Vec3> reactions);

  const System& s_;
  bool split_;
  Field<Double4> f_, R_;
  Field<Double4> rim_f_, rim_f_direct_;  // what tiles do to their rims; the second for the rows of [V 42]
  Field<Columns> owners_P_;              // P of each owner of boundary nodes, where stresses are treated apart
};

}  // namespace tessera
