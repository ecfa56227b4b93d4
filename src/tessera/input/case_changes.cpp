#include "tessera/input/case_changes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/input/toml_reader.hpp"
#include "tessera/input/value.hpp"

namespace tessera {

namespace {

using input::Array;
using input::Entry;
using input::Table;
using input::Value;

class Comparison {
 public:
  void compare(const Value* before, const Value* now, const std::string& path) {
    if (both_are<Table>(before, now)) return compare_tables(*before->get_if<Table>(), *now->get_if<Table>(), path);
    if (both_are<Array>(before, now)) return compare_arrays(*before->get_if<Array>(), *now->get_if<Array>(), path);
    const std::string was = text_of(before), is = text_of(now);
    if (was != is) lines.push_back(fmt::format("{} was {}, is {}", path, was, is));
  }

  std::vector<std::string> lines;

 private:
  template <class T>
  static bool both_are(const Value* before, const Value* now) {
    return before != nullptr && now != nullptr && before->get_if<T>() != nullptr && now->get_if<T>() != nullptr;
  }
  static std::string text_of(const Value* value) { return value == nullptr ? "missing" : to_toml(*value); }
  static std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  void compare_tables(const Table& before, const Table& now, const std::string& path) {
    for (const Entry& e : before) compare(&e.value, find(now, e.key), joined(path, e.key));
    for (const Entry& e : now)
      if (find(before, e.key) == nullptr) compare(nullptr, &e.value, joined(path, e.key));
  }

  void compare_arrays(const Array& before, const Array& now, const std::string& path) {
    for (std::size_t i = 0; i < std::max(before.size(), now.size()); ++i)
      compare(i < before.size() ? &before[i] : nullptr, i < now.size() ? &now[i] : nullptr,
              joined(path, std::to_string(i)));
  }
};

}  // namespace

std::vector<std::string> case_changes(const std::string& before, const std::string& name_before,
                                      const std::string& now) {
  const Value first = input::read_toml(before, name_before), second = input::read_toml(now, "the present case");
  Comparison comparison;
  comparison.compare(&first, &second, "");
  return comparison.lines;
}

}  // namespace tessera
