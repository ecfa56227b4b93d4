#include "tessera/bench/layout.hpp"

namespace tessera {

namespace {

constexpr double index = sizeof(Index), offset = sizeof(Offset), number = sizeof(double), vec3 = sizeof(Vec3);
constexpr double vector = sizeof(Double4), tensor = sizeof(Columns);

double bonds_per_particle(const System& s) {
  return static_cast<double>(s.d.bonds.size()) / static_cast<double>(s.particles());
}

}  // namespace

double bytes_per_particle_step(const System& s) {
  const double bonds = bonds_per_particle(s);
  const double strain = offset + vector + number + 2.0 * tensor + bonds * (index + vec3);
  const double stress =
      offset + vector + tensor + number + 2.0 * tensor + 2.0 * vector + vec3 + bonds * (index + number);
  const double force = offset + tensor + vec3 + 2.0 * vector + bonds * (index + vec3);
  const double kick_and_drift = number + vector + 2.0 * vector + 2.0 * vector;
  return strain + stress + force + kick_and_drift;
}

double bytes_per_particle(const System& s) {
  const double bonds = bonds_per_particle(s) * (index + 2.0 * vec3 + number) + offset;
  const double constants = vec3 /* X */ + number /* V */ + vec3 /* B_aa */ + number /* m */;
  const double state = 2.0 * vector /* x, v */ + vector /* f */ + 2.0 * tensor /* F, T */;
  const double viscous = s.viscosity.empty() ? 0.0 : 2.0 * tensor + sizeof(ViscosityLaw);
  return bonds + constants + state + viscous;
}

}  // namespace tessera
