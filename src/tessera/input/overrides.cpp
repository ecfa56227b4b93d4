#include "tessera/input/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "tessera/base/text.hpp"
#include "tessera/input/toml_reader.hpp"

namespace tessera::input {

namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  parts.push_back(path.substr(begin));
  return parts;
}

void set_origin(Value& value, const Origin& origin) {
  value.origin = origin;
  if (auto* array = std::get_if<Array>(&value.data))
    for (Value& item : *array) set_origin(item, origin);
  if (auto* table = std::get_if<Table>(&value.data)) {
    for (Entry& e : *table) {
      e.origin = origin;
      e.origin.key += "." + e.key;
      set_origin(e.value, e.origin);
    }
  }
}

std::optional<std::size_t> index_in(const std::string& part) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (error != std::errc() || end != part.data() + part.size()) return std::nullopt;
  return index;
}

/// Of a list that the file does not have, such as [[initial]], also the next item, which is new.
Value& item_of(Array& array, const std::string& part, const Origin& origin) {
  const std::optional<std::size_t> index = index_in(part);
  const bool is_new = array.empty() || array.back().origin.file == command_line;
  if (index && *index == array.size() && is_new) array.push_back({Table{}, origin});
  if (index && *index < array.size()) return array[*index];
  throw InputError(origin, fmt::format("{} is no item of a list of {}; count from 0, as in body.0.name", quoted(part),
                                       array.size()));
}

/// `path` is the path of the child; a new one is `made`.
Value& child_of(Value& parent, const std::string& part, const std::string& path, const Origin& origin,
                decltype(Value::data) made) {
  if (auto* array = std::get_if<Array>(&parent.data)) return item_of(*array, part, origin);
  auto* table = std::get_if<Table>(&parent.data);
  if (table == nullptr)
    throw InputError(origin, fmt::format("{} lies inside {}, which is no table", quoted(part), describe(parent)));
  if (Value* found = find(*table, part)) return *found;
  Origin created = origin;
  created.key = path;
  table->push_back({part, created, {std::move(made), created}});
  return table->back().value;
}

// The key now counts as given on the command line, also when it replaces one of the file.
void mark_key(Value& parent, const std::string& part, const Origin& origin) {
  if (auto* table = std::get_if<Table>(&parent.data))
    for (Entry& e : *table)
      if (e.key == part) e.origin = origin;
}

void apply(Value& root, const std::string& text) {
  const auto equals = text.find('=');
  const std::string key(trimmed(text.substr(0, equals)));
  const Origin origin{command_line, 0, 0, key};
  const auto parts = split(key);
  if (equals == std::string::npos || std::find(parts.begin(), parts.end(), "") != parts.end())
    throw InputError({command_line, 0, 0, ""},
                     fmt::format("--set {}: expected key=value, as in time.end=0.1", quoted(text)));
  Value* place = &root;
  Value* parent = nullptr;
  std::string path;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    path.append(path.empty() ? "" : ".").append(parts[i]);
    parent = place;
    const bool holds_items = i + 1 < parts.size() && index_in(parts[i + 1]);
    if (holds_items)
      place = &child_of(*parent, parts[i], path, origin, Array{});
    else
      place = &child_of(*parent, parts[i], path, origin, Table{});
  }
  mark_key(*parent, parts.back(), origin);
  const std::string value(trimmed(text.substr(equals + 1)));
  *place = read_toml_value(value).value_or(Value{value, origin});
  set_origin(*place, origin);
}

}  // namespace

void apply_overrides(Value& root, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) apply(root, text);
}

}  // namespace tessera::input
