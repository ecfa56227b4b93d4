#pragma once

#include <array>
#include <vector>

#include "tessera/tessellation/voronoi_grid.hpp"

namespace tessera {

/// Lists the neighbours of one point after the other, nearest first, as far as they are asked for. Of equally near ones
/// the lower number comes first.
class NearestPoints {
 public:
  /// The grid must outlive the list.
  explicit NearestPoints(const PointGrid& grid) : grid_(grid) {}

  /// From now on, lists the neighbours of point `center`, which is at X [m].
  void start(Index center, const Vec3& X);

  /// The neighbour after `rank` nearer ones, or -1 when it is farther away than `reach` [m].
  Index neighbour(std::size_t rank, double reach) {
    while (listed_.size() <= rank)
      if (!list_more(reach)) return -1;
    return listed_[rank].distance2 <= reach * reach ? listed_[rank].point : -1;
  }

 private:
  struct Candidate {
    double distance2;  // [m2]
    Index point;
  };

  bool list_more(double reach);
  void sort_known(double limit2);
  void add_shell();
  void add_row(int first, int last, int j, int k);
  void update_covered();

  const PointGrid& grid_;
  Index center_ = -1;
  Vec3 X_;
  std::array<int, 3> home_{};
  int shells_ = 0;                // of blocks around home_ that were searched
  double covered_ = 0.0;          // all points nearer than this are known [m]
  double sorted2_ = 0.0;          // all points nearer than the root of this are listed [m2]
  std::vector<Candidate> known_;  // not yet listed
  std::vector<Candidate> listed_;
};

}  // namespace tessera
