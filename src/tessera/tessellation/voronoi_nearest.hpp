#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// Lists the neighbours of one point after the other, nearest first, as far as they are asked for. Of equally near ones
/// the lower number comes first.
class NearestPoints {
 public:
  /// Points in the box lower .. upper, about `spacing` apart [m]. The points must outlive the list.
  NearestPoints(std::span<const Vec3> points, const Vec3& lower, const Vec3& upper, double spacing);

  /// From now on, lists the neighbours of point `center`.
  void start(Index center);

  /// The neighbour after `rank` nearer ones, or -1 when it is farther away than `reach` [m].
  Index neighbour(std::size_t rank, double reach);

 private:
  struct Candidate {
    double distance;
    Index point;
  };

  std::array<int, 3> block_of(const Vec3& X) const;
  void add_shell();
  void add_block(int i, int j, int k);
  void update_covered();
  static bool is_farther(const Candidate& a, const Candidate& b);

  std::span<const Vec3> points_;
  Vec3 lower_;
  double size_;                  // of a block [m]
  std::array<int, 3> blocks_{};  // per direction
  Csr<Index> members_;           // points of every block

  Index center_ = -1;
  std::array<int, 3> home_{};
  int shells_ = 0;               // of blocks around home_ that were searched
  double covered_ = 0.0;         // all points nearer than this are known [m]
  std::vector<Candidate> heap_;  // known, not yet listed
  std::vector<Candidate> listed_;
};

}  // namespace tessera
