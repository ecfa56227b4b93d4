#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/dynamics/time_spec.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/shape.hpp"
#include "tessera/laws/material.hpp"
#include "tessera/loads/boundary_condition.hpp"
#include "tessera/mechanics/volume_average.hpp"
#include "tessera/output/output_spec.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

enum class Formulation { delaunay, voronoi };

/// How the cells' faces on the boundary move, theory: consistent (ours), [V 43] and [V 42].
enum class BoundaryTreatment { consistent, variational, quasi_static };

/// Where the strain energy of a cell is taken: at its mean deformation (the papers), or at six points of it, between
/// which the deformation varies as between its neighbours, or as second derivatives of the motion say.
enum class Integration { nodal, cell, second_order };

/// As the case file says it.
inline std::string name_of(Integration i) {
  if (i == Integration::nodal) return "nodal";
  return i == Integration::cell ? "cell" : "second-order";
}

/// The [method] table.
struct MethodSpec {
  Formulation formulation = Formulation::voronoi;
  BoundaryTreatment boundary = BoundaryTreatment::consistent;
  Integration integration = Integration::nodal;
  Tetrahedralization tetrahedra = Tetrahedralization::automatic;
  Volumetric volumetric = Volumetric::standard;
  int dimension = 3;  // 2: plane strain, a slab one cell and one metre thick
};

/// One [[body]] entry. `shape` may be missing only when the particles come from a mesh file.
struct BodySpec {
  std::string name;
  std::optional<Shape> shape;
  ParticleSpec particles;
  Index material = 0;  // index into Case::materials
  Origin origin;
};

/// A case: everything that a run depends on, in SI units.
struct Case {
  std::string title;
  std::string file;       // the path as given
  std::string effective;  // the case as TOML text with all defaults filled in
  MethodSpec method;
  std::vector<BodySpec> bodies;
  std::vector<Material> materials;
  std::vector<InitialCondition> initial;
  std::vector<BoundaryCondition> boundary;
  Vec3 gravity;  // [m/s2]
  TimeSpec time;
  OutputSpec output;
  std::vector<ProbeSpec> probes;
  std::vector<ReferenceSpec> references;
};

}  // namespace tessera
