#include "tessera/output/cell_file.hpp"

#include "tessera/output/motion.hpp"

namespace tessera {

namespace {

constexpr std::uint8_t vtk_tetra = 10;
constexpr std::uint8_t vtk_polyhedron = 42;

/// The arrays in which VTK stores cells; points of polyhedra are not shared between cells.
struct CellArrays {
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> faces;         // per cell: number of faces, then per face: size, points
  std::vector<std::int64_t> face_offsets;  // end of each cell in `faces`
};

void append(CellArrays& arrays, const Polyhedron& cell) {
  const auto first = static_cast<std::int64_t>(arrays.connectivity.size());
  for (std::size_t i = 0; i < cell.vertices.size(); ++i)
    arrays.connectivity.push_back(first + static_cast<std::int64_t>(i));
  arrays.offsets.push_back(static_cast<std::int64_t>(arrays.connectivity.size()));
  arrays.faces.push_back(static_cast<std::int64_t>(cell.faces.size()));
  for (const std::vector<Index>& face : cell.faces) {
    arrays.faces.push_back(static_cast<std::int64_t>(face.size()));
    for (const Index vertex : face) arrays.faces.push_back(first + vertex);
  }
  arrays.face_offsets.push_back(static_cast<std::int64_t>(arrays.faces.size()));
}

std::vector<double> moved_vertices(const Snapshot& snapshot, const std::vector<Polyhedron>& cells) {
  std::vector<double> points;
  for (const Polyhedron& cell : cells)
    for (const Vec3& X : cell.vertices) {
      const Vec3 x = moved_point(snapshot, static_cast<std::size_t>(cell.particle), X);
      points.insert(points.end(), {x.x, x.y, x.z});
    }
  return points;
}

void write_topology(VtuFile& file, const CellArrays& arrays, std::uint8_t type) {
  const auto integers = [](const std::vector<std::int64_t>& v) { return std::span<const std::int64_t>(v); };
  const std::vector<std::uint8_t> types(arrays.offsets.size(), type);
  file.begin("Cells");
  file.array("connectivity", 1, integers(arrays.connectivity));
  file.array("offsets", 1, integers(arrays.offsets));
  file.array("types", 1, std::span<const std::uint8_t>(types));
  if (type == vtk_polyhedron) {
    file.array("faces", 1, integers(arrays.faces));
    file.array("faceoffsets", 1, integers(arrays.face_offsets));
  }
  file.end("Cells");
}

void write_points(VtuFile& file, const std::vector<double>& points) {
  file.begin("Points");
  file.array("Points", 3, points);
  file.end("Points");
}

std::vector<double> values_of_cells(const Quantity& quantity, const Snapshot& snapshot,
                                    const std::vector<Polyhedron>& cells) {
  const auto components = static_cast<std::size_t>(quantity.components());
  std::vector<double> values(cells.size() * components);
  for (std::size_t i = 0; i < cells.size(); ++i)
    evaluate(quantity, snapshot, static_cast<std::size_t>(cells[i].particle), values.data() + components * i);
  return values;
}

}  // namespace

void write_cells(const std::string& path, const Snapshot& snapshot, QuantityList quantities,
                 const std::vector<Polyhedron>& cells) {
  CellArrays arrays;
  for (const Polyhedron& cell : cells) append(arrays, cell);
  VtuFile file(path, snapshot.time, arrays.connectivity.size(), cells.size());
  write_points(file, moved_vertices(snapshot, cells));
  write_topology(file, arrays, vtk_polyhedron);
  file.begin("CellData");
  for (const Quantity* quantity : quantities)
    write_quantity(file, *quantity, values_of_cells(*quantity, snapshot, cells));
  file.end("CellData");
  file.finish();
}

void write_cells(const std::string& path, const Snapshot& snapshot, QuantityList quantities,
                 const std::vector<std::array<Index, 4>>& tetrahedra) {
  CellArrays arrays;
  for (const std::array<Index, 4>& tetrahedron : tetrahedra) {
    arrays.connectivity.insert(arrays.connectivity.end(), tetrahedron.begin(), tetrahedron.end());
    arrays.offsets.push_back(static_cast<std::int64_t>(arrays.connectivity.size()));
  }
  VtuFile file(path, snapshot.time, snapshot.position.size(), tetrahedra.size());
  write_points(file, evaluate(find_quantity("position", {}), snapshot));
  write_topology(file, arrays, vtk_tetra);
  file.begin("PointData");
  for (const Quantity* quantity : quantities) write_quantity(file, *quantity, evaluate(*quantity, snapshot));
  file.end("PointData");
  file.finish();
}

}  // namespace tessera
