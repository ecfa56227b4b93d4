#include "tessera/tessellation/surface_cutter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace tessera {
namespace {

/// Parts of a cell whose volume is below this, of the cell's, are round-off between a face and the surface.
constexpr double kNoVolume = 1e-12;
/// A shell winds this often around points in it, and not half as often around others; on its faces, edges and corners
/// it is a part of once.
constexpr double kAround = 0.01;

/// The root of p in a forest that joins points; halves the way there.
Index root_of(std::vector<Index>& root, Index p) {
  while (root[static_cast<std::size_t>(p)] != p) {
    Index& up = root[static_cast<std::size_t>(p)];
    up = root[static_cast<std::size_t>(up)];
    p = up;
  }
  return p;
}

void join(std::vector<Index>& root, Index p, Index q) {
  const auto [low, high] = std::minmax({root_of(root, p), root_of(root, q)});
  root[static_cast<std::size_t>(high)] = low;
}

/// Solid angle of a triangle seen from the origin, positive when it runs counter-clockwise seen from the far side.
/// A. van Oosterom, J. Strackee, The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 1983.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double A = norm(a), B = norm(b), C = norm(c);
  return 2.0 * std::atan2(dot(a, cross(b, c)), A * B * C + dot(a, b) * C + dot(b, c) * A + dot(c, a) * B);
}

}  // namespace

const CutCell& SurfaceCutter::cut(const DualCell& cell) {
  cell_ = &cell;
  lines_.find(cell);
  result_.faces.clear();
  result_.parts.clear();
  result_.home = 0;
  find_shells();
  measure_shells();
  find_parts();
  add_faces();
  merge_patches();
  return result_;
}

Vec3 SurfaceCutter::normal_of(Index carrier) const {
  if (carrier >= cell_->faces())
    return planes_
        .normal[static_cast<std::size_t>(lines_.triangles()[static_cast<std::size_t>(carrier - cell_->faces())])];
  const auto g = static_cast<std::size_t>(cell_->neighbours[static_cast<std::size_t>(carrier)]);
  return normalized(generators_[g] - generators_[static_cast<std::size_t>(cell_->particle)]);
}

/// The piece that closed lines on one carrier go around, as signed triangles from one of its points.
FlatPiece SurfaceCutter::measure(std::span<const Member> lines) const {
  const Vec3 normal = normal_of(lines.front().carrier), origin = origin_of(lines);
  FlatPiece piece;
  for (const Member& line : lines) {
    const Vec3 u = point(line.from).X - origin, v = point(line.to).X - origin;
    const Vec3 area = 0.5 * cross(u, v);
    const double size = dot(normal, area);
    piece.area += area;
    piece.size += size;
    piece.moment += (size / 3.0) * (u + v);
    piece.second += (size / 12.0) * (square(u) + square(v) + square(u + v));
  }
  piece.second += symmetric_product(piece.moment, origin) + piece.size * square(origin);
  piece.moment += piece.size * origin;
  return piece;
}

/// Calls visit(lines) for the lines of every shell on every carrier.
template <class Visit>
void SurfaceCutter::for_each_piece(Visit&& visit) const {
  for (auto first = members_.begin(); first != members_.end();) {
    const auto last = std::find_if(
        first, members_.end(), [&](const Member& m) { return m.carrier != first->carrier || m.shell != first->shell; });
    visit(std::span<const Member>(first, last));
    first = last;
  }
}

std::vector<SurfaceCutter::Outline> SurfaceCutter::outlines() const {
  std::map<std::pair<Index, Index>, Outline> found;  // by carrier and part: a hole may belong to another shell
  for (const Member& line : members_) {
    const Index part = shells_[static_cast<std::size_t>(line.shell)].part;
    Outline& outline = found[{line.carrier, part}];
    outline.part = part;
    outline.normal = normal_of(line.carrier);
    outline.lines.push_back({line.from, line.to});
  }
  std::vector<Outline> all;
  for (auto& [key, outline] : found) all.push_back(std::move(outline));
  return all;
}

void SurfaceCutter::find_shells() {
  root_.resize(lines_.points().size());
  for (std::size_t p = 0; p < root_.size(); ++p) root_[p] = static_cast<Index>(p);
  for (const SurfaceLines::Line& line : lines_.lines()) join(root_, line.from, line.to);
  members_.clear();
  for (const SurfaceLines::Line& line : lines_.lines())
    members_.push_back({line.carrier, root_of(root_, line.from), line.from, line.to});
  std::vector<Index> roots;
  for (const Member& member : members_) roots.push_back(member.shell);
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  for (Member& member : members_)
    member.shell = static_cast<Index>(std::lower_bound(roots.begin(), roots.end(), member.shell) - roots.begin());
  std::stable_sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
    return std::tie(a.carrier, a.shell) < std::tie(b.carrier, b.shell);
  });
  shells_.assign(roots.size(), {});
}

/// Cones from the particle to the pieces.
void SurfaceCutter::measure_shells() {
  for_each_piece([&](std::span<const Member> lines) {
    const FlatPiece piece = measure(lines);
    Shell& shell = shells_[static_cast<std::size_t>(lines.front().shell)];
    const Vec3 origin = origin_of(lines);
    shell.volume += dot(piece.area, origin) / 3.0;
    const double height = dot(normal_of(lines.front().carrier), origin);
    shell.moment += 0.25 * height * piece.moment;
    shell.second += 0.2 * height * piece.second;
    if (lines.front().carrier < cell_->faces()) shell.free_area += piece.size;
  });
}

/// How often a shell goes around X, about.
double SurfaceCutter::winding(Index shell, const Vec3& X) const {
  double angle = 0.0;
  for_each_piece([&](std::span<const Member> lines) {
    if (lines.front().shell != shell) return;
    const Vec3 origin = origin_of(lines) - X;
    for (const Member& line : lines) angle += solid_angle(origin, point(line.from).X - X, point(line.to).X - X);
  });
  return angle / (4.0 * std::numbers::pi);
}

/// A shell that encloses a volume is a part of its own; others are cavities or tunnels in the part that they are in.
void SurfaceCutter::find_parts() {
  double total = 0.0;
  for (const Shell& shell : shells_) total += shell.volume;
  const double no_area = kNoVolume * std::cbrt(total * total);
  const auto is_part = [&](const Shell& shell) {
    return shell.volume > kNoVolume * total || (shell.volume > -kNoVolume * total && shell.free_area > no_area);
  };
  std::vector<Index> outside;  // the shell around each part
  for (Index s = 0; s < static_cast<Index>(shells_.size()); ++s)
    if (Shell& shell = shells_[static_cast<std::size_t>(s)]; shells_.size() == 1 || is_part(shell)) {
      shell.part = static_cast<Index>(outside.size());
      outside.push_back(s);
    }
  // Parts may be nested, one in a cavity of the other: the innermost counts.
  const auto part_around = [&](const Vec3& X) {
    if (outside.size() < 2) return Index{0};
    Index best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Index s : outside) {
      const Shell& shell = shells_[static_cast<std::size_t>(s)];
      if (shell.volume < least && winding(s, X) > kAround) best = shell.part, least = shell.volume;
    }
    return best;
  };
  result_.parts.resize(std::max<std::size_t>(outside.size(), 1));
  result_.home = part_around({});
  for (Index s = 0; s < static_cast<Index>(shells_.size()); ++s) {
    Shell& shell = shells_[static_cast<std::size_t>(s)];
    if (shell.part < 0) {
      const auto own = std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.shell == s; });
      shell.part = part_around(point(own->from).X);
    }
    CutCell::Part& part = result_.parts[static_cast<std::size_t>(shell.part)];
    part.volume += shell.volume;
    part.moment += shell.moment;
    part.second += shell.second;
  }
}

CutFace SurfaceCutter::face_of(Index carrier) const {
  CutFace face;
  if (carrier < cell_->faces()) {
    face.neighbour = cell_->neighbours[static_cast<std::size_t>(carrier)];
  } else {
    const Index t = lines_.triangles()[static_cast<std::size_t>(carrier - cell_->faces())];
    face.patch = planes_.patch[static_cast<std::size_t>(t)];
  }
  return face;
}

void SurfaceCutter::add_faces() {
  if (result_.parts.size() > 1) {
    for_each_piece([&](std::span<const Member> lines) { add_loops(lines); });
    return;
  }
  for (auto first = members_.begin(); first != members_.end();) {
    const auto last = std::find_if(first, members_.end(), [&](const Member& m) { return m.carrier != first->carrier; });
    CutFace face = face_of(first->carrier);
    face.piece = measure(std::span<const Member>(first, last));
    result_.faces.push_back(face);
    first = last;
  }
}

/// Every closed line for itself: the part on its other side need not be that of others on the same face.
void SurfaceCutter::add_loops(std::span<const Member> lines) {
  for (const Member& line : lines) root_[static_cast<std::size_t>(line.from)] = line.from;
  for (const Member& line : lines) root_[static_cast<std::size_t>(line.to)] = line.to;
  for (const Member& line : lines) join(root_, line.from, line.to);
  std::vector<Member> loops(lines.begin(), lines.end());
  std::stable_sort(loops.begin(), loops.end(),
                   [&](const Member& a, const Member& b) { return root_of(root_, a.from) < root_of(root_, b.from); });
  for (auto first = loops.begin(); first != loops.end();) {
    const Index root = root_of(root_, first->from);
    const auto last = std::find_if(first, loops.end(), [&](const Member& m) { return root_of(root_, m.from) != root; });
    CutFace face = face_of(first->carrier);
    face.part = shells_[static_cast<std::size_t>(first->shell)].part;
    face.piece = measure(std::span<const Member>(first, last));
    face.name = point(first->from).name;
    for (auto line = first; line != last; ++line) face.name = std::min(face.name, point(line->from).name);
    result_.faces.push_back(face);
    first = last;
  }
}

/// Puts the pieces of every patch of the surface together.
void SurfaceCutter::merge_patches() {
  std::vector<CutFace>& faces = result_.faces;
  const auto begin = std::find_if(faces.begin(), faces.end(), [](const CutFace& f) { return f.neighbour < 0; });
  std::stable_sort(begin, faces.end(), [](const CutFace& a, const CutFace& b) {
    return std::tie(a.patch, a.part) < std::tie(b.patch, b.part);
  });
  auto last = begin;
  for (auto face = begin; face != faces.end(); ++face) {
    if (last != begin && (last - 1)->patch == face->patch && (last - 1)->part == face->part)
      (last - 1)->piece.add(face->piece);
    else
      *last++ = *face;
  }
  faces.erase(last, faces.end());
}

}  // namespace tessera
