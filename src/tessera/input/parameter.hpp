#pragma once

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/formula.hpp"
#include "tessera/base/units.hpp"

namespace tessera::input {

/// What kind of value a key takes.
enum class Kind {
  table,             // a table whose keys have rows of their own
  tables,            // an array of such tables
  shape,             // a table that describes a shape, with the rows of body.shape
  shapes,            // an array of those
  flag,              // true or false
  integer,           //
  number,            // with the row's dimension
  angle,             // in degrees, or with a unit
  text,              //
  name,              // a text without quotes, commas and control characters
  path,              // of a file, relative to the case file
  choice,            // one of the row's words
  step,              // one of the row's words, or a time
  interval,          // a time, or a wall-clock time like "60 s wall"
  vector,            // three numbers
  factors,           // three numbers, or one for all three
  counts,            // three integers
  points,            // pairs of numbers
  words,             // a list of strings
  selection,         // a string or a list of strings
  formula,           // a number or a formula
  formulas,          // three of those
  partial_formulas,  // three of those, or "free"
  formula_rows,      // three rows of three formulas
};

/// Is the key needed? A defaulted table is filled with the defaults of its keys.
enum class Presence { required, optional, defaulted };

/// What happens to a key that is given where it has no effect: an error, or a note and nothing more.
enum class Misplaced { refused, ignored };

/// An interval of allowed numbers. Ends that are `open` do not belong to it.
struct Range {
  enum class End { closed, open };
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  End lower = End::closed;
  End upper = End::closed;

  bool contains(double x) const;
  /// "> 0", ">= 0 and <= 0.49"; empty when everything is allowed.
  std::string text() const;
};

/// One row of the input table: everything that is known about a key. Parser, unit conversion, messages, `describe`, the
/// generated reference and the effective case file read it.
struct Parameter {
  std::string key;  // path without the numbers of array items: "body.particles.jitter"
  Kind kind = Kind::table;
  Presence presence = Presence::optional;
  Dimension dimension = {};
  Range range = {};
  std::vector<std::string> choices = {};
  std::vector<std::string> meanings = {};  // of the choices, where the sentence does not say all: "nodal: at ..."
  std::string standard = {};               // the default, as TOML
  // Conditions as in only_with, and the default beside each of them.
  std::vector<std::pair<std::string, std::string>> standard_beside = {};
  std::string flat = {};                    // with dimension = 2, as TOML: the third component, or the default
  std::vector<std::string> only_with = {};  // has effect beside one of these: "counts", "type=point"
  Misplaced misplaced = Misplaced::refused;
  std::vector<std::string> exactly_one = {};  // tables: one of these keys is needed, the others must be absent
  std::vector<std::string> together = {};     // of those the keys that may stand together
  FormulaNames names = FormulaNames::point;   // formulas: what they know
  std::string sentence = {};
};

/// All rows, sections and keys in the order of the reference.
std::span<const Parameter> parameters();

/// The row of a key path without numbers, or nullptr.
const Parameter* find_parameter(const std::string& key);

/// The keys directly inside a table ("" is the file itself), in order.
std::vector<const Parameter*> parameters_in(const std::string& table);

/// The last part of a key path: "jitter".
std::string last_part(const std::string& key);

/// What a value must be: "a length in m, as in \"10 mm\" or 0.01; allowed: > 0".
std::string expectation(const Parameter& parameter);

/// "counts", "type = \"point\"".
std::string condition_text(const std::string& condition);

/// What a key needs beside it to have an effect: "counts or spacing", "type = \"point\""; often empty.
std::string conditions_text(const Parameter& parameter);

}  // namespace tessera::input
