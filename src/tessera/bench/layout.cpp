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
constexpr double quadratic_fit = sizeof(QuadraticFit);

/// The rows of second-order integration: faces of all tiles, entries of rows.
struct CurvaturePerParticle {
  explicit CurvaturePerParticle(const System& s) {
    const CurvatureRows& r = s.second_order->rows;
    const auto each = [&](const auto& list) {
      return static_cast<double>(list.size()) / static_cast<double>(s.particles());
    };
    faces = each(r.M), neighbours = each(r.neighbours), others = each(r.others), far = each(r.far);
    means = each(r.means), averaged = each(s.second_order->averaged);
  }

  double rows() const {
    return neighbours * sizeof(CurvatureRows::Neighbour) + (others + far) * local + sizeof(CurvatureRows::Row);
  }
  double bonds() const { return (neighbours + others) * vec3; }

  double faces, neighbours, others, far, means, averaged;
};

/// What second-order integration streams beside contact, rims and motion: each array once a sweep.
double second_order_bytes(const PerParticle& n, const CurvaturePerParticle& c) {
  const double nodes = 1.0 + n.rim, rim = n.rim * index;
  const double first = nodes * (vector + vec3) + rim + c.rows() + c.bonds() + quadratic_fit + number + tensor + hessian;
  const double positions = nodes * (hessian + vec3) + rim + c.rows() + c.faces * face + 2.0 * tensor + number;
  const double means = c.averaged * (4.0 * hessian + index);
  const double cubature = 2.0 * hessian + sizeof(Symmetric3) + 2.0 * number + 2.0 * tensor;
  const double forces = nodes * (tensor + vec3) + rim + c.rows() + c.bonds() + c.faces * face + quadratic_fit + vec3 +
                        hessian + c.means * (index + hessian) + 2.0 * vector + n.rim * vector;
  return first + positions + means + cubature + forces;
}

double second_order_memory_bytes(const CurvaturePerParticle& c) {
  const double rows = c.rows() + c.bonds() + c.means * index + c.faces * face + quadratic_fit + number;
  return rows + sizeof(Symmetric3) + (2.0 + c.averaged) * hessian + tensor + vec3 /* centroid */;
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
  const double all = contact_and_stress + rims + kick_and_drift;
  if (s.second_order) return all + second_order_bytes(n, CurvaturePerParticle(s));
  return all + strain + force + (s.gradients ? cells : 0.0);
}

double bytes_per_particle(const System& s) {
  const PerParticle n(s);
  const double gradients = s.second_order ? 0.0 : n.bonds * incoming + n.slots * vec3 + (1.0 + n.rim) * local;
  const double bonds = gradients + n.slots * (local + stiffness) + row;
  const double rims = n.rim * (2.0 * index + vector) + offset;
  const double constants = vec3 /* X */ + number /* V */ + vec3 /* B_aa */ + number /* m */;
  const double state = 2.0 * vector /* x, v */ + vector /* f */ + tensor /* F */;
  const double viscous = s.viscosity.empty() ? 0.0 : 2.0 * tensor + sizeof(ViscosityLaw);
  const double cells = vec3 /* centroid */ + sizeof(Mat3) + (1.0 + n.rim) * tensor;
  return bonds + rims + constants + state + viscous + (s.gradients ? cells : 0.0) +
         (s.second_order ? second_order_memory_bytes(CurvaturePerParticle(s)) : 0.0);
}

}  // namespace tessera
