#include "tessera/discretization/identities.hpp"

#include <gtest/gtest.h>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

constexpr double round_off = 1e-11;

struct Body {
  std::string name;
  Solid solid;
  std::array<int, 3> counts;
};

std::vector<Body> bodies() { return {{"box", box({1, 0.8, 1.3}), {4, 3, 4}}, {"L-block", l_block(), {4, 10, 3}}}; }

void expect_round_off(const Identities& identities, const std::string& where) {
  for (const auto& [name, value] : identities) EXPECT_LT(value, round_off) << where << ": " << name;
}

TEST(Identities, HoldForDelaunayWhateverTheJitter) {
  for (const Body& body : bodies())
    for (double jitter : {0.0, 0.1, 0.2}) {
      const TetrahedralMesh mesh = tetrahedra(body.solid, body.counts, jitter, 11);
      const Identities found = identities_of_delaunay(discretize_delaunay(mesh, {}), body.solid.volume);
      EXPECT_EQ(found.size(), 5U);
      expect_round_off(found, body.name + ", jitter " + std::to_string(jitter));
    }
}

TEST(Identities, HoldForVoronoiWhateverTheJitterAndConditions) {
  for (const Body& body : bodies())
    for (double jitter : {0.0, 0.25, 0.49})
      for (std::uint64_t seed : {1U, 2U, 3U})
        for (Method method : {Method::consistent, Method::variational, Method::quasi_static})
          for (const Constrain& constrain : {Constrain(nothing), Constrain(mixed), Constrain(everything)}) {
            const VoronoiBody v = voronoi_body(body.solid, body.counts, jitter, seed, constrain);
            const Identities found = identities_of_voronoi(discretize(method, v), v.cells, body.solid.volume);
            EXPECT_EQ(found.size(), 6U);
            expect_round_off(found, body.name + ", " + name_of(method) + ", jitter " + std::to_string(jitter));
          }
}

/// Rows of single particles: held on all faces, or symmetric across the row and free at its ends.
TEST(Identities, HoldForRowsOfParticles) {
  const Solid row = box({5, 1, 1});
  const Constrain symmetric_across = [](const Vec3&, const Vec3& N) {
    return std::abs(N.x) > 0.5 ? Mat3{} : outer(N, N);
  };
  for (const Constrain& constrain : {Constrain(everything), symmetric_across}) {
    const VoronoiBody v = voronoi_body(row, {5, 1, 1}, 0.0, 1, constrain);
    expect_round_off(identities_of_voronoi(discretize(Method::consistent, v), v.cells, row.volume), "row");
  }
}

/// A single particle whose faces are all prescribed has a deformation of its own.
TEST(Identities, HoldForASingleParticle) {
  const Solid cube = box({1, 1, 1});
  for (Method method : {Method::consistent, Method::variational, Method::quasi_static}) {
    const VoronoiBody v = voronoi_body(cube, {1, 1, 1}, 0.0, 1, everything);
    const Discretization d = discretize(method, v);
    EXPECT_EQ(d.bonds.size(), 0);
    expect_round_off(identities_of_voronoi(d, v.cells, cube.volume), name_of(method));
  }
}

/// What is wrong with a discretization, and the identity that finds it.
struct Damage {
  std::string identity;
  std::function<void(Discretization&)> change;
};

void expect_found(const Damage& damage, const Identities& found) {
  EXPECT_GT(found.at(damage.identity), 1e-7) << damage.identity;
  try {
    require(found);
    ADD_FAILURE() << damage.identity << " was not refused";
  } catch (const GeometryError& e) {
    EXPECT_NE(std::string(e.what()).find("identity"), std::string::npos);
  }
}

TEST(Identities, EachFindsItsDamageInDelaunay) {
  const Solid solid = box({1, 1, 1});
  const TetrahedralMesh mesh = tetrahedra(solid, {4, 4, 4}, 0.2, 3);
  const auto inner_bond = [](Discretization& d) {  // between two particles inside the body
    const auto inside = [&](Index a) {
      const Vec3& X = d.X[static_cast<std::size_t>(a)];
      return std::min({X.x, X.y, X.z, 1 - X.x, 1 - X.y, 1 - X.z}) > 0.1;
    };
    for (Index a = 0; a < d.particles(); ++a)
      for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
        if (inside(a) && inside(d.bonds.neighbour[static_cast<std::size_t>(i)])) return static_cast<std::size_t>(i);
    throw std::runtime_error("no inner bond");
  };
  const std::vector<Damage> damages{
      {"volume", [](Discretization& d) { d.volume[5] *= 1.001; }},
      {"rows", [](Discretization& d) { d.B_aa[5].x += 1e-3; }},
      {"columns", [](Discretization& d) { d.bonds.B_ab[7].y += 1e-3; }},
      {"columns", [](Discretization& d) { d.load.value[3].area *= 1.1; }},
      {"duality", [](Discretization& d) { d.X[7].z += 1e-3; }},
      {"antisymmetry", [&](Discretization& d) { d.bonds.B_ab[inner_bond(d)].x += 1e-3; }},
  };
  for (const Damage& damage : damages) {
    Discretization d = discretize_delaunay(mesh, {});
    damage.change(d);
    expect_found(damage, identities_of_delaunay(d, solid.volume));
  }
}

TEST(Identities, EachFindsItsDamageInVoronoi) {
  const Solid solid = box({1, 1, 1});
  const VoronoiBody v = voronoi_body(solid, {3, 3, 3}, 0.25, 3, mixed);
  for (Method method : {Method::consistent, Method::variational, Method::quasi_static}) {
    const std::vector<Damage> damages{
        {"volume", [](Discretization& d) { d.volume[5] *= 1.001; }},
        {"duality", [](Discretization& d) { d.bonds.B_ab[7].z += 1e-3; }},
        {"duality", [](Discretization& d) { d.nodes[2].B_af.z += 1e-3; }},
    };
    for (const Damage& damage : damages) {
      Discretization d = discretize(method, v);
      damage.change(d);
      expect_found(damage, identities_of_voronoi(d, v.cells, solid.volume));
    }
  }
  Discretization d = discretize(Method::consistent, v);
  d.bonds.B_ab[7].z += 1e-3;
  expect_found({"columns", {}}, identities_of_voronoi(d, v.cells, solid.volume));
}

TEST(Identities, FindDamagedCells) {
  const Solid solid = box({1, 1, 1});
  const VoronoiBody v = voronoi_body(solid, {3, 3, 3}, 0.25, 3, nothing);
  const Discretization d = discretize(Method::consistent, v);
  const std::vector<std::pair<std::string, std::function<void(Cells&)>>> damages{
      {"rows", [](Cells& c) { c.interior[4].area.x += 1e-3; }},
      {"antisymmetry", [](Cells& c) { c.interior[4].centroid += 1e-3 * normalized(c.interior[4].area); }},
      {"area",
       [](Cells& c) {
         c.interior[4].area += 0.01 * cross(c.interior[4].area, Vec3{0.3, 0.5, 0.7});
       }},
  };
  for (const auto& [identity, change] : damages) {
    Cells cells = v.cells;
    change(cells);
    expect_found({identity, {}}, identities_of_voronoi(d, cells, solid.volume));
  }
}

TEST(Identities, RefuseWhatIsNotANumber) {
  EXPECT_NO_THROW(require({{"rows", 1e-12}}));
  EXPECT_THROW(require({{"rows", 1e-9}}), GeometryError);
  EXPECT_THROW(require({{"rows", std::numeric_limits<double>::quiet_NaN()}}), GeometryError);
  EXPECT_THROW(require(worst_of({{"rows", 0.0}}, {{"rows", std::numeric_limits<double>::quiet_NaN()}})), GeometryError);
  const Identities both = worst_of({{"rows", 1e-12}, {"volume", 3e-12}}, {{"rows", 2e-12}});
  EXPECT_EQ(both, (Identities{{"rows", 2e-12}, {"volume", 3e-12}}));
}

/// NaN inside a discretization must not pass as round-off.
TEST(Identities, FindNaN) {
  const Solid solid = box({1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const VoronoiBody v = voronoi_body(solid, {3, 3, 3}, 0.25, 3, nothing);
  Discretization voronoi = discretize(Method::consistent, v);
  voronoi.bonds.B_ab[7].x = nan;
  EXPECT_THROW(require(identities_of_voronoi(voronoi, v.cells, solid.volume)), GeometryError);
  Discretization delaunay = discretize_delaunay(tetrahedra(solid, {2, 2, 2}, 0.1, 1), {});
  delaunay.bonds.B_ab[7].x = nan;
  EXPECT_THROW(require(identities_of_delaunay(delaunay, solid.volume)), GeometryError);
}

/// Appending a body moves all indices: the identities of the two are those of each.
TEST(Append, KeepsTheIdentitiesOfBothBodies) {
  const Solid solid = box({1, 1, 1});
  for (Method method : {Method::consistent, Method::variational, Method::quasi_static}) {
    const VoronoiBody one = voronoi_body(solid, {3, 3, 3}, 0.25, 3, mixed);
    const VoronoiBody two = voronoi_body(solid, {4, 3, 3}, 0.25, 4, mixed);
    Discretization all = discretize(method, one);
    const Index particles = all.particles(), nodes = static_cast<Index>(all.nodes.size());
    const Discretization second = discretize(method, two);
    append(all, second);
    EXPECT_EQ(all.particles(), particles + second.particles());
    EXPECT_EQ(all.direct.has_value(), method == Method::quasi_static);
    for (Index f = 0; f < static_cast<Index>(second.nodes.size()); ++f) {
      const std::span<const ClosureTerm> moved = all.closure.row(nodes + f), own = second.closure.row(f);
      ASSERT_EQ(moved.size(), own.size());
      for (std::size_t k = 0; k < own.size(); ++k) {
        const bool is_node = own[k].node >= second.particles();
        EXPECT_EQ(moved[k].node, own[k].node + particles + (is_node ? nodes : 0));
      }
    }
    for (Index a = 0; a < second.particles(); ++a)
      EXPECT_EQ(all.bonds.end(particles + a) - all.bonds.begin(particles + a),
                second.bonds.end(a) - second.bonds.begin(a));
    // The bonds of the second body find each other: duality and columns of both at once.
    Cells cells = one.cells;
    for (InteriorFace f : two.cells.interior) f.a += particles, f.b += particles, cells.interior.push_back(f);
    for (BoundaryFace f : two.cells.boundary) f.owner += particles, cells.boundary.push_back(f);
    cells.volume.insert(cells.volume.end(), two.cells.volume.begin(), two.cells.volume.end());
    expect_round_off(identities_of_voronoi(all, cells, 2.0), name_of(method));
  }
}

/// And what second derivatives do: stencils, and the faces of bonds.
TEST(Append, KeepsWhatSecondDerivativesDo) {
  const Solid solid = box({1, 1, 1});
  Discretization all = discretize(Method::consistent, solid, {4, 4, 4}, 0.25, 3, mixed, Integration::second_order);
  const Discretization second =
      discretize(Method::consistent, solid, {5, 4, 4}, 0.25, 4, mixed, Integration::second_order);
  const Index particles = all.particles();
  append(all, second);
  int moved = 0;
  for (Index a = 0; a < second.particles(); ++a) {
    const std::vector<CurvatureTerm> own = cell_curvature(second, second.second_order->derivatives, a);
    const std::vector<CurvatureTerm> now = cell_curvature(all, all.second_order->derivatives, particles + a);
    ASSERT_EQ(now.size(), own.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      EXPECT_EQ(now[k].particle, own[k].particle + particles);
      EXPECT_EQ(now[k].W, own[k].W);
    }
    const Offset shift = all.bonds.begin(particles + a) - second.bonds.begin(a);
    for (Offset bond = second.bonds.begin(a); bond < second.bonds.end(a); ++bond) {
      const Symmetric3 M = second.second_order->M_of_bond(bond);
      EXPECT_EQ(all.second_order->M_of_bond(bond + shift), M);
      moved += M == Symmetric3{} ? 0 : 1;
    }
  }
  EXPECT_GT(moved, 0);
}

}  // namespace
}  // namespace tessera::test
