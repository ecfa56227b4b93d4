#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "tessera/base/units.hpp"

namespace tessera {

namespace {

struct NamedDimension {
  Dimension dimension;
  const char* name;
  const char* unit;
  const char* examples;
};

constexpr NamedDimension named[] = {
    {dimension::none, "number", "", "0.25"},
    {dimension::length, "length", "m", "\"10 mm\" or 0.01"},
    {dimension::time, "time", "s", "\"5 ms\" or 0.005"},
    {dimension::rate, "rate", "1/s", "\"10 1/s\" or 10"},
    {dimension::velocity, "velocity", "m/s", "\"0.1 mm/s\" or 1e-4"},
    {dimension::acceleration, "acceleration", "m/s2", "\"9.81 m/s2\" or 9.81"},
    {dimension::density, "density", "kg/m3", "\"1000 kg/m3\" or 1000"},
    {dimension::pressure, "pressure", "Pa", "\"17 MPa\" or 17e6"},
    {{0, 1, 0}, "mass", "kg", "\"2 kg\" or 2"},
    {{1, 1, -2}, "force", "N", "\"5 kN\" or 5000"},
    {{2, 1, -2}, "energy", "J", "\"3 J\" or 3"},
    {{2, 0, 0}, "area", "m2", "\"4 mm2\" or 4e-6"},
    {{3, 0, 0}, "volume", "m3", "\"8 mm3\" or 8e-9"},
};

const NamedDimension* find_named(const Dimension& d) {
  const auto* found =
      std::find_if(std::begin(named), std::end(named), [&](const NamedDimension& n) { return n.dimension == d; });
  return found == std::end(named) ? nullptr : found;
}

}  // namespace

std::string name_of(const Dimension& d) {
  const NamedDimension* found = find_named(d);
  return found != nullptr ? found->name : "quantity";
}

std::string si_unit(const Dimension& d) {
  if (const NamedDimension* found = find_named(d)) return found->unit;
  std::vector<std::string> parts;
  for (const auto& [symbol, n] : {std::pair{"m", d.length}, {"kg", d.mass}, {"s", d.time}})
    if (n != 0) parts.push_back(n == 1 ? symbol : fmt::format("{}{}", symbol, n));
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string examples_of(const Dimension& d) {
  const NamedDimension* found = find_named(d);
  return found != nullptr ? found->examples : fmt::format("\"1 {}\"", si_unit(d));
}

}  // namespace tessera
