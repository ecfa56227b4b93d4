#include "tessera/geometry/triangle_meeting.hpp"

#include <array>

#include "tessera/geometry/predicates.hpp"
#include "tessera/geometry/surface_index.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

/// Do two segments in one plane meet? `axis` is one that is not in the plane.
bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, int axis) {
  const int pq_a = orient2d(p, q, a, axis), pq_b = orient2d(p, q, b, axis);
  const int ab_p = orient2d(a, b, p, axis), ab_q = orient2d(a, b, q, axis);
  if (pq_a * pq_b > 0 || ab_p * ab_q > 0) return false;
  if (pq_a != 0 || pq_b != 0 || ab_p != 0 || ab_q != 0) return true;
  Bounds one, other;  // all four on one line
  one.include(p), one.include(q), other.include(a), other.include(b);
  return one.meets(other);
}

bool flat_segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  int axis = 0;
  while (axis < 2 && orient2d(a, b, c, axis) == 0) ++axis;
  return in_triangle(p, a, b, c) || segments_meet(p, q, a, b, axis) || segments_meet(p, q, b, c, axis) ||
         segments_meet(p, q, c, a, axis);
}

/// Seen along an axis, does the line of one of s's edges part s from t?
bool is_parted_by_edge(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t, int axis) {
  const int turn = orient2d(s[0], s[1], s[2], axis);
  if (turn == 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = s[i], &b = s[(i + 1) % 3];
    if (orient2d(a, b, t[0], axis) == -turn && orient2d(a, b, t[1], axis) == -turn &&
        orient2d(a, b, t[2], axis) == -turn)
      return true;
  }
  return false;
}

/// Two triangles with no vertex in common.
bool strangers_meet(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
  for (int axis = 0; axis < 3; ++axis)  // decides most pairs, and all that lie apart in one plane, at little cost
    if (is_parted_by_edge(s, t, axis) || is_parted_by_edge(t, s, axis)) return false;
  std::array<int, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = orient3d(t[0], t[1], t[2], s[i]);
  if (side[0] == side[1] && side[1] == side[2] && side[0] != 0) return false;
  for (std::size_t i = 0; i < 3; ++i) side[i] = orient3d(s[0], s[1], s[2], t[i]);
  if (side[0] == side[1] && side[1] == side[2] && side[0] != 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (segment_meets_triangle(s[i], s[(i + 1) % 3], t[0], t[1], t[2])) return true;
    if (segment_meets_triangle(t[i], t[(i + 1) % 3], s[0], s[1], s[2])) return true;
  }
  return false;
}

/// Seen along an axis, does a line through p and one of its triangle's other corners part the triangles p a b and
/// p c d? Then they meet in p only.
bool are_parted(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int axis) {
  const int turn = orient2d(p, a, b, axis);
  if (turn == 0) return false;
  return (orient2d(p, a, c, axis) == -turn && orient2d(p, a, d, axis) == -turn) ||
         (orient2d(p, b, c, axis) == turn && orient2d(p, b, d, axis) == turn);
}

/// The triangles p a b and p c d. What they share beyond p reaches the edge opposite to p of one of them.
bool meet_beyond_vertex(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  for (int axis = 0; axis < 3; ++axis)
    if (are_parted(p, a, b, c, d, axis) || are_parted(p, c, d, a, b, axis)) return false;
  return segment_meets_triangle(a, b, p, c, d) || segment_meets_triangle(c, d, p, a, b);
}

/// The triangles p q a and p q b: they overlap when they are folded onto each other.
bool meet_beyond_edge(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (orient2d(p, q, a, axis) * orient2d(p, q, b, axis) < 0) return false;
  if (orient3d(p, q, a, b) != 0) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (const int turn = orient2d(p, q, a, axis); turn != 0) return orient2d(p, q, b, axis) == turn;
  return true;
}

}  // namespace

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int side_p = orient3d(a, b, c, p), side_q = orient3d(a, b, c, q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return flat_segment_meets_triangle(p, q, a, b, c);
  const int ab = orient3d(p, q, a, b), bc = orient3d(p, q, b, c);
  if (ab * bc < 0) return false;
  const int ca = orient3d(p, q, c, a);
  return ab * ca >= 0 && bc * ca >= 0;
}

bool meet_wrongly(const TriangleSurface& surface, Index s, Index t) {
  // Corners of s and t, those that they share first and in the same order.
  std::array<Vec3, 3> of_s = surface.corners(s), of_t = surface.corners(t);
  Triangle v = surface.triangle(s), w = surface.triangle(t);
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j)
      if (v[i] == w[j]) {
        std::swap(w[j], w[shared]), std::swap(of_t[j], of_t[shared]);
        std::swap(v[i], v[shared]), std::swap(of_s[i], of_s[shared]);
        ++shared;
        break;
      }
  if (shared == 0) return strangers_meet(of_s, of_t);
  if (shared == 1) return meet_beyond_vertex(of_s[0], of_s[1], of_s[2], of_t[1], of_t[2]);
  if (shared == 2) return meet_beyond_edge(of_s[0], of_s[1], of_s[2], of_t[2]);
  return true;
}

std::optional<WrongMeeting> find_wrong_meeting(const TriangleSurface& surface) {
  const SurfaceIndex index(surface);
  std::vector<WrongMeeting> of(surface.triangles.size());
  parallel::for_each(surface.size(), [&](std::int64_t i) {
    WrongMeeting& first = of[static_cast<std::size_t>(i)];
    const auto s = static_cast<Index>(i);
    index.for_each_near(bounds(surface, s), [&](Index t) {
      if (t <= s || !meet_wrongly(surface, s, t)) return;
      if (first.pairs++ == 0 || t < first.t) first.s = s, first.t = t;
    });
  });
  std::optional<WrongMeeting> result;
  for (const WrongMeeting& meeting : of) {
    if (meeting.pairs == 0) continue;
    if (result)
      result->pairs += meeting.pairs;
    else
      result = meeting;
  }
  return result;
}

}  // namespace tessera
