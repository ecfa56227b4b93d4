#include <gtest/gtest.h>

#include "support/reference_sums.hpp"
#include "support/small_bodies.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/mechanics/second_order.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::test {
namespace {

using Vectors = std::array<Vec3, 6>;  // xx, xy, xz, yy, yz, zz

Vectors times(const Symmetric3& W, const Vec3& u) {
  return {W.xx * u, W.xy * u, W.xz * u, W.yy * u, W.yz * u, W.zz * u};
}

void add(Vectors& to, double factor, const Vectors& H) {
  for (std::size_t r = 0; r < 6; ++r) to[r] += factor * H[r];
}

Vec3 contracted(const Vectors& H, const Symmetric3& M) {
  return M.xx * H[0] + M.yy * H[3] + M.zz * H[5] + 2.0 * (M.xy * H[1] + M.xz * H[2] + M.yz * H[4]);
}

double largest(const Vectors& H) {
  double size = 0.0;
  for (const Vec3& h : H) size = std::max(size, norm(h));
  return size;
}

double difference(const Hessian& found, const Vectors& expected) {
  Vectors rest = expected;
  for (std::size_t r = 0; r < 6; ++r) rest[r] -= Vec3{found.h[3 * r], found.h[3 * r + 1], found.h[3 * r + 2]};
  return largest(rest);
}

/// At its teeth some faces have wide stencils, which make bonds without a face.
VoronoiBody gear() {
  const TriangleSurface surface = gear_surface(9, 0.4, 1.0, 1.3, 0.5);
  const SurfaceIndex index(surface);
  LatticeSpec spec;
  spec.spacing = 0.125;
  spec.jitter = 0.3;
  spec.seed = 4;
  VoronoiBody body;
  body.X = place_particles({spec, {}}, index).points;
  body.cells = surface_cells(body.X, index, Moments::second_of_faces).cells;
  body.D.resize(body.cells.boundary.size());
  return body;
}

struct Body {
  std::string name;
  VoronoiBody (*make)();
};

/// What discretizations with held and free faces say of a motion, by sums over their bonds and terms.
class DerivativeSweeps : public testing::TestWithParam<Body> {
 protected:
  DerivativeSweeps() {
    move(state, s, [](const Vec3& X) { return (1.0 / 3.0) * wavy(3.0 * X); });
    for (Index tile = 0; tile < s.tiles.size(); ++tile)
      derivative_sweep(s, tile, state.x.data(), scratch, F.data(), weighted.data());
  }

  Vec3 u(Index a, Index b) const {
    return to_vec3(state.x[static_cast<std::size_t>(b)] - state.x[static_cast<std::size_t>(a)]);
  }

  Vectors sum(Index a, const std::vector<CurvatureTerm>& terms) const {
    Vectors result{};
    for (const CurvatureTerm& t : terms) add(result, 1.0, times(t.W, u(a, t.particle)));
    return result;
  }

  /// F_a V_a but for boundary nodes, from faces where they are for linear motion.
  Mat3 linear(Index a) const {
    Mat3 VF;
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
      VF += outer(u(a, d.bonds.neighbour[static_cast<std::size_t>(i)]), d.bonds.B_ab[static_cast<std::size_t>(i)]);
    return VF;
  }

  /// What second derivatives add to that by the faces between cells.
  Mat3 of_faces(Index a) const {
    Mat3 VF;
    d.for_each_face_neighbour(a, [&](Offset bond, Index b) {
      const double q_a = own.weight[static_cast<std::size_t>(a)], q_b = own.weight[static_cast<std::size_t>(b)];
      if (q_a == 0.0 || q_b == 0.0) return;
      Vectors of_face{};
      add(of_face, q_a / (q_a + q_b), sum(a, curvature(d, own, a)));
      add(of_face, q_b / (q_a + q_b), sum(b, curvature(d, own, b)));
      const auto k = static_cast<std::size_t>(bond);
      VF +=
          outer(contracted(of_face, d.second_order->M_of_bond(bond)), d.bonds.area_over_length[k] * d.branch(a, bond));
    });
    return VF;
  }

  /// And by free faces at the boundary.
  Mat3 of_surface(Index a) const {
    Mat3 VF;
    for (const CurvedSurface& surface : d.second_order->surfaces)
      if (surface.particle == a) {
        const Vectors H = sum(a, cell_curvature(d, own, a));
        for (std::size_t r = 0; r < 6; ++r) VF += outer(H[r], surface.area_moment[r]);
      }
    return VF;
  }

  const Discretization d = discretize(Method::consistent, GetParam().make(), Integration::second_order);
  const SecondDerivatives& own = d.second_order->derivatives;
  const System s = system_of(d, rubber());
  State state = reference_state(s);
  Field<Tensor> F = Field<Tensor>(s.d.X.size());
  Field<Hessian> weighted = Field<Hessian>(s.d.X.size());
  CurvatureScratch scratch{s.tiles};
};

/// In rows of tiles as in bonds: neighbours with a common face, others, and what fits take beyond them.
TEST_P(DerivativeSweeps, FollowBondsAndTerms) {
  EXPECT_GT(s.tiles.size(), 3);
  EXPECT_EQ(s.second_order->rows.others.empty(), GetParam().name == "mixed_box" || GetParam().name == "regular_box");
  EXPECT_FALSE(s.second_order->rows.far.empty());
  for (Index a = 0; a < s.particles(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    EXPECT_LT(size_of(to_mat3(F[k]) - (1.0 / d.volume[k]) * linear(a)), 1e-13) << a;
    Vectors expected{};
    add(expected, own.weight[k], sum(a, curvature(d, own, a)));
    EXPECT_LE(difference(weighted[k], expected), 1e-11 * largest(expected)) << a;
  }
}

/// Faces are where second derivatives put them; what cells use are H_a or sums of q_b H_b.
TEST_P(DerivativeSweeps, PutFacesWhereSecondDerivativesSay) {
  SecondOrderMemory memory(s);
  find_strain(s, state.x.data(), memory, F.data());
  double size = 0.0;
  for (Index a = 0; a < s.particles(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    const Mat3 added = of_faces(a) + of_surface(a);
    size = std::max(size, size_of((1.0 / d.volume[k]) * added));
    EXPECT_LT(size_of(to_mat3(F[k]) - (1.0 / d.volume[k]) * (linear(a) + added)), 1e-13) << a;
    const Vectors expected = sum(a, cell_curvature(d, own, a));
    for (double& h : memory.weighted[k].h) h *= s.second_order->rows.inverse_sum[k];
    EXPECT_LE(difference(memory.weighted[k], expected), 1e-11 * largest(expected)) << a;
  }
  EXPECT_GT(size, 1e-3);
}

std::vector<Body> bodies() {
  return {{"mixed_box",
           [] {
             return voronoi_body(box({1, 1, 1}), {5, 4, 5}, 0.25, 9, mixed);
           }},
          {"regular_box",
           [] {
             return voronoi_body(box({1, 1, 1}), {5, 5, 5}, 0.0, 9, nothing);
           }},
          {"l_block",
           [] {
             return voronoi_body(l_block(), {8, 13, 4}, 0.3, 4, nothing);
           }},
          {"gear", gear}};
}

INSTANTIATE_TEST_SUITE_P(All, DerivativeSweeps, testing::ValuesIn(bodies()),
                         [](const auto& body) { return body.param.name; });

}  // namespace
}  // namespace tessera::test
