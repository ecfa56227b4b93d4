#include "tessera/input/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/text.hpp"
#include "tessera/input/parameter.hpp"
#include "tessera/output/quantities.hpp"

namespace tessera {

namespace {

using input::Kind;
using input::Parameter;
using input::Presence;

bool is_section(const Parameter& p) { return p.key.find('.') == std::string::npos && p.kind != Kind::text; }

/// "[time]", "[[body]]", "body.name".
std::string heading(const Parameter& p) {
  if (!is_section(p)) return p.key;
  return p.kind == Kind::tables ? fmt::format("[[{}]]", p.key) : fmt::format("[{}]", p.key);
}

std::string basic_presence(const Parameter& p) {
  if (p.presence == Presence::required) return "required";
  if (p.standard.empty()) return "optional";
  std::vector<std::string> others;
  for (const auto& [condition, standard] : p.standard_beside)
    others.push_back(fmt::format("{} with {}", standard, input::condition_text(condition)));
  return fmt::format("default {}{}", p.standard, others.empty() ? "" : fmt::format(" ({})", fmt::join(others, "; ")));
}

std::string presence_text(const Parameter& p) {
  std::vector<std::string> parts = {basic_presence(p)};
  if (!p.exactly_one.empty()) parts.push_back(fmt::format("exactly one of {}", list_of(p.exactly_one)));
  if (!p.only_with.empty()) parts.push_back(fmt::format("only with {}", input::conditions_text(p)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string row_text(const Parameter& p) {
  std::string meanings;
  for (const std::string& meaning : p.meanings) meanings += fmt::format("      {}\n", meaning);
  return fmt::format("{}\n    {}\n{}    {}; {}\n", heading(p), p.sentence, meanings, input::expectation(p),
                     presence_text(p));
}

std::string quantities_text() {
  std::string text = "\nQuantities\n";
  for (const Quantity& q : quantity_table()) text += fmt::format("  {} [{}]: {}\n", q.name, q.unit, q.meaning);
  return text;
}

/// Bars end a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

constexpr const char* table_head = "\n| key | value | presence | meaning |\n|---|---|---|---|\n";

std::string section_markdown(const Parameter& p) {
  return fmt::format("\n## {}\n\n{} ({})\n{}", heading(p), p.sentence, presence_text(p), table_head);
}

std::string row_markdown(const Parameter& p) {
  std::string sentence = p.sentence;
  for (const std::string& meaning : p.meanings) sentence += "<br>" + meaning;
  return fmt::format("| `{}` | {} | {} | {} |\n", p.key, cell(input::expectation(p)), cell(presence_text(p)),
                     cell(sentence));
}

std::string without_numbers(const std::string& key) {
  std::string result;
  std::size_t begin = 0;
  while (begin <= key.size()) {
    const auto dot = std::min(key.find('.', begin), key.size());
    const std::string part = key.substr(begin, dot - begin);
    const bool number =
        !part.empty() && std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); });
    if (!number) result.append(result.empty() ? "" : ".").append(part);
    begin = dot + 1;
  }
  return result;
}

template <class Wanted>
std::string rows_where(Wanted wanted) {
  std::string text;
  for (const Parameter& p : input::parameters())
    if (wanted(p)) text += row_text(p);
  return text;
}

[[noreturn]] void fail_unknown(const std::string& key) {
  std::vector<std::string> all, last_parts;
  for (const Parameter& p : input::parameters()) {
    all.push_back(p.key);
    last_parts.push_back(input::last_part(p.key));
  }
  std::string hint = did_you_mean(key, all);
  if (hint.empty()) hint = did_you_mean(key, last_parts);
  throw UsageError(fmt::format("unknown key {}{}; `tessera describe` lists all keys", quoted(key), hint));
}

}  // namespace

std::string describe_input() {
  std::string text =
      "Numbers are in SI units; strings may carry a unit, as in \"17 MPa\". Formulas know t, X, Y, Z, pi.\n";
  for (const Parameter& p : input::parameters()) text.append(is_section(p) ? "\n" : "").append(row_text(p));
  return text + quantities_text();
}

std::string describe_key(const std::string& key) {
  std::string wanted = without_numbers(key);
  std::erase_if(wanted, [](char c) { return c == '[' || c == ']'; });
  if (wanted.empty()) fail_unknown(key);
  const std::string beginning = fmt::format("{}.", wanted);
  std::string text = rows_where([&](const Parameter& p) { return p.key == wanted || p.key.starts_with(beginning); });
  const std::string ending = fmt::format(".{}", wanted);
  if (text.empty()) text = rows_where([&](const Parameter& p) { return p.key.ends_with(ending); });
  if (text.empty()) fail_unknown(key);
  if (wanted.ends_with("quantities") || wanted.ends_with("quantity")) text += quantities_text();
  return text;
}

std::string describe_input_markdown() {
  std::string text =
      "# Input reference\n\nWritten by `tessera describe --markdown` from the table that the program reads; do not "
      "edit.\n\n"
      "A case is a TOML file. Numbers are in SI units; a string may carry a unit, as in `\"17 MPa\"`, `\"0.1 mm/s\"` "
      "or\n"
      "`\"1000 kg/m3\"`. Formulas are strings in `t`, `X`, `Y`, `Z` (material position) with the functions\n"
      "`sin cos tan asin acos atan sinh cosh tanh exp log log10 sqrt abs floor ceil min max pow atan2`, the constant "
      "`pi`,\n"
      "`+ - * / ^`, comparisons, `&&`, `||` and `? :`; their values are in SI units.\n";
  text += fmt::format("\n## The file itself\n{}", table_head);
  for (const Parameter& p : input::parameters()) text += is_section(p) ? section_markdown(p) : row_markdown(p);
  text +=
      "\n## Quantities\n\nFor `output.fields.quantities` and `probe.quantity`.\n\n| name | unit | meaning "
      "|\n|---|---|---|\n";
  for (const Quantity& q : quantity_table())
    text += fmt::format("| `{}` | {} | {} |\n", q.name, q.unit, cell(std::string(q.meaning)));
  return text;
}

}  // namespace tessera
