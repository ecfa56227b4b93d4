#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/output/snapshot.hpp"

namespace tessera {

/// How a frame of `precision = "mixed"` holds a quantity: in single precision what stands for itself, in double what
/// matters by small differences (from the undeformed state, or among neighbours).
enum class Exactness { single, full };

/// Whether frames of one run can differ in a quantity.
enum class Variation { constant, changing };

/// A named value of a particle that fields and probes can hold.
struct Quantity {
  using Scalar = double (*)(const Snapshot&, std::size_t particle);
  using Integer = Index (*)(const Snapshot&, std::size_t particle);
  using Vector = Vec3 (*)(const Snapshot&, std::size_t particle);
  using Tensor = Mat3 (*)(const Snapshot&, std::size_t particle);
  // What snapshots hold as it is:
  using Scalars = std::vector<double> Snapshot::*;
  using Vectors = std::vector<Vec3> Snapshot::*;
  using Tensors = std::vector<Mat3> Snapshot::*;

  std::string_view name;
  std::string_view unit;     // "-" for pure numbers
  std::string_view meaning;  // one sentence
  std::variant<Scalar, Integer, Vector, Tensor, Scalars, Vectors, Tensors> value;
  Exactness exactness = Exactness::single;
  Variation variation = Variation::changing;

  /// 1, 3 (x, y, z) or 9 (row by row).
  int components() const;
  bool is_integer() const { return std::holds_alternative<Integer>(value); }
};

/// Every quantity, in the order in which files hold them.
std::span<const Quantity> quantity_table();

/// The quantity called `name` ("stress" is a second name of cauchy_stress). Throws InputError at `origin` for an
/// unknown name, with the nearest known one and the list of all.
const Quantity& find_quantity(std::string_view name, const Origin& origin);

/// What a field file holds: reference_position and `names`, each once, in this order; the default set when
/// `names` is empty. Throws InputError as find_quantity() does.
std::vector<const Quantity*> field_quantities(std::span<const std::string> names, const Origin& origin);

/// "_x", "_y", "_z" for vectors, "_xx", "_xy" .. "_zz" for tensors, one empty string for scalars.
std::span<const std::string_view> component_suffixes(const Quantity& quantity);

/// The components of `quantity` of one particle. `out` has quantity.components() entries.
void evaluate(const Quantity& quantity, const Snapshot& snapshot, std::size_t particle, double* out);

/// The components of all particles, particle by particle.
std::vector<double> evaluate(const Quantity& quantity, const Snapshot& snapshot);
/// The same as the bytes of these numbers: those in the snapshot, if it holds them, or else those of `computed`.
std::span<const std::byte> evaluate(const Quantity& quantity, const Snapshot& snapshot, std::vector<double>& computed);

/// The Cauchy stress P F^T / J of a particle [Pa].
Mat3 cauchy_stress(const Snapshot& snapshot, std::size_t particle);
/// Computes it for all particles, for quantities that come from it.
void keep_cauchy_stresses(Snapshot& snapshot);

/// The von Mises stress sqrt(3/2 s : s), s the deviator of `stress` [Pa].
double von_mises(const Mat3& stress);

}  // namespace tessera
