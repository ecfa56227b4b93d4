#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/geometry/mesh_file.hpp"

namespace tessera {

/// Six times the signed volume [m3]: det(X1 - X0, X2 - X0, X3 - X0).
double six_volume(const Tetrahedron& t, std::span<const Vec3> points);
Vec3 centroid(const Tetrahedron& t, std::span<const Vec3> points);
Vec3 centroid(const Triangle& t, std::span<const Vec3> points);
/// Normal times area [m2], by the right-hand rule.
Vec3 area_vector(const Triangle& t, std::span<const Vec3> points);

/// The same tetrahedron with ascending vertices, but for the last two where the orientation asks for it.
Tetrahedron canonical(Tetrahedron t);
/// Makes all canonical and sorts them.
void put_in_order(std::vector<Tetrahedron>& tetrahedra);
/// The same oriented triangle with its smallest vertex first.
Triangle canonical(Triangle t);
/// The vertices in ascending order: equal for the two sides of one face.
Triangle ascending(Triangle t);

/// One of the four faces of a tetrahedron, seen from outside, smallest vertex first.
struct TetrahedronFace {
  Triangle vertices{};
  Index tetrahedron = 0;
};

/// All faces of `tetrahedra`, ordered so that the uses of one face are neighbours; within them by tetrahedron.
std::vector<TetrahedronFace> sorted_faces(std::span<const Tetrahedron> tetrahedra);

/// Calls `visit(span of the uses of one face)` for every face, in the order of `faces`.
template <class Visit>
void for_each_face(std::span<const TetrahedronFace> faces, Visit visit) {
  for (std::size_t begin = 0; begin < faces.size();) {
    const Triangle key = ascending(faces[begin].vertices);
    std::size_t end = begin + 1;
    while (end < faces.size() && ascending(faces[end].vertices) == key) ++end;
    visit(faces.subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace tessera
