#include "tessera/discretization/face_positions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/error.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/stencil.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

namespace {

// A stencil that needs weights this many times larger than the face's offset is as good as degenerate.
constexpr double largest_amplification = 10.0;
// What a face position may miss, relative to the distance of the particles.
constexpr double position_tolerance = 1e-12;
// Faces whose centroid is this close to the middle of the branch, relative to its length, need no stencil.
constexpr double centred = 1e-15;

using Collector = parallel::RowCollector<FaceTerm>;

/// Memory of one stencil, kept from face to face.
struct Scratch {
  CommonNeighbours common;
  std::vector<Index> stencil;
  std::vector<Vec3> y;
  std::vector<double> w;
};

class FaceFitter {
 public:
  FaceFitter(const Generators& X, const Cells& cells, const Csr<FaceOfCell>& faces)
      : X_(X), cells_(cells), faces_(faces) {}

  /// Return whether the stencil had to be widened.
  bool interior(const InteriorFace& f, Scratch& s, StencilFunction& function) const;
  bool boundary(const BoundaryFace& f, const Mat3& D, Scratch& s, Collector& out) const;
  /// Adds the terms of a boundary face's position and returns whether its stencil had to be widened, or -1 if nothing
  /// spans the way there.
  int extrapolate(const BoundaryFace& f, const Mat3& D, Scratch& s, Collector& out) const;

 private:
  void add_neighbours(Index a, std::vector<Index>& list) const {
    for (const FaceOfCell& f : interior_faces(faces_, a)) list.push_back(f.neighbour);
  }
  void place(Scratch& s, const Vec3& origin) const {
    s.y.clear();
    for (Index c : s.stencil) s.y.push_back(X_[static_cast<std::size_t>(c)] - origin);
    s.w.resize(s.y.size());
  }
  void first_ring(const InteriorFace& f, Scratch& s) const;
  void both_rings(const InteriorFace& f, Scratch& s) const;
  void second_ring(Index a, Scratch& s) const;
  const Vec3& at(Index a) const { return X_[static_cast<std::size_t>(a)]; }

  Generators X_;
  const Cells& cells_;
  const Csr<FaceOfCell>& faces_;
};

void sort_once(std::vector<Index>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

void FaceFitter::first_ring(const InteriorFace& f, Scratch& s) const {
  const std::span<const FaceOfCell> of_a = interior_faces(faces_, f.a);
  s.stencil.assign({f.a, f.b});
  for (const Index place : s.common.find(of_a, interior_faces(faces_, f.b)))
    s.stencil.push_back(of_a[static_cast<std::size_t>(place)].neighbour);
}

/// a and b are neighbours of each other.
void FaceFitter::both_rings(const InteriorFace& f, Scratch& s) const {
  s.stencil.clear();
  add_neighbours(f.a, s.stencil);
  add_neighbours(f.b, s.stencil);
  sort_once(s.stencil);
}

/// c_f = (1 - s) x_a + s x_b + sum_c w_c x_c: over a, b and their common neighbours; over all neighbours of both where
/// those do not span the face's offset.
bool FaceFitter::interior(const InteriorFace& f, Scratch& s, StencilFunction& function) const {
  const Vec3 middle = on_branch(f, at(f.a), at(f.b));
  const Vec3 offset = f.centroid - middle;
  const double L = norm(at(f.b) - at(f.a));
  if (norm(offset) <= centred * L) return false;

  for (const bool widened : {false, true}) {
    if (widened)
      both_rings(f, s);
    else
      first_ring(f, s);
    place(s, middle);
    const StencilFit fit = balanced_weights(s.y, offset, s.w);
    if (norm(fit.residual) > position_tolerance * L || fit.amplification > largest_amplification) continue;
    function = fit.function;
    return widened;
  }
  throw GeometryError(
      fmt::format("the face between particles {} and {} cannot follow a linear motion: their neighbours lie in one "
                  "plane or line; use at least two layers of particles in every direction",
                  X_.named(f.a), X_.named(f.b)));
}

void FaceFitter::second_ring(Index a, Scratch& s) const {
  for (const FaceOfCell& f : interior_faces(faces_, a)) {
    s.stencil.push_back(f.neighbour);
    add_neighbours(f.neighbour, s.stencil);
  }
  sort_once(s.stencil);
  std::erase(s.stencil, a);
}

/// The free components of c_f = x_a + sum_c w_c (x_c - x_a): over the neighbours, over theirs too where those do not
/// span the way from the particle to the face. What a symmetric face moves along its normal is prescribed, so
/// its residual may point there (a slab one cell thick).
int FaceFitter::extrapolate(const BoundaryFace& f, const Mat3& D, Scratch& s, Collector& out) const {
  const Vec3 offset = f.centroid - at(f.owner), N = normalized(f.area);
  const double size = std::cbrt(cells_.volume[static_cast<std::size_t>(f.owner)]);
  const Mat3 beyond_normal = D - outer(N, N);
  const bool symmetric = contract(beyond_normal, beyond_normal) < 1e-20;
  for (const bool widened : {false, true}) {
    s.stencil.clear();
    if (widened)
      second_ring(f.owner, s);
    else
      add_neighbours(f.owner, s.stencil);
    if (s.stencil.empty()) continue;
    place(s, at(f.owner));
    const StencilFit fit = spanning_weights(s.y, offset, s.w);
    const Vec3 missed = symmetric ? fit.residual - dot(fit.residual, N) * N : fit.residual;
    if (norm(missed) > position_tolerance * size || fit.amplification > largest_amplification) continue;
    double sum = 0.0;
    for (std::size_t c = 0; c < s.stencil.size(); ++c) {
      out.add({s.stencil[c], s.w[c]});
      sum += s.w[c];
    }
    out.add({f.owner, 1.0 - sum});
    return widened ? 1 : 0;
  }
  return -1;
}

bool FaceFitter::boundary(const BoundaryFace& f, const Mat3& D, Scratch& s, Collector& out) const {
  const int widened = extrapolate(f, D, s, out);
  if (widened >= 0) return widened == 1;
  throw GeometryError(
      fmt::format("the boundary face of particle {} cannot follow a linear motion: the particle's neighbours lie in "
                  "one plane or line; use at least two layers of particles in every direction",
                  X_.named(f.owner)));
}

std::vector<Index> marked(const std::vector<char>& marks) {
  std::vector<Index> list;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) list.push_back(static_cast<Index>(i));
  return list;
}

}  // namespace

FacePositions face_positions(const Generators& X, const Cells& cells, const Csr<FaceOfCell>& faces,
                             std::span<const Mat3> D) {
  const FaceFitter fitter(X, cells, faces);
  FacePositions p;
  p.interior.resize(cells.interior.size());
  p.is_widened.assign(cells.interior.size(), 0);
  parallel::for_each(static_cast<std::int64_t>(cells.interior.size()), [&](std::int64_t i) {
    thread_local Scratch scratch;
    const auto k = static_cast<std::size_t>(i);
    p.is_widened[k] = fitter.interior(cells.interior[k], scratch, p.interior[k]);
  });
  std::vector<char> wide(cells.boundary.size(), 0);
  p.boundary = parallel::collect_rows<FaceTerm>(static_cast<Index>(wide.size()), [&](Index i, Collector& out) {
    thread_local Scratch scratch;
    const auto k = static_cast<std::size_t>(i);
    if (!is_identity(D[k])) wide[k] = fitter.boundary(cells.boundary[k], D[k], scratch, out);
  });
  p.widened_boundary = marked(wide);
  return p;
}

}  // namespace tessera
