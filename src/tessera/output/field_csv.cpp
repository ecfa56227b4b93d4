#include <fmt/format.h>

#include <array>
#include <iterator>

#include "tessera/output/field_file.hpp"

namespace tessera {

namespace {

std::string header(QuantityList quantities) {
  std::string text;
  for (const Quantity* quantity : quantities)
    for (const std::string_view suffix : component_suffixes(*quantity))
      text += fmt::format("{}{}{}[{}]", text.empty() ? "" : ",", quantity->name, suffix, quantity->unit);
  return text + "\n";
}

void append_row(fmt::memory_buffer& text, const Snapshot& snapshot, QuantityList quantities, std::size_t particle) {
  std::array<double, 9> values{};
  const std::size_t start = text.size();
  for (const Quantity* quantity : quantities) {
    evaluate(*quantity, snapshot, particle, values.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(quantity->components()); ++i)
      fmt::format_to(std::back_inserter(text), "{}{:.17g}", text.size() == start ? "" : ",", values[i]);
  }
  text.push_back('\n');
}

}  // namespace

void write_field_csv(const std::string& path, const Snapshot& snapshot, QuantityList quantities) {
  OutputFile file(path);
  file.write(header(quantities));
  fmt::memory_buffer row;
  for (std::size_t a = 0; a < snapshot.position.size(); ++a) {
    row.clear();
    append_row(row, snapshot, quantities, a);
    file.write({row.data(), row.size()});
  }
  file.commit(Durability::process);
}

}  // namespace tessera
