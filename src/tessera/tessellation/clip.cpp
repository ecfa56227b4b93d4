#include "tessera/tessellation/clip.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/tessellation/plane_order.hpp"

namespace tessera {

void ConvexPolyhedron::clear() {
  vertices.clear();
  tags.clear();
  begin.assign(1, 0);
  corners.clear();
}

void ConvexPolyhedron::close_face(Index tag) {
  tags.push_back(tag);
  begin.push_back(static_cast<Index>(corners.size()));
}

Clipper::Outcome Clipper::clip(ConvexPolyhedron& polyhedron, const Plane& plane, Index tag) {
  remains_ = Remains::joined;
  heights_.clear();
  places_.clear();
  for (const Vec3& X : polyhedron.vertices) {
    const double height = plane.height(X);
    heights_.push_back(height);
    places_.push_back(height > tolerance_ ? Place::above : (height < -tolerance_ ? Place::below : Place::on));
  }
  return cut(polyhedron, tag);
}

Clipper::Outcome Clipper::split(ConvexPolyhedron& polyhedron, const Plane& plane, Index tag) {
  heights_.clear();
  places_.clear();
  const bool is_forward = faces_forward(plane);
  remains_ = is_forward ? Remains::joined : Remains::apart;
  for (const Vec3& X : polyhedron.vertices) {
    const double height = plane.height(X);
    heights_.push_back(height);
    places_.push_back(height < 0.0 || (height == 0.0 && is_forward) ? Place::below : Place::above);
  }
  return cut(polyhedron, tag);
}

Clipper::Outcome Clipper::cut(ConvexPolyhedron& polyhedron, Index tag) {
  const auto has = [&](Place place) { return std::find(places_.begin(), places_.end(), place) != places_.end(); };
  if (!has(Place::below)) {
    polyhedron.clear();
    return Outcome::emptied;
  }
  if (!has(Place::above)) return Outcome::untouched;
  result_.clear();
  result_.vertices = polyhedron.vertices;
  cut_edges_.clear();
  rim_.clear();
  for (Index f = 0; f < polyhedron.faces(); ++f) {
    if (remains_ == Remains::joined)
      cut_face(polyhedron, f);
    else
      cut_face_apart(polyhedron, f);
  }
  add_cap(tag);
  keep_used_vertices();
  std::swap(polyhedron, result_);
  return Outcome::cut;
}

bool Clipper::lies_in(const ConvexPolyhedron& polyhedron, Index f, const Plane& plane) const {
  const std::span<const Index> face = polyhedron.face(f);
  return std::all_of(face.begin(), face.end(), [&](Index v) {
    return std::abs(plane.height(polyhedron.vertices[static_cast<std::size_t>(v)])) <= tolerance_;
  });
}

Index Clipper::vertex_on_edge(const ConvexPolyhedron& polyhedron, Index u, Index v) {
  if (u > v) std::swap(u, v);  // both faces at the edge must find the same vertex
  for (const CutEdge& edge : cut_edges_)
    if (edge.u == u && edge.v == v) return edge.vertex;
  const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
  const double s = heights_[i] / (heights_[i] - heights_[j]);
  const Index vertex = static_cast<Index>(result_.vertices.size());
  result_.vertices.push_back((1.0 - s) * polyhedron.vertices[i] + s * polyhedron.vertices[j]);
  places_.push_back(Place::on);
  cut_edges_.push_back({u, v, vertex});
  return vertex;
}

/// Appends what remains of face f, and to the rim its edges in the cutting plane, reversed. A face that has nothing
/// below the plane goes.
void Clipper::cut_face(const ConvexPolyhedron& polyhedron, Index f) {
  const std::span<const Index> face = polyhedron.face(f);
  if (std::none_of(face.begin(), face.end(), [&](Index v) { return place(v) == Place::below; })) return;
  const std::size_t first = result_.corners.size();
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Index u = face[i], v = face[i + 1 == face.size() ? 0 : i + 1];
    const Place at_u = place(u), at_v = place(v);
    if (at_u != Place::above) result_.corners.push_back(u);
    if (at_u != at_v && at_u != Place::on && at_v != Place::on)
      result_.corners.push_back(vertex_on_edge(polyhedron, u, v));
  }
  const std::size_t end = result_.corners.size();
  for (std::size_t i = first; i < end; ++i) {
    const Index p = result_.corners[i], q = result_.corners[i + 1 == end ? first : i + 1];
    if (place(p) == Place::on && place(q) == Place::on) rim_.emplace_back(q, p);
  }
  result_.close_face(polyhedron.tags[static_cast<std::size_t>(f)]);
}

/// The same for split() by a plane that faces backward. A face so close to the plane that round-off makes it cross more
/// than twice leaves several remains: joined on one side of the plane, they must be apart on the other.
/// With crossings c1 .. c4 around the face, one side has the polygon c1 c2 .. c3 c4 .., so the other must have the two
/// polygons c1 .. c2 and c3 .. c4: the chords c1 c2 and c3 c4 are then common to both.
void Clipper::cut_face_apart(const ConvexPolyhedron& polyhedron, Index f) {
  const std::span<const Index> face = polyhedron.face(f);
  const std::size_t n = face.size();
  const auto at = [&](std::size_t i) { return place(face[i % n]); };
  std::size_t enter = 0;
  while (enter < n && !(at(enter) == Place::above && at(enter + 1) == Place::below)) ++enter;
  if (enter == n) return cut_face(polyhedron, f);  // wholly on one side
  const Index tag = polyhedron.tags[static_cast<std::size_t>(f)];
  Index first = -1;
  for (std::size_t i = enter; i < enter + n; ++i) {
    const Index u = face[i % n], v = face[(i + 1) % n];
    if (place(u) == Place::below) result_.corners.push_back(u);
    if (place(u) == place(v)) continue;
    const Index crossing = vertex_on_edge(polyhedron, u, v);
    result_.corners.push_back(crossing);
    if (place(u) == Place::above) {
      first = crossing;
    } else {
      rim_.emplace_back(first, crossing);
      result_.close_face(tag);
    }
  }
}

/// Closes the hole. Its rim is one loop, but round-off may pinch it into several.
void Clipper::add_cap(Index tag) {
  while (!rim_.empty()) {
    const Index first = rim_.back().first;
    Index last = rim_.back().second;
    rim_.pop_back();
    const std::size_t begin = result_.corners.size();
    result_.corners.push_back(first);
    while (last != first) {
      result_.corners.push_back(last);
      const auto next = std::find_if(rim_.begin(), rim_.end(), [last](const auto& edge) { return edge.first == last; });
      if (next == rim_.end()) break;
      last = next->second;
      rim_.erase(next);
    }
    if (result_.corners.size() - begin > 2)
      result_.close_face(tag);
    else
      result_.corners.resize(begin);
  }
}

void Clipper::keep_used_vertices() {
  new_number_.assign(result_.vertices.size(), -1);
  for (const Index v : result_.corners) new_number_[static_cast<std::size_t>(v)] = 0;
  Index used = 0;
  for (std::size_t v = 0; v < result_.vertices.size(); ++v) {
    if (new_number_[v] < 0) continue;
    new_number_[v] = used;
    result_.vertices[static_cast<std::size_t>(used++)] = result_.vertices[v];
  }
  result_.vertices.resize(static_cast<std::size_t>(used));
  for (Index& v : result_.corners) v = new_number_[static_cast<std::size_t>(v)];
}

}  // namespace tessera
