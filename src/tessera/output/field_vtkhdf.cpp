#include <array>
#include <numeric>
#include <vector>

#include "tessera/output/field_file.hpp"
#include "tessera/output/hdf5_image.hpp"

namespace tessera {

namespace {

void write_vertices(Hdf5Image& file, const Snapshot& snapshot) {
  constexpr std::uint8_t vtk_vertex = 1;
  const std::size_t n = snapshot.position.size();
  const std::array<std::int64_t, 1> count = {static_cast<std::int64_t>(n)};
  for (const char* name : {"/VTKHDF/NumberOfPoints", "/VTKHDF/NumberOfCells", "/VTKHDF/NumberOfConnectivityIds"})
    file.array(name, count);
  file.array("/VTKHDF/Points", evaluate(find_quantity("position", {}), snapshot), 3);
  std::vector<std::int64_t> numbers(n + 1);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.array("/VTKHDF/Offsets", numbers);
  numbers.pop_back();
  file.array("/VTKHDF/Connectivity", numbers);
  file.array("/VTKHDF/Types", std::vector<std::uint8_t>(n, vtk_vertex));
}

void write_quantity(Hdf5Image& file, const Quantity& quantity, const std::vector<double>& values) {
  const std::string name = "/VTKHDF/PointData/" + std::string(quantity.name);
  if (quantity.is_integer())
    file.array(name, std::vector<std::int32_t>(values.begin(), values.end()));
  else
    file.array(name, values, quantity.components());
}

}  // namespace

void write_field_vtkhdf(const std::string& path, const Snapshot& snapshot, QuantityList quantities) {
  constexpr std::array<std::int64_t, 2> version = {1, 0};
  Hdf5Image file(Hdf5Storage::compressed);
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", version);
  file.attribute("/VTKHDF", "Type", "UnstructuredGrid");
  write_vertices(file, snapshot);
  file.group("/VTKHDF/PointData");
  for (const Quantity* quantity : quantities) write_quantity(file, *quantity, evaluate(*quantity, snapshot));
  file.group("/VTKHDF/FieldData");
  file.array("/VTKHDF/FieldData/TimeValue", std::array<double, 1>{snapshot.time});
  file.save(path, Durability::process);
}

}  // namespace tessera
