#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "tessera/parallel/parallel.hpp"
#include "tessera/simulation/engine.hpp"

namespace tessera::test {

enum class Method { delaunay, consistent, variational, quasi_static };
inline constexpr std::array<Method, 4> all_methods{Method::delaunay, Method::consistent, Method::variational,
                                                   Method::quasi_static};

inline std::string name_of(Method m) {
  return std::array<const char*, 4>{"delaunay", "consistent", "variational",
                                    "quasi_static"}[static_cast<std::size_t>(m)];
}

inline Formula formula(const std::string& text) { return Formula(text, {"case.toml", 1, 1, "formula"}); }
inline FormulaVec3 formulas(const std::string& x, const std::string& y, const std::string& z) {
  return {formula(x), formula(y), formula(z)};
}
inline PartialFormulaVec3 components(const FormulaVec3& f) { return {f[0], f[1], f[2]}; }

inline BoundaryCondition condition(std::vector<std::string> where, decltype(BoundaryCondition::kind) kind) {
  BoundaryCondition c;
  c.origin = {"case.toml", 10, 1, "boundary"};
  c.where = {std::move(where), {"case.toml", 10, 9, "where"}};
  c.kind = std::move(kind);
  return c;
}

inline InitialCondition initial_velocity(const FormulaVec3& v) { return {"", formulas("0", "0", "0"), v, {}}; }

inline Material rubber(double young = 1e6) {
  Material m;
  m.name = "rubber";
  m.young = young;
  m.poisson = 0.3;
  m.density = 1000.0;
  m.law = NeoHookean::from_young_poisson(m.young, m.poisson);
  return m;
}

/// A box on a lattice; `counts` are cells (so particles of a voronoi body).
inline BodySpec box_body(Method method, const std::string& name, const Vec3& lower, const Vec3& upper,
                         std::array<int, 3> counts, double jitter) {
  BodySpec body;
  body.name = name;
  body.origin = {"case.toml", 5, 1, "body"};
  body.shape.emplace();
  body.shape->kind = BoxShape{lower, upper};
  LatticeSpec lattice;
  if (method == Method::delaunay)
    for (int& n : counts) ++n;
  lattice.counts = counts;
  lattice.jitter = jitter;
  body.particles.source = lattice;
  return body;
}

inline MethodSpec method_spec(Method method) {
  MethodSpec spec;
  spec.formulation = method == Method::delaunay ? Formulation::delaunay : Formulation::voronoi;
  if (method == Method::variational) spec.boundary = BoundaryTreatment::variational;
  if (method == Method::quasi_static) spec.boundary = BoundaryTreatment::quasi_static;
  return spec;
}

/// A free unit cube of rubber at rest, without conditions and output.
inline Case cube_case(Method method, std::array<int, 3> counts = {3, 3, 3}, double jitter = 0.2) {
  Case c;
  c.title = "cube";
  c.file = "case.toml";
  c.effective = "# effective case\n";
  c.method = method_spec(method);
  c.bodies = {box_body(method, "cube", {0, 0, 0}, {1, 1, 1}, counts, jitter)};
  c.materials = {rubber()};
  c.time.end = 0.05;
  c.time.step = FixedStep{1e-3, true};
  return c;
}

/// The same, integrated in another way: second derivatives need four cells along an edge.
inline void integrate(Case& cube, Integration integration) {
  cube.method.integration = integration;
  std::array<int, 3>& counts = *std::get<LatticeSpec>(cube.bodies[0].particles.source).counts;
  if (integration == Integration::second_order)
    for (int& n : counts) n = std::max(n, 4);
}

/// A case built and in motion.
struct Running {
  Model model;
  Engine engine;

  explicit Running(const Case& c) : model(build_model(c)), engine(model, c.time) {}
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void advance(int steps) {
    for (int i = 0; i < steps && !engine.finished(); ++i) {
      engine.prepare();
      engine.advance();
    }
  }
  /// To the end, calling `look` at every time.
  void finish(const std::function<void(const Engine&)>& look = [](const Engine&) {}) {
    while (!engine.finished()) {
      engine.prepare();
      look(engine);
      engine.advance();
    }
    engine.prepare();
    look(engine);
  }
};

/// All entries of two checkpoints are bitwise equal.
inline void expect_same(const Checkpoint& a, const Checkpoint& b) {
  ASSERT_EQ(a.arrays.size(), b.arrays.size());
  for (const auto& [name, values] : a.arrays) EXPECT_TRUE(values == b.arrays.at(name)) << name;
  EXPECT_EQ(a.integers, b.integers);
  EXPECT_EQ(a.texts, b.texts);
}

/// What an error of type E says; empty when `action` throws none.
template <class E, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const E& e) {
    return e.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace tessera::test
