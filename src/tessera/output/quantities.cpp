#include "tessera/output/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "tessera/base/text.hpp"

namespace tessera {

namespace {

Vec3 displacement(const Snapshot& s, std::size_t a) { return s.position[a] - s.reference_position[a]; }

double von_mises_of(const Snapshot& s, std::size_t a) { return von_mises(cauchy_stress(s, a)); }

double pressure(const Snapshot& s, std::size_t a) { return -trace(cauchy_stress(s, a)) / 3.0; }

double volume_ratio(const Snapshot& s, std::size_t a) { return determinant(s.deformation_gradient[a]); }

Index body(const Snapshot& s, std::size_t a) { return s.body[a]; }

Index material(const Snapshot& s, std::size_t a) { return s.material[a]; }

using S = Snapshot;
using enum Exactness;
using enum Variation;

const std::array<Quantity, 21> table = {{
    {"reference_position", "m", "Position in the undeformed state.", &S::reference_position, full, constant},
    {"position", "m", "Current position.", &S::position, full},
    {"displacement", "m", "Current minus reference position.", Quantity::Vector(displacement)},
    {"velocity", "m/s", "Velocity, at the time of the positions.", &S::velocity},
    {"force", "N", "Total force: internal, contact, external and reactions.", &S::force},
    {"internal_force", "N", "Force from the stress in the cells.", &S::internal_force},
    {"contact_force", "N", "Force from the bonds.", &S::contact_force},
    {"external_force", "N", "Force from tractions, gravity and damping.", &S::external_force},
    {"deformation_gradient", "-", "Mean deformation gradient F of the cell.", &S::deformation_gradient, full},
    {"first_piola_kirchhoff", "Pa", "First Piola-Kirchhoff stress P, viscous part included.",
     &S::first_piola_kirchhoff},
    {"cauchy_stress", "Pa", "Cauchy stress P F^T / J, viscous part included; \"stress\" is a second name.",
     Quantity::Tensor(cauchy_stress)},
    {"von_mises", "Pa", "Von Mises stress of the Cauchy stress.", Quantity::Scalar(von_mises_of)},
    {"pressure", "Pa", "Minus a third of the trace of the Cauchy stress.", Quantity::Scalar(pressure)},
    {"volume", "m3", "Volume of the cell in the undeformed state.", &S::volume, full, constant},
    {"J", "-", "Ratio of current to reference volume, det F.", Quantity::Scalar(volume_ratio), full},
    {"mass", "kg", "Mass of the particle.", &S::mass, full, constant},
    {"energy_density", "J/m3", "Strain energy per reference volume.", &S::energy_density},
    {"plastic_strain", "-", "Equivalent plastic strain.", &S::plastic_strain},
    {"body", "-", "Number of the body, in the order of the case file.", Quantity::Integer(body), full, constant},
    {"material", "-", "Number of the material, in the order of the case file.", Quantity::Integer(material), full,
     constant},
    {"particle_id", "-", "Number of the particle, in the order in which it was given or generated.",
     Quantity::Integer([](const Snapshot& s, std::size_t a) { return s.first + static_cast<Index>(a); }), full,
     constant},
}};

const std::array<std::string, 10> default_names = {"displacement",  "velocity",  "force",    "deformation_gradient",
                                                   "cauchy_stress", "von_mises", "pressure", "J",
                                                   "body",          "material"};

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const Quantity& quantity : table) names.emplace_back(quantity.name);
  return names;
}

void store(double value, double* out) { *out = value; }
void store(Index value, double* out) { *out = value; }
void store(const Vec3& value, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = value[i];
}
void store(const Mat3& value, double* out) { std::copy(value.m.begin(), value.m.end(), out); }
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Mat3) == 9 * sizeof(double), "as store() leaves them");

template <class Value>
constexpr bool is_held = std::is_member_object_pointer_v<Value>;

}  // namespace

int Quantity::components() const {
  constexpr std::array<int, 7> components_of_kind = {1, 1, 3, 9, 1, 3, 9};
  return components_of_kind[value.index()];
}

std::span<const Quantity> quantity_table() { return table; }

const Quantity& find_quantity(std::string_view name, const Origin& origin) {
  const std::string_view wanted = name == "stress" ? "cauchy_stress" : name;
  const auto found = std::find_if(table.begin(), table.end(), [&](const Quantity& q) { return q.name == wanted; });
  if (found != table.end()) return *found;
  const std::vector<std::string> known = known_names();
  std::vector<std::string> hints = known;
  hints.emplace_back("stress");
  throw InputError(origin, fmt::format("unknown quantity {}{}; known are {}", quoted(name), did_you_mean(name, hints),
                                       list_of(known, "and")));
}

std::vector<const Quantity*> field_quantities(std::span<const std::string> names, const Origin& origin) {
  std::vector<const Quantity*> chosen = {&find_quantity("reference_position", origin)};
  const auto add = [&](const std::string& name) {
    const Quantity* quantity = &find_quantity(name, origin);
    if (std::find(chosen.begin(), chosen.end(), quantity) == chosen.end()) chosen.push_back(quantity);
  };
  for (const std::string& name : names.empty() ? std::span<const std::string>(default_names) : names) add(name);
  return chosen;
}

std::span<const std::string_view> component_suffixes(const Quantity& quantity) {
  static constexpr std::array<std::string_view, 1> scalar = {""};
  static constexpr std::array<std::string_view, 3> vector = {"_x", "_y", "_z"};
  static constexpr std::array<std::string_view, 9> tensor = {"_xx", "_xy", "_xz", "_yx", "_yy",
                                                             "_yz", "_zx", "_zy", "_zz"};
  if (quantity.components() == 1) return scalar;
  if (quantity.components() == 3) return vector;
  return tensor;
}

void evaluate(const Quantity& quantity, const Snapshot& snapshot, std::size_t particle, double* out) {
  std::visit(
      [&](auto value) {
        if constexpr (is_held<decltype(value)>)
          store((snapshot.*value)[particle], out);
        else
          store(value(snapshot, particle), out);
      },
      quantity.value);
}

std::span<const std::byte> evaluate(const Quantity& quantity, const Snapshot& snapshot, std::vector<double>& computed) {
  return std::visit(
      [&](auto value) {
        if constexpr (is_held<decltype(value)>) {
          return std::as_bytes(std::span(snapshot.*value));
        } else {
          const auto components = static_cast<std::size_t>(quantity.components());
          computed.resize(snapshot.position.size() * components);
          for (std::size_t a = 0; a < snapshot.position.size(); ++a)
            store(value(snapshot, a), computed.data() + components * a);
          return std::as_bytes(std::span(std::as_const(computed)));
        }
      },
      quantity.value);
}

std::vector<double> evaluate(const Quantity& quantity, const Snapshot& snapshot) {
  std::vector<double> values;
  const std::span<const std::byte> bytes = evaluate(quantity, snapshot, values);
  if (values.empty()) {
    values.resize(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), bytes.size());
  }
  return values;
}

Mat3 cauchy_stress(const Snapshot& snapshot, std::size_t particle) {
  if (!snapshot.cauchy_stress.empty()) return snapshot.cauchy_stress[particle];
  const Mat3& F = snapshot.deformation_gradient[particle];
  return (1.0 / determinant(F)) * (snapshot.first_piola_kirchhoff[particle] * transpose(F));
}

void keep_cauchy_stresses(Snapshot& snapshot) {
  std::vector<Mat3> stresses = std::exchange(snapshot.cauchy_stress, {});  // those of another time
  stresses.resize(snapshot.position.size());
  for (std::size_t a = 0; a < stresses.size(); ++a) stresses[a] = cauchy_stress(snapshot, a);
  snapshot.cauchy_stress = std::move(stresses);
}

double von_mises(const Mat3& stress) {
  const double mean = trace(stress) / 3.0;
  const Mat3 s = stress - diagonal(mean, mean, mean);
  return std::sqrt(1.5 * contract(s, s));
}

}  // namespace tessera
