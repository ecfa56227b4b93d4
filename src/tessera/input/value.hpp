#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tessera/base/error.hpp"

namespace tessera::input {

struct Entry;
struct Value;
using Array = std::vector<Value>;
using Table = std::vector<Entry>;

/// A value of a case file that remembers where it was written. Dates and times hold monostate: nothing wants them.
struct Value {
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> data;
  Origin origin;

  template <class T>
  const T* get_if() const {
    return std::get_if<T>(&data);
  }
};

/// A key of a table with its value; a table keeps the order in which its keys were written.
struct Entry {
  std::string key;
  Origin origin;  // of the key
  Value value;
};

/// The name that marks what came from the command line, in place of a file's.
inline const std::string command_line = "command line";

/// The value of `key`, or nullptr.
const Value* find(const Table& table, std::string_view key);
Value* find(Table& table, std::string_view key);

/// A value as one line of TOML. Numbers read back to the same bits.
std::string to_toml(const Value& value);

/// A whole file: tables become [headers], arrays of tables [[headers]], tables inside those stay inline.
std::string to_toml_document(const Table& root);

/// What a user calls it, for messages: "the string \"abc\"", "the number 3", "a table".
std::string describe(const Value& value);

}  // namespace tessera::input
