#include <fmt/format.h>

#include "tessera/input/material_models.hpp"
#include "tessera/input/parameter_rows.hpp"

namespace tessera::input {

using enum Kind;
using enum Presence;

Rows body_rows() {
  return {
      {.key = "body",
       .kind = tables,
       .presence = required,
       .sentence = "A body: its shape, its particles and its material. Bodies must not touch."},
      {.key = "body.name",
       .kind = name,
       .presence = defaulted,
       .standard = "\"body\"",
       .sentence = "The name by which boundary, initial and probe mean it; no two bodies share one."},
      {.key = "body.shape",
       .kind = shape,
       .exactly_one = {"box", "polygon", "cylinder", "cone", "sphere", "ellipsoid", "torus", "file", "union",
                       "difference", "intersection"},
       .sentence =
           "The solid that the body fills; may be missing only when the particles come from a mesh. What is not "
           "made of boxes or of one polygon, or is turned, needs voronoi with boundary = \"consistent\"."},
      {.key = "body.particles",
       .kind = table,
       .presence = required,
       .exactly_one = {"counts", "spacing", "count", "file", "mesh"},
       .sentence = "Where the particles are."},
      {.key = "body.particles.arrangement",
       .kind = choice,
       .presence = defaulted,
       .choices = {"lattice", "random", "relaxed"},
       .standard = "\"lattice\"",
       .only_with = {"counts", "spacing", "count"},
       .sentence =
           "\"random\": no two particles near each other, else at random; \"relaxed\": each in the centroid of its "
           "Voronoi cell, as the solid cuts it. Both are for voronoi."},
      {.key = "body.particles.counts",
       .kind = counts,
       .range = between(1, 1e6),
       .flat = "1",
       .only_with = {"arrangement=lattice"},
       .sentence = "Lattice cells (voronoi) or vertices (delaunay) over the shape's bounding box, in x, y and z; unit "
                   "cells of two particles in bcc, four in fcc and hcp."},
      {.key = "body.particles.spacing",
       .kind = number,
       .dimension = dimension::length,
       .range = above(0),
       .sentence =
           "Cube root of the volume per particle (of the area, its square root, in two dimensions): the spacing of a "
           "cubic lattice, rounded so that whole cells fill the bounding box. In delaunay bodies of shapes other than "
           "boxes and polygons the length of the tetrahedra's edges, about."},
      {.key = "body.particles.count",
       .kind = integer,
       .range = between(1, 2e9),
       .sentence = "The number of particles; of lattices, as near as whole cells come to it."},
      {.key = "body.particles.lattice",
       .kind = choice,
       .presence = defaulted,
       .choices = {"cubic", "bcc", "fcc", "hcp"},
       .standard = "\"cubic\"",
       .only_with = {"arrangement=lattice"},
       .sentence = "The kind of lattice, clipped to the shape; all but cubic are for voronoi in three dimensions."},
      {.key = "body.particles.jitter",
       .kind = number,
       .presence = defaulted,
       .range = between(0, 0.49),
       .standard = "0",
       .only_with = {"arrangement=lattice"},
       .sentence = "Largest random move of a particle in each direction, in spacings."},
      {.key = "body.particles.seed",
       .kind = integer,
       .presence = defaulted,
       .range = at_least(0),
       .standard = "1",
       .only_with = {"counts", "spacing", "count"},
       .sentence = "Chooses what is random; the same seed gives the same particles."},
      {.key = "body.particles.iterations",
       .kind = integer,
       .presence = defaulted,
       .range = between(1, 1e6),
       .standard = "100",
       .only_with = {"arrangement=relaxed"},
       .sentence = "How often particles are moved to the centroids of their cells, at most."},
      {.key = "body.particles.tolerance",
       .kind = number,
       .presence = defaulted,
       .range = at_least(0),
       .standard = "0.01",
       .only_with = {"arrangement=relaxed"},
       .sentence = "Relaxation ends when the distances to the centroids, in spacings of their cells, have a root mean "
                   "square of this."},
      {.key = "body.particles.size",
       .kind = formula,
       .only_with = {"spacing", "count"},
       .sentence =
           "Local spacing, up to a factor, as a formula in X, Y and Z: fine where it is small; spacing or count "
           "sets how many particles there are in all. For arrangement = \"relaxed\", and for delaunay bodies "
           "in shapes other than boxes and polygons, where it is the length of edges."},
      {.key = "body.particles.mesher",
       .kind = choice,
       .choices = {"cgal", "gmsh"},
       .only_with = {"spacing", "count"},
       .sentence = "What fills a delaunay body in a shape other than boxes and polygons with tetrahedra: CGAL's Mesh_3 "
                   "(in builds with TESSERA_WITH_CGAL) or the program gmsh (on the search path). When missing, CGAL if "
                   "the build has it, else gmsh."},
      {.key = "body.particles.file",
       .kind = path,
       .sentence = "CSV file of particle positions in m with the header x,y,z, or x,y,z,radius for power cells."},
      {.key = "body.particles.radius",
       .kind = formula,
       .only_with = {"counts", "spacing", "count", "file"},
       .sentence = "Radius of each particle in m, a formula in X, Y and Z: cells become power cells (voronoi with "
                   "boundary = \"consistent\"), tetrahedra their dual, the regular triangulation (delaunay)."},
      {.key = "body.particles.mesh",
       .kind = path,
       .sentence = "Tetrahedral mesh, Gmsh .msh or VTK .vtu, whose vertices are the particles (delaunay only)."},
      {.key = "body.material", .kind = name, .presence = required, .sentence = "The name of a material."},
  };
}

namespace {

// Models that Young's modulus and Poisson's ratio describe.
std::vector<std::string> of_young() {
  return {"model=neo-hookean", "model=saint-venant-kirchhoff", "model=j2-plasticity"};
}

std::vector<std::string> models_in_words() {
  std::vector<std::string> meanings;
  for (const MaterialModel& m : material_models()) meanings.push_back(fmt::format("{}: {}", m.name, m.sentence));
  return meanings;
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const MaterialModel& m : material_models()) names.emplace_back(m.name);
  return names;
}

}  // namespace

Rows material_rows() {
  return {
      {.key = "material", .kind = tables, .presence = required, .sentence = "A material that bodies may be made of."},
      {.key = "material.name",
       .kind = name,
       .presence = required,
       .sentence = "The name by which bodies mean it; no two materials share one."},
      {.key = "material.model",
       .kind = choice,
       .presence = defaulted,
       .choices = model_names(),
       .meanings = models_in_words(),
       .standard = "\"neo-hookean\"",
       .sentence = "The law."},
      {.key = "material.young",
       .kind = number,
       .presence = required,
       .dimension = dimension::pressure,
       .range = above(0),
       .only_with = of_young(),
       .sentence = "Young's modulus at rest."},
      {.key = "material.poisson",
       .kind = number,
       .presence = required,
       .range = inside(-1, 0.5),
       .only_with = of_young(),
       .sentence = "Poisson's ratio at rest."},
      {.key = "material.yield_stress",
       .kind = number,
       .presence = required,
       .dimension = dimension::pressure,
       .range = above(0),
       .only_with = {"model=j2-plasticity"},
       .sentence = "Yield stress of the undeformed solid, for the Kirchhoff stress."},
      {.key = "material.hardening",
       .kind = number,
       .presence = defaulted,
       .dimension = dimension::pressure,
       .range = at_least(0),
       .standard = "0",
       .only_with = {"model=j2-plasticity"},
       .sentence = "Growth of the yield stress with the equivalent plastic strain."},
      {.key = "material.bulk",
       .kind = number,
       .presence = required,
       .dimension = dimension::pressure,
       .range = above(0),
       .only_with = {"model=mooney-rivlin", "model=ogden"},
       .sentence = "Bulk modulus K at rest."},
      {.key = "material.c10",
       .kind = number,
       .presence = required,
       .dimension = dimension::pressure,
       .only_with = {"model=mooney-rivlin"},
       .sentence = "Factor of the first invariant; the shear modulus at rest is 2 (c10 + c01)."},
      {.key = "material.c01",
       .kind = number,
       .presence = required,
       .dimension = dimension::pressure,
       .only_with = {"model=mooney-rivlin"},
       .sentence = "Factor of the second invariant."},
      {.key = "material.terms",
       .kind = tables,
       .presence = required,
       .only_with = {"model=ogden"},
       .sentence = "Terms of the energy, any number; the shear modulus at rest is half the sum of mu alpha."},
      {.key = "material.terms.mu",
       .kind = number,
       .presence = required,
       .dimension = dimension::pressure,
       .sentence = "Factor of the term."},
      {.key = "material.terms.alpha", .kind = number, .presence = required, .sentence = "Exponent of the term, not 0."},
      {.key = "material.density",
       .kind = number,
       .presence = required,
       .dimension = dimension::density,
       .range = above(0),
       .sentence = "Density in the reference state."},
      {.key = "material.contact",
       .kind = table,
       .presence = defaulted,
       .sentence =
           "Stiffness of the bonds between particles, which suppresses motion that the mean strain does not see."},
      {.key = "material.contact.normal",
       .kind = number,
       .presence = defaulted,
       .range = at_least(0),
       .standard = "1",
       .sentence = "Factor xi_n of the normal stiffness [D 60]."},
      {.key = "material.contact.tangential",
       .kind = number,
       .presence = defaulted,
       .range = at_least(0),
       .standard = "1",
       .sentence = "Factor xi_t of the tangential stiffness [D 60]."},
      {.key = "material.viscosity", .kind = table, .presence = defaulted, .sentence = "Artificial viscosity [D 61]."},
      {.key = "material.viscosity.linear",
       .kind = number,
       .presence = defaulted,
       .range = at_least(0),
       .standard = "0",
       .sentence = "Factor c1 of the linear part."},
      {.key = "material.viscosity.quadratic",
       .kind = number,
       .presence = defaulted,
       .range = at_least(0),
       .standard = "0",
       .sentence = "Factor c2 of the quadratic part."},
  };
}

}  // namespace tessera::input
