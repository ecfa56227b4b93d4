// Writes a small result into the folder given as argument, for readers of other programs to open.
#include <cstdio>

#include "sample.hpp"
#include "tessera/output/fields.hpp"

namespace tessera {
namespace {

/// The octant cell around particle a of the sample.
Polyhedron octant(const Snapshot& s, std::size_t a) {
  Polyhedron cell;
  cell.particle = static_cast<Index>(a);
  for (int i = 0; i < 8; ++i)
    cell.vertices.push_back(s.reference_position[a] + Vec3{(i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5} * 0.5);
  cell.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return cell;
}

FieldsSpec spec(FieldFormat format, FieldPrecision precision = FieldPrecision::full) {
  FieldsSpec s;
  s.format = format;
  s.precision = precision;
  for (const Quantity& quantity : quantity_table()) s.quantities.emplace_back(quantity.name);
  return s;
}

void write_samples(const std::string& folder) {
  const Snapshot first = sample::snapshot();
  std::vector<Polyhedron> cells;
  for (std::size_t a = 0; a < 8; ++a) cells.push_back(octant(first, a));
  const std::vector<std::array<Index, 4>> tetrahedra = {{0, 1, 2, 4}, {3, 2, 1, 7}};
  for (const char* name : {"/tetrahedra", "/mixed"}) std::filesystem::create_directories(folder + name);
  FieldSeries hdf(folder, spec(FieldFormat::vtkhdf)), vtu(folder, spec(FieldFormat::vtu)),
      csv(folder, spec(FieldFormat::csv)), mixed(folder + "/mixed", spec(FieldFormat::vtkhdf, FieldPrecision::mixed));
  CellSeries voronoi(folder, spec(FieldFormat::vtkhdf), cells);
  CellSeries delaunay(folder + "/tetrahedra", spec(FieldFormat::vtkhdf), tetrahedra);
  for (const double time : {0.0, 0.25, 0.5}) {
    const Snapshot s = sample::snapshot(time);
    for (FieldSeries* series : {&hdf, &vtu, &csv, &mixed}) series->write(s);
    for (CellSeries* series : {&voronoi, &delaunay}) series->write(s);
  }
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    tessera::write_samples(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
