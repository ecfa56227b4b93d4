#include "tessera/bench/layout.hpp"

namespace tessera {

namespace {

constexpr double local = sizeof(std::uint16_t), index = sizeof(Index), offset = sizeof(Offset), number = sizeof(double);
constexpr double vec3 = sizeof(Vec3), vector = sizeof(Double4), tensor = sizeof(Tensor);
constexpr double stiffness = sizeof(decltype(Tiles::area_over_length)::value_type);
constexpr double incoming = sizeof(Tiles::Incoming);
constexpr double row = 1.25 * local;  // place in the order, a quarter of a length

/// Sizes of the arrays relative to the number of particles.
struct PerParticle {
  explicit PerParticle(const System& s)
      : bonds(static_cast<double>(s.tiles.bonds) / static_cast<double>(s.particles())),
        slots(static_cast<double>(s.tiles.neighbour.size()) / static_cast<double>(s.particles())),
        rim(static_cast<double>(s.tiles.rim.size()) / static_cast<double>(s.particles())) {}

  double bonds, slots, rim;
};

constexpr double hessian = sizeof(Hessian), face = sizeof(CurvatureRows::FaceFactors);
constexpr double map = sizeof(SecondDerivatives::Map);

/// The rows of second-order integration: faces of all tiles, entries of rows.
struct CurvaturePerParticle {
  explicit CurvaturePerParticle(const System& s)
      : faces(static_cast<double>(s.second_order->rows.M.size()) / static_cast<double>(s.particles())),
        neighbours(static_cast<double>(s.second_order->rows.neighbours.size()) / static_cast<double>(s.particles())) {}

  double faces, neighbours;
};

/// What second-order integration streams beside the rest: each array once a sweep.
double second_order_bytes(const PerParticle& n, const CurvaturePerParticle& c) {
  const double nodes = 1.0 + n.rim, rows = c.neighbours * sizeof(CurvatureRows::Neighbour) + sizeof(CurvatureRows::Row);
  const double hessians = nodes * (tensor + vec3) + n.rim * index + rows + map + hessian;
  const double strain =
      nodes * (hessian + vec3) + n.rim * index + rows + c.faces * face + 2.0 * tensor + 2.0 * number + hessian;
  const double cubature = 2.0 * hessian + sizeof(Symmetric3) + number + 2.0 * tensor;
  const double moments = nodes * (tensor + hessian + 2.0 * vec3) + n.rim * index + rows + c.faces * face + map + vec3 +
                         c.neighbours * local + nodes * (tensor + local);
  const double forces = tensor + n.rim * tensor;
  return hessians + strain + cubature + moments + forces;
}

double second_order_memory_bytes(const PerParticle& n, const CurvaturePerParticle& c) {
  const double rows = c.neighbours * (sizeof(CurvatureRows::Neighbour) + local) + sizeof(CurvatureRows::Row) +
                      c.faces * face + map + vec3 + number + (1.0 + n.rim) * local;
  return rows + sizeof(Symmetric3) + 2.0 * hessian + 2.0 * tensor + n.rim * tensor + vec3 /* centroid */;
}

}  // namespace

double bytes_per_particle_step(const System& s) {
  const PerParticle n(s);
  const double strain = vector + row + number + n.rim * (index + vector) + n.slots * (local + vec3) + 2.0 * tensor;
  const double contact_and_stress = (1.0 + n.rim) * (vector + vec3 + tensor) + n.rim * index + row +
                                    n.slots * (local + stiffness) + number + 2.0 * vector;
  const double force = vec3 + n.slots * vec3 + n.bonds * incoming + (1.0 + n.rim) * local + n.rim * 2.0 * vector;
  const double rims = offset + n.rim * (index + vector);
  const double kick_and_drift = number + vector + 2.0 * vector + 2.0 * vector;
  const double cells = (1.0 + n.rim) * (vec3 + local) + sizeof(Mat3) + n.bonds * incoming + 2.0 * tensor +
                       n.rim * (2.0 * tensor + index) + offset + number;
  return strain + contact_and_stress + force + rims + kick_and_drift + (s.gradients ? cells : 0.0) +
         (s.second_order ? second_order_bytes(n, CurvaturePerParticle(s)) : 0.0);
}

double bytes_per_particle(const System& s) {
  const PerParticle n(s);
  const double bonds = n.bonds * incoming + n.slots * (vec3 + local + stiffness) + row;
  const double rims = n.rim * (2.0 * index + local + vector) + local + offset;
  const double constants = vec3 /* X */ + number /* V */ + vec3 /* B_aa */ + number /* m */;
  const double state = 2.0 * vector /* x, v */ + vector /* f */ + tensor /* F */;
  const double viscous = s.viscosity.empty() ? 0.0 : 2.0 * tensor + sizeof(ViscosityLaw);
  const double cells = vec3 /* centroid */ + sizeof(Mat3) + (1.0 + n.rim) * tensor;
  return bonds + rims + constants + state + viscous + (s.gradients ? cells : 0.0) +
         (s.second_order ? second_order_memory_bytes(n, CurvaturePerParticle(s)) : 0.0);
}

}  // namespace tessera
