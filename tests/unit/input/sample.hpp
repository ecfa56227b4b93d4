#pragma once

#include <string>
#include <vector>

#include "tessera/input/case_file.hpp"

namespace tessera::sample {

/// A case that uses most keys. Line numbers count from one: "title" is on line 1.
inline const std::string text = R"(title = "Punch"
[method]
formulation = "voronoi"
boundary = "variational"
[[body]]
name = "block"
shape = { box = { min = [0, 0, 0], max = ["1 m", "50 cm", 0.1] } }
particles = { lattice = "cubic", counts = [21, 11, 3], jitter = 0.25, seed = 7 }
material = "rubber"
[[material]]
name = "rubber"
model = "neo-hookean"
young = "1 MPa"
poisson = 0.45
density = "1 g/cm3"
contact = { normal = 0.5, tangential = 2 }
viscosity = { linear = 0.1, quadratic = 0.2 }
[[initial]]
displacement = ["1e-4*X", 0, "2 mm"]
velocity = ["0", "0", "10*X/6"]
[[boundary]]
where = "y == max && X > 1/3"
displacement = [0, "-0.1*t", "free"]
[[boundary]]
where = ["-x", "+x"]
condition = "symmetric"
[[boundary]]
where = "-y"
traction = ["1 kPa", "2*t", 0]
[[boundary]]
where = "-z"
pressure = "2 bar"
[gravity]
acceleration = [0, 0, "-9.81 m/s2"]
[time]
end = "1500 ms"
step = "auto-spectral"
safety = 0.8
damping = "2 1/s"
[output]
fields = { format = "csv", every = "50 ms", quantities = ["displacement", "stress"], cells = true }
history = { every = "1 ms" }
checkpoint = { every = "1 min wall" }
[[probe]]
name = "punch"
type = "reaction"
where = "y == max"
[[probe]]
name = "tip"
type = "point"
at = [1, "20 cm", 0]
[[probe]]
name = "peak"
type = "maximum"
quantity = "von_mises"
[[reference]]
name = "exact"
displacement = ["1e-4*X", "0", "0"]
)";

/// `text` with the first occurrence of `from` replaced; an empty `from` appends.
inline std::string with(const std::string& from, const std::string& to) {
  std::string result = text;
  if (from.empty()) return result + to;
  const auto at = result.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the sample: " + from);
  return result.replace(at, from.size(), to);
}

inline Case read(const std::string& case_text, const std::vector<std::string>& overrides = {}) {
  return read_case_text(case_text, "dir/case.toml", overrides).value;
}

/// The message of the InputError that reading gives; empty when there is none.
inline std::string error_of(const std::string& case_text, const std::vector<std::string>& overrides = {}) {
  try {
    read(case_text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace tessera::sample
