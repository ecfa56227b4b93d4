#include "tessera/tessellation/mesh_faces.hpp"

#include <algorithm>
#include <functional>

#include "tessera/base/csr.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

const Vec3& at(std::span<const Vec3> points, Index i) { return points[static_cast<std::size_t>(i)]; }

Index largest_vertex(std::span<const Tetrahedron> tetrahedra) {
  Index largest = -1;
  for (const Tetrahedron& t : tetrahedra) largest = std::max(largest, *std::max_element(t.begin(), t.end()));
  return largest;
}

std::vector<TetrahedronFace> outward_faces(std::span<const Tetrahedron> tetrahedra) {
  std::vector<TetrahedronFace> faces;
  faces.reserve(4 * tetrahedra.size());
  Index i = 0;
  for (const auto& [a, b, c, d] : tetrahedra) {
    for (const Triangle& f : {Triangle{a, c, b}, Triangle{a, b, d}, Triangle{a, d, c}, Triangle{b, c, d}})
      faces.push_back({canonical(f), i});
    ++i;
  }
  return faces;
}

template <class T, class Before>
void sort_rows(Csr<T>& rows, Before before) {
  parallel::for_each(rows.rows(), [&](std::int64_t r) {
    const std::span<T> row = rows.row(static_cast<Index>(r));
    std::sort(row.begin(), row.end(), before);
  });
}

bool comes_before(const TetrahedronFace& a, const TetrahedronFace& b) {
  const Triangle key_a = ascending(a.vertices), key_b = ascending(b.vertices);
  return key_a != key_b ? key_a < key_b : a.tetrahedron < b.tetrahedron;
}

}  // namespace

double six_volume(const Tetrahedron& t, std::span<const Vec3> points) {
  const Vec3& X0 = at(points, t[0]);
  return dot(at(points, t[1]) - X0, cross(at(points, t[2]) - X0, at(points, t[3]) - X0));
}

Vec3 centroid(const Tetrahedron& t, std::span<const Vec3> points) {
  return 0.25 * (at(points, t[0]) + at(points, t[1]) + at(points, t[2]) + at(points, t[3]));
}

Vec3 centroid(const Triangle& t, std::span<const Vec3> points) {
  return (at(points, t[0]) + at(points, t[1]) + at(points, t[2])) / 3.0;
}

Vec3 area_vector(const Triangle& t, std::span<const Vec3> points) {
  const Vec3& X0 = at(points, t[0]);
  return 0.5 * cross(at(points, t[1]) - X0, at(points, t[2]) - X0);
}

Tetrahedron canonical(Tetrahedron t) {
  int swaps = 0;
  for (std::size_t end = t.size(); end > 1; --end)
    for (std::size_t i = 0; i + 1 < end; ++i)
      if (t[i] > t[i + 1]) std::swap(t[i], t[i + 1]), ++swaps;
  if (swaps % 2 == 1) std::swap(t[2], t[3]);
  return t;
}

void put_in_order(std::vector<Tetrahedron>& tetrahedra) {
  parallel::for_each(static_cast<std::int64_t>(tetrahedra.size()), [&](std::int64_t i) {
    Tetrahedron& t = tetrahedra[static_cast<std::size_t>(i)];
    t = canonical(t);
  });
  // Buckets by smallest vertex first: a sort of a few items at a time is several times faster than one of all.
  Csr<Tetrahedron> buckets = group_by_row(largest_vertex(tetrahedra) + 1, std::span<const Tetrahedron>(tetrahedra),
                                          [](const Tetrahedron& t) { return t[0]; });
  sort_rows(buckets, std::less<>());
  tetrahedra = std::move(buckets.value);
}

Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Triangle ascending(Triangle t) {
  if (t[0] > t[1]) std::swap(t[0], t[1]);
  if (t[1] > t[2]) std::swap(t[1], t[2]);
  if (t[0] > t[1]) std::swap(t[0], t[1]);
  return t;
}

std::vector<TetrahedronFace> sorted_faces(std::span<const Tetrahedron> tetrahedra) {
  const std::vector<TetrahedronFace> faces = outward_faces(tetrahedra);
  Csr<TetrahedronFace> buckets = group_by_row(largest_vertex(tetrahedra) + 1, std::span<const TetrahedronFace>(faces),
                                              [](const TetrahedronFace& face) { return face.vertices[0]; });
  sort_rows(buckets, comes_before);
  return std::move(buckets.value);
}

}  // namespace tessera
