#include "tessera/input/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "tessera/base/text.hpp"

namespace tessera::input {

namespace {

Origin origin_at(const toml::source_region& source, const std::string& file, const std::string& key) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column), key};
}

std::string joined(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

/// Copies a tree of the TOML library into ours, keys in the order in which they were written.
class Copier {
 public:
  explicit Copier(const std::string& file) : file_(file) {}

  Value copy(const toml::node& node, const std::string& path) const {
    Value value;
    value.origin = origin_at(node.source(), file_, path);
    if (const auto* table = node.as_table()) {
      value.data = copy_table(*table, path);
    } else if (const auto* array = node.as_array()) {
      Array items;
      for (const toml::node& item : *array) items.push_back(copy(item, joined(path, std::to_string(items.size()))));
      value.data = std::move(items);
    } else if (const auto* text = node.as_string()) {
      value.data = text->get();
    } else if (const auto* integer = node.as_integer()) {
      value.data = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
      value.data = number->get();
    } else if (const auto* flag = node.as_boolean()) {
      value.data = flag->get();
    }
    return value;
  }

 private:
  Table copy_table(const toml::table& table, const std::string& path) const {
    Table entries;
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      const std::string full = joined(path, name);
      entries.push_back({name, origin_at(key.source(), file_, full), copy(node, full)});
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.origin.line, a.origin.column) < std::pair(b.origin.line, b.origin.column);
    });
    return entries;
  }

  std::string file_;
};

}  // namespace

Value read_toml(const std::string& text, const std::string& file) {
  try {
    const toml::table root = toml::parse(text, file);
    Value value = Copier(file).copy(root, "");
    value.origin = {file, 1, 1, ""};
    return value;
  } catch (const toml::parse_error& error) {
    // The library's texts may quote the file; line ends in them would break the rule of one line an error.
    std::string what(error.description());
    std::replace_if(
        what.begin(), what.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    if (what.ends_with("could not determine value type")) what += "; a string needs quotes";
    throw InputError(origin_at(error.source(), file, ""), fmt::format("not valid TOML: {}", what));
  }
}

std::optional<Value> read_toml_value(const std::string& text) {
  try {
    const toml::table root = toml::parse("value = " + text);
    if (root.size() != 1) return std::nullopt;
    return Copier("").copy(*root.get("value"), "");
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace tessera::input
