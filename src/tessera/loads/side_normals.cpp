#include "tessera/loads/side_normals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera {

namespace {

/// A piece's normal at one particle, weighted with the piece's angle there.
struct Facet {
  Vec3 N;
  double angle;
};

bool is_smooth(const Vec3& N, const Vec3& M) {
  static const double least = std::cos(kSmoothAngle * std::numbers::pi / 180.0);
  return dot(N, M) > least;
}

double angle_at(const SurfacePiece& piece, Index a, std::span<const Vec3> X) {
  const auto at = [&](Index v) { return X[static_cast<std::size_t>(v)]; };
  std::vector<Vec3> edges;
  for (const Index v : piece.vertices)
    if (v != a) edges.push_back(at(v) - at(a));
  return std::atan2(norm(cross(edges.at(0), edges.at(1))), dot(edges.at(0), edges.at(1)));
}

bool is_among(const std::vector<Vec3>& normals, const Vec3& N) {
  return std::any_of(normals.begin(), normals.end(), [&](const Vec3& n) { return norm(n - N) < 1e-6; });
}

/// Facets that hang together over small angles become one normal.
std::vector<Vec3> sides_of(std::vector<Facet> facets) {
  std::vector<Vec3> sides;
  while (!facets.empty()) {
    std::vector<Facet> side{facets.front()};
    facets.erase(facets.begin());
    for (std::size_t i = 0; i < side.size(); ++i) {
      const auto joins = [&](const Facet& f) { return is_smooth(f.N, side[i].N); };
      const auto rest = std::stable_partition(facets.begin(), facets.end(), [&](const Facet& f) { return !joins(f); });
      const std::vector<Facet> joined(rest, facets.end());
      facets.erase(rest, facets.end());
      side.insert(side.end(), joined.begin(), joined.end());
    }
    Vec3 mean;
    for (const Facet& f : side) mean += f.angle * f.N;
    sides.push_back(normalized(mean));
  }
  return sides;
}

/// Distinct normals of the pieces that the entry takes as a whole.
std::vector<Vec3> normals_of_entry(const Surface& surface, const Taken& taken) {
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < surface.pieces.size(); ++i)
    if (taken.piece[i] && !is_among(normals, surface.pieces[i].N)) normals.push_back(surface.pieces[i].N);
  return normals;
}

}  // namespace

std::vector<std::vector<Vec3>> side_normals(const Surface& surface, std::span<const Vec3> X, const Taken& taken) {
  std::vector<std::vector<Facet>> facets(taken.particle.size());
  const auto note = [&](const SurfacePiece& piece, const auto& wants) {
    for (const Index a : piece.vertices)
      if (wants(static_cast<std::size_t>(a)))
        facets[static_cast<std::size_t>(a)].push_back({piece.N, angle_at(piece, a, X)});
  };
  for (std::size_t i = 0; i < surface.pieces.size(); ++i)
    if (taken.piece[i]) note(surface.pieces[i], [](std::size_t) { return true; });

  std::vector<char> at_rim(facets.size(), 0);
  for (std::size_t a = 0; a < facets.size(); ++a) at_rim[a] = taken.particle[a] && facets[a].empty() ? 1 : 0;
  if (std::find(at_rim.begin(), at_rim.end(), 1) != at_rim.end()) {
    const std::vector<Vec3> of_entry = normals_of_entry(surface, taken);
    const auto belongs = [&](const SurfacePiece& piece) {
      return std::any_of(of_entry.begin(), of_entry.end(), [&](const Vec3& N) { return is_smooth(N, piece.N); });
    };
    for (const SurfacePiece& piece : surface.pieces)
      if (belongs(piece)) note(piece, [&](std::size_t a) { return at_rim[a] != 0; });
  }
  std::vector<std::vector<Vec3>> normals(facets.size());
  for (std::size_t a = 0; a < facets.size(); ++a) normals[a] = sides_of(std::move(facets[a]));
  return normals;
}

}  // namespace tessera
