#include "tessera/input/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tessera/base/text.hpp"

namespace tessera::input {

namespace {

bool is_bare(const std::string& key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  });
}

std::string key_text(const std::string& key) { return is_bare(key) ? key : quoted(key); }

struct Printer {
  std::string operator()(std::monostate) const { return "a date or time"; }
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(std::int64_t i) const { return fmt::format("{}", i); }
  std::string operator()(double d) const { return fmt::format("{}", d); }
  std::string operator()(const std::string& s) const { return quoted(s); }
  std::string operator()(const Array& a) const {
    std::string text = "[";
    for (const Value& v : a) text.append(text.size() > 1 ? ", " : "").append(to_toml(v));
    return text + "]";
  }
  std::string operator()(const Table& t) const {
    std::string text;
    for (const Entry& e : t)
      text += fmt::format("{} {} = {}", text.empty() ? "" : ",", key_text(e.key), to_toml(e.value));
    return t.empty() ? "{}" : "{" + text + " }";
  }
};

bool is_array_of_tables(const Value& value) {
  const Array* array = value.get_if<Array>();
  return array != nullptr && !array->empty() &&
         std::all_of(array->begin(), array->end(), [](const Value& v) { return v.get_if<Table>() != nullptr; });
}

std::string lines_of(const Table& table) {
  std::string text;
  for (const Entry& e : table) text += fmt::format("{} = {}\n", key_text(e.key), to_toml(e.value));
  return text;
}

}  // namespace

const Value* find(const Table& table, std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.key == key; });
  return found == table.end() ? nullptr : &found->value;
}

Value* find(Table& table, std::string_view key) {
  return const_cast<Value*>(find(static_cast<const Table&>(table), key));
}

std::string to_toml(const Value& value) { return std::visit(Printer{}, value.data); }

std::string to_toml_document(const Table& root) {
  std::string top, rest;
  for (const Entry& e : root) {
    if (const Table* table = e.value.get_if<Table>()) {
      rest += fmt::format("\n[{}]\n{}", key_text(e.key), lines_of(*table));
    } else if (is_array_of_tables(e.value)) {
      for (const Value& item : *e.value.get_if<Array>())
        rest += fmt::format("\n[[{}]]\n{}", key_text(e.key), lines_of(*item.get_if<Table>()));
    } else {
      top += fmt::format("{} = {}\n", key_text(e.key), to_toml(e.value));
    }
  }
  return top + rest;
}

std::string describe(const Value& value) {
  constexpr std::size_t longest = 60;
  std::string text = to_toml(value);
  if (text.size() > longest) text = text.substr(0, longest - 3) + "...";
  // A real number must not look like an integer when it is refused for not being one.
  if (value.get_if<double>() != nullptr && text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  if (value.get_if<std::string>() != nullptr) return "the string " + text;
  if (value.get_if<std::int64_t>() != nullptr || value.get_if<double>() != nullptr) return "the number " + text;
  if (value.get_if<Array>() != nullptr) return "the list " + text;
  if (value.get_if<Table>() != nullptr) return "the table " + text;
  return text;
}

}  // namespace tessera::input
