#include <numeric>
#include <vector>

#include "tessera/output/field_file.hpp"

namespace tessera {

void write_quantity(VtuFile& file, const Quantity& quantity, std::span<const double> values) {
  if (!quantity.is_integer()) return file.array(quantity.name, quantity.components(), values);
  const std::vector<std::int32_t> integers(values.begin(), values.end());
  file.array(quantity.name, quantity.components(), std::span<const std::int32_t>(integers));
}

void write_field_vtu(const std::string& path, const Snapshot& snapshot, QuantityList quantities) {
  const std::size_t n = snapshot.position.size();
  VtuFile file(path, snapshot.time, n, n);
  file.begin("Points");
  file.array("Points", 3, evaluate(find_quantity("position", {}), snapshot));
  file.end("Points");

  constexpr std::uint8_t vtk_vertex = 1;
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.begin("Cells");
  file.array("connectivity", 1, std::span<const std::int64_t>(numbers));
  std::iota(numbers.begin(), numbers.end(), 1);
  file.array("offsets", 1, std::span<const std::int64_t>(numbers));
  file.array("types", 1, std::span<const std::uint8_t>(std::vector<std::uint8_t>(n, vtk_vertex)));
  file.end("Cells");

  file.begin("PointData");
  for (const Quantity* quantity : quantities) write_quantity(file, *quantity, evaluate(*quantity, snapshot));
  file.end("PointData");
  file.finish();
}

}  // namespace tessera
