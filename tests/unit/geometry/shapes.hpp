#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tessera/base/error.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/shape.hpp"
#include "tessera/geometry/solid.hpp"

namespace tessera::test {

inline Origin somewhere() { return {"case.toml", 7, 3, "shape"}; }

inline Shape box(Vec3 min, Vec3 max, std::string name = "") {
  return {std::move(name), somewhere(), BoxShape{min, max}};
}

inline Shape union_of(std::vector<Shape> parts) { return {"", somewhere(), UnionShape{std::move(parts)}}; }

inline Shape difference_of(std::vector<Shape> parts) { return {"", somewhere(), DifferenceShape{std::move(parts)}}; }

inline Shape intersection_of(std::vector<Shape> parts) {
  return {"", somewhere(), IntersectionShape{std::move(parts)}};
}

inline Shape cylinder(Vec3 from, Vec3 to, double radius, double tolerance, std::string name = "") {
  return {std::move(name), somewhere(), ConeShape{from, to, {radius, radius}, tolerance}};
}

inline Shape ball(Vec3 center, double radius, double tolerance, std::string name = "") {
  return {std::move(name), somewhere(), EllipsoidShape{center, {radius, radius, radius}, tolerance}};
}

inline Shape polygon(std::vector<std::array<double, 2>> points, double thickness, double base = 0.0) {
  return {"", somewhere(), PolygonShape{std::move(points), base, thickness}};
}

/// The L-shaped block of [V].
inline Shape l_polygon() { return polygon({{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 10}, {0, 10}}, 3.0); }
inline Shape l_union() { return union_of({box({0, 0, 0}, {6, 3, 3}), box({0, 0, 0}, {3, 10, 3})}); }

inline ParticleSpec lattice(double spacing, double jitter = 0.0, std::uint64_t seed = 1) {
  return {LatticeSpec{{}, spacing, jitter, seed}, somewhere()};
}
inline ParticleSpec lattice(std::array<int, 3> counts, double jitter = 0.0, std::uint64_t seed = 1) {
  return {LatticeSpec{counts, {}, jitter, seed}, somewhere()};
}

/// Runs `action`, expects it to throw `ExpectedError`, and gives its message.
template <class ExpectedError, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const ExpectedError& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another error was thrown: " << error.what();
    return "";
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

}  // namespace tessera::test
