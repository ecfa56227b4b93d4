#include "tessera/bench/cantilever.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "tessera/bench/cantilever_reference.hpp"
#include "tessera/bench/rubber.hpp"
#include "tessera/simulation/engine.hpp"

namespace tessera {

namespace {

using ReferencePoint = double (CantileverReference::*)[2];

ReferencePoint reference_point(Formulation formulation, int per_metre) {
  if (formulation == Formulation::delaunay) return &CantileverReference::corner_top;
  switch (per_metre) {
    case 4:
      return &CantileverReference::in8;
    case 8:
      return &CantileverReference::in16;
    case 16:
      return &CantileverReference::in32;
    default:
      throw UsageError(
          fmt::format("the cantilever's reference has cell centres for 4, 8 and 16 per metre, not for {}", per_metre));
  }
}

/// The material point that is followed [m].
Vec3 followed_point(Formulation formulation, int per_metre) {
  const double inside = formulation == Formulation::delaunay ? 0.0 : 0.5 / per_metre;
  return {6.0 - inside, 0.5 - inside, 0.5 - inside};
}

BodySpec beam(int per_metre) {
  Shape shape;
  shape.kind = BoxShape{{0, -0.5, -0.5}, {6, 0.5, 0.5}};
  LatticeSpec lattice;
  lattice.spacing = 1.0 / per_metre;
  lattice.jitter = 0.2;
  BodySpec body;
  body.name = "beam";
  body.shape = shape;
  body.particles = {lattice, {}};
  return body;
}

/// A material point that moves with the nearest particle, x_a + F_a (X - X_a).
class Follower {
 public:
  Follower(const Snapshot& start, const Vec3& X) : X_(X) {
    const auto& points = start.reference_position;
    const auto nearest = std::min_element(points.begin(), points.end(),
                                          [&](const Vec3& p, const Vec3& q) { return norm2(p - X) < norm2(q - X); });
    particle_ = static_cast<Index>(nearest - points.begin());
  }

  /// Where it is at `t`, at most half a step from the engine's time [m].
  Vec3 position(const Engine& engine, double t) const {
    const Snapshot s = engine.snapshots().part(particle_, particle_ + 1);
    return s.position[0] + s.deformation_gradient[0] * (X_ - s.reference_position[0]) +
           (t - engine.time()) * s.velocity[0];
  }

 private:
  Vec3 X_;
  Index particle_;
};

}  // namespace

Case cantilever_case(Formulation formulation, int per_metre, Integration integration) {
  Case c;
  c.title = "Cantilever";
  c.method.formulation = formulation;
  c.method.integration = integration;
  c.bodies = {beam(per_metre)};
  c.materials = {bench_rubber()};
  c.initial = {{"", {}, {Formula(0.0), Formula(0.0), Formula("10*X/6", {})}, {}}};
  c.boundary = {{"", {{"-x"}, {}}, Condition::fixed, {}}};
  c.time.step = AutoSpectralStep{};
  c.time.safety = 0.8;
  c.time.end = std::rbegin(cantilever_reference)->t;
  return c;
}

CantileverPath run_cantilever(Formulation formulation, int per_metre, Integration integration) {
  reference_point(formulation, per_metre);
  const Case c = cantilever_case(formulation, per_metre, integration);
  Model model = build_model(c);
  require(model.identities);
  CantileverPath path;
  path.particles = model.system.particles();
  path.x.reserve(std::size(cantilever_reference));

  using Clock = std::chrono::steady_clock;
  Clock::duration stepping{};
  auto start = Clock::now();
  Engine engine(model, c.time);
  engine.prepare();
  stepping += Clock::now() - start;
  const Follower point(engine.snapshot(), followed_point(formulation, per_metre));
  for (const CantileverReference& r : cantilever_reference) {
    start = Clock::now();
    while (!engine.finished() && engine.time() + 0.5 * engine.dt() < r.t) {
      engine.advance();
      engine.verify_deformation();
      engine.prepare();
    }
    stepping += Clock::now() - start;
    path.x.push_back(point.position(engine, r.t));
  }
  path.steps = engine.steps();
  path.seconds = std::chrono::duration<double>(stepping).count();
  return path;
}

double path_error(const CantileverPath& path, Formulation formulation, int per_metre) {
  const ReferencePoint point = reference_point(formulation, per_metre);
  const double* X = cantilever_reference[0].*point;
  double deviation = 0.0, way = 0.0;
  for (std::size_t i = 0; i < std::size(cantilever_reference); ++i) {
    const double* x_ref = cantilever_reference[i].*point;
    const double x1 = path.x[i].x - x_ref[0], x3 = path.x[i].z - x_ref[1];
    const double way_x1 = x_ref[0] - X[0], way_x3 = x_ref[1] - X[1];
    deviation += x1 * x1 + x3 * x3;
    way += way_x1 * way_x1 + way_x3 * way_x3;
  }
  return std::sqrt(deviation / way);
}

}  // namespace tessera
