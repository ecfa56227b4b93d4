#include "tessera/output/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sample.hpp"

namespace tessera {
namespace {

ProbeSpec spec(ProbeKind kind, const std::string& quantity = "") {
  ProbeSpec s;
  s.name = "tip";
  s.kind = kind;
  s.quantity = quantity;
  s.origin = {"case.toml", 4, 2, "probe"};
  return s;
}

std::vector<Index> all() {
  std::vector<Index> particles(8);
  std::iota(particles.begin(), particles.end(), 0);
  return particles;
}

std::string names(const ProbeSpec& s) {
  std::string text;
  for (const Column& c : probe_columns(s)) text += c.name + "[" + c.unit + "] ";
  return text;
}

TEST(Probes, PointMovesWithTheNearestParticle) {
  ProbeSpec point = spec(ProbeKind::point);
  point.at = Vec3{1.0, 0.9, 0.1};  // beyond the centre of particle 3
  const Snapshot s = sample::snapshot();
  const BoundProbe probe = bind_probe(point, s, all());
  EXPECT_EQ(probe.particles, std::vector<Index>{3});
  const Vec3 expected = sample::F * *point.at + sample::shift;
  const std::vector<double> values = probe_values(probe, s);
  ASSERT_EQ(values.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(values[static_cast<std::size_t>(i)], expected[i], 1e-14);
  EXPECT_EQ(names(point), "tip.x[m] tip.y[m] tip.z[m] ");
}

/// A point in millimetres that was meant in metres, or the other way round.
TEST(Probes, RefusePointsFarFromAllBodies) {
  ProbeSpec point = spec(ProbeKind::point);
  const Snapshot s = sample::snapshot();  // particles within a box of 0.866 m
  point.at = Vec3{1.6, 0.75, 0.75};
  EXPECT_NO_THROW(bind_probe(point, s, all()));
  point.at = Vec3{500, 0.75, 0.75};
  try {
    bind_probe(point, s, all());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "case.toml:4:2: probe: probe \"tip\": at = (500, 0.75, 0.75) m is 499 m away from the nearest particle, but "
        "all particles lie within 0.866 m; is a unit missing?");
  }
}

TEST(Probes, OfEquallyNearParticlesTheFirstIsTaken) {
  const std::vector<Index> candidates = {4, 5, 6, 7};
  EXPECT_EQ(nearest_particle(sample::snapshot(), candidates, {0.5, 0.5, 0.5}), 4);
}

TEST(Probes, AverageIsWeightedWithVolumes) {
  Snapshot s = sample::snapshot();
  s.volume = {1, 3, 1, 1, 1, 1, 1, 1};
  const std::vector<Index> two = {0, 1};
  const BoundProbe probe = bind_probe(spec(ProbeKind::average, "velocity"), s, two);
  EXPECT_EQ(probe_values(probe, s), (std::vector<double>{0.25 * 1.0 + 0.75 * 2.0, -2.0, 0.75 * 0.5}));
  EXPECT_EQ(names(spec(ProbeKind::average, "velocity")),
            "tip.velocity_x[m/s] tip.velocity_y[m/s] tip.velocity_z[m/s] ");
}

TEST(Probes, MaximumIsPerComponentAndTheLengthOfVectors) {
  const Snapshot s = sample::snapshot();
  const BoundProbe probe = bind_probe(spec(ProbeKind::maximum, "velocity"), s, {1, 2, 5});
  EXPECT_EQ(probe_values(probe, s), (std::vector<double>{6.0, -2.0, 2.5, std::sqrt(36.0 + 4.0 + 6.25)}));
  EXPECT_EQ(names(probe.spec), "tip.velocity_x[m/s] tip.velocity_y[m/s] tip.velocity_z[m/s] tip.velocity[m/s] ");
  EXPECT_EQ(maximum(find_quantity("energy_density", {}), s, all()), std::vector<double>{7000.0});
  EXPECT_EQ(names(spec(ProbeKind::maximum, "energy_density")), "tip.energy_density[J/m3] ");
}

TEST(Probes, EveryQuantityHasAsManyValuesAsColumns) {
  const Snapshot s = sample::snapshot();
  for (const Quantity& q : quantity_table())
    for (const ProbeKind kind : {ProbeKind::average, ProbeKind::maximum}) {
      const BoundProbe probe = bind_probe(spec(kind, std::string(q.name)), s, all());
      EXPECT_EQ(probe_values(probe, s).size(), probe_columns(probe.spec).size()) << q.name;
    }
}

TEST(Probes, MomentumAboutTheOrigin) {
  Snapshot s = sample::snapshot();
  s.position[2] = {1.0, 2.0, 3.0};
  s.velocity[2] = {0.0, 0.0, 4.0};
  s.mass[2] = 0.5;
  const BoundProbe probe = bind_probe(spec(ProbeKind::momentum), s, {2});
  EXPECT_EQ(probe_values(probe, s), (std::vector<double>{0.0, 0.0, 2.0, 4.0, -2.0, 0.0}));
  EXPECT_EQ(names(probe.spec),
            "tip.px[kg m/s] tip.py[kg m/s] tip.pz[kg m/s] tip.lx[kg m2/s] tip.ly[kg m2/s] tip.lz[kg m2/s] ");
}

TEST(Probes, EnergyOfABody) {
  const Snapshot s = sample::snapshot();
  const BoundProbe probe = bind_probe(spec(ProbeKind::energy), s, {4, 5, 6, 7});
  double kinetic = 0.0;
  for (int i = 4; i < 8; ++i) kinetic += 0.5 * (100.0 + i) * ((1.0 + i) * (1.0 + i) + 4.0 + 0.25 * i * i);
  const std::vector<double> values = probe_values(probe, s);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0], kinetic, 1e-10);
  EXPECT_NEAR(values[1], 0.125 * 22000.0, 1e-10);
  EXPECT_EQ(names(probe.spec), "tip.kinetic[J] tip.internal[J] ");
}

TEST(Probes, ReactionsAreLeftToTheCaller) {
  const Snapshot s = sample::snapshot();
  EXPECT_TRUE(probe_values(bind_probe(spec(ProbeKind::reaction), s, {}), s).empty());
  EXPECT_EQ(names(spec(ProbeKind::reaction)), "tip.fx[N] tip.fy[N] tip.fz[N] tip.tx[N m] tip.ty[N m] tip.tz[N m] ");
}

TEST(Probes, WhatIsMissingIsNamed) {
  const Snapshot s = sample::snapshot();
  const auto binding = [&](const ProbeSpec& p, std::vector<Index> candidates) {
    return sample::message_of<InputError>([&] { bind_probe(p, s, std::move(candidates)); });
  };
  const std::string place = "case.toml:4:2: probe: ";
  EXPECT_EQ(binding(spec(ProbeKind::point), all()), place + "probe \"tip\" of type point needs `at = [X, Y, Z]`");
  EXPECT_EQ(binding(spec(ProbeKind::average), all()),
            place + "probe \"tip\" needs `quantity`, for example \"von_mises\"");
  EXPECT_EQ(binding(spec(ProbeKind::average, "mass"), {}), place + "probe \"tip\" takes no particle; widen `where`");
  EXPECT_EQ(binding(spec(ProbeKind::maximum, "presure"), all())
                .find(place + "unknown quantity \"presure\" (did you mean "
                              "\"pressure\"?)"),
            0u);
}

}  // namespace
}  // namespace tessera
