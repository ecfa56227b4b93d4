#include "tessera/input/normalize.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/base/text.hpp"
#include "tessera/input/convert.hpp"
#include "tessera/input/toml_reader.hpp"

namespace tessera::input {

namespace {

std::string joined(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

Value parse_standard(const std::string& text, const Origin& origin, const std::string& key) {
  Value value = *read_toml_value(text);
  value.origin = origin;
  value.origin.key = key;
  return value;
}

class Normalizer {
 public:
  Normalizer(Setting setting, std::vector<std::string>& unused) : setting_(std::move(setting)), unused_(unused) {}

  /// `row` is the table's path in the input table, `path` the one in the file.
  Value table(const Value& given, const std::string& row, const std::string& path) {
    const Table* found = given.get_if<Table>();
    if (found == nullptr) throw InputError(given.origin, fmt::format("found {}; expected a table", describe(given)));
    check_keys(*found, row);
    const Table entries = choose_alternative(*found, given.origin, row);
    Table result;
    for (const Parameter* p : parameters_in(row)) add(result, *p, entries, given.origin, path);
    return {std::move(result), given.origin};
  }

 private:
  void check_keys(const Table& entries, const std::string& row) const {
    const auto known = parameters_in(row);
    std::vector<std::string> names;
    names.reserve(known.size());
    for (const Parameter* p : known) names.push_back(last_part(p->key));
    for (const Entry& e : entries) {
      if (std::find(names.begin(), names.end(), e.key) != names.end()) continue;
      std::string hint = did_you_mean(e.key, names);
      if (hint.empty()) hint = known_elsewhere(e.key);
      throw InputError(e.origin, fmt::format("unknown key{}; allowed here: {}", hint, list_of(names, "and")));
    }
  }

  static std::string known_elsewhere(const std::string& key) {
    for (const Parameter& p : parameters())
      if (last_part(p.key) == key) return fmt::format(" (did you mean \"{}\"?)", p.key);
    return {};
  }

  // Of alternatives the one from the command line wins over those in the file.
  Table choose_alternative(Table entries, const Origin& origin, const std::string& row) const {
    const Parameter* p = find_parameter(row);
    if (p == nullptr || p->exactly_one.empty()) return entries;
    const auto is_alternative = [&](const Entry& e) {
      return std::find(p->exactly_one.begin(), p->exactly_one.end(), e.key) != p->exactly_one.end();
    };
    const auto overriding = [&](const Entry& e) { return is_alternative(e) && e.origin.file == command_line; };
    if (std::any_of(entries.begin(), entries.end(), overriding))
      std::erase_if(entries, [&](const Entry& e) { return is_alternative(e) && !overriding(e); });
    std::vector<std::string> given;
    Origin last = origin;
    for (const Entry& e : entries) {
      if (!is_alternative(e)) continue;
      given.push_back(e.key);
      last = e.origin;
    }
    const bool go_together = given.size() > 1 && std::all_of(given.begin(), given.end(), [&](const std::string& key) {
                               return std::find(p->together.begin(), p->together.end(), key) != p->together.end();
                             });
    if (given.size() != 1 && !go_together)
      throw InputError(
          last, fmt::format("found {}; expected exactly one of {}",
                            given.empty() ? "none" : list_of(given, "and") + " together", list_of(p->exactly_one)));
    return entries;
  }

  void add(Table& result, const Parameter& p, const Table& entries, const Origin& origin, const std::string& path) {
    const std::string key = last_part(p.key);
    const std::string full = joined(path, key);
    const Value* given = find(entries, key);
    if (!has_effect(p, entries, result)) {
      if (given != nullptr) report_misplaced(p, *given, full);
      return;
    }
    if (given != nullptr) {
      result.push_back({key, given->origin, convert_any(p, *given, full)});
    } else if (auto standard = default_of(p, entries, result, origin, full)) {
      result.push_back({key, origin, convert_any(p, *standard, full)});
    }
  }

  // Conditions look at siblings that come earlier in the table (with their defaults) or that were given.
  static bool has_effect(const Parameter& p, const Table& entries, const Table& result) {
    return p.only_with.empty() ||
           std::any_of(p.only_with.begin(), p.only_with.end(),
                       [&](const std::string& condition) { return holds(condition, entries, result); });
  }

  static bool holds(const std::string& condition, const Table& entries, const Table& result) {
    const auto equals = condition.find('=');
    if (equals == std::string::npos) return find(entries, condition) != nullptr;
    const Value* sibling = find(result, condition.substr(0, equals));
    const auto* text = sibling != nullptr ? sibling->get_if<std::string>() : nullptr;
    return text != nullptr && *text == condition.substr(equals + 1);
  }

  static const std::string& standard_of(const Parameter& p, const Table& entries, const Table& result) {
    for (const auto& [condition, standard] : p.standard_beside)
      if (holds(condition, entries, result)) return standard;
    return p.standard;
  }

  void report_misplaced(const Parameter& p, const Value& given, const std::string& full) {
    const std::string what = "only has an effect with " + conditions_text(p);
    if (p.misplaced == Misplaced::refused) throw InputError(given.origin, what);
    Origin origin = given.origin;
    origin.key = full;
    unused_.push_back(tessera::describe(origin) + what);
  }

  std::optional<Value> default_of(const Parameter& p, const Table& entries, const Table& result, const Origin& origin,
                                  const std::string& full) const {
    if (p.presence == Presence::defaulted && p.kind == Kind::table) return Value{Table{}, origin};
    if (p.presence == Presence::defaulted) return parse_standard(standard_of(p, entries, result), origin, full);
    if (p.presence == Presence::optional) return std::nullopt;
    if (setting_.dimension == 2 && p.kind == Kind::number && !p.flat.empty())
      return parse_standard(p.flat, origin, full);
    Origin place = origin;
    place.key = full;
    throw InputError(place, fmt::format("missing; expected {}", expectation(p)));
  }

  Value convert_any(const Parameter& p, const Value& value, const std::string& full) {
    switch (p.kind) {
      case Kind::table:
        return table(value, p.key, full);
      case Kind::shape:
        return table(value, "body.shape", full);
      case Kind::tables:
        return tables(p, value, p.key, full);
      case Kind::shapes:
        return tables(p, value, "body.shape", full);
      default:
        return convert(p, value, setting_);
    }
  }

  Value tables(const Parameter& p, const Value& value, const std::string& row, const std::string& full) {
    const Array* given = value.get_if<Array>();
    if (given == nullptr || (given->empty() && p.presence == Presence::required))
      throw InputError(value.origin, fmt::format("found {}; expected {}{}", describe(value), expectation(p),
                                                 p.kind == Kind::tables ? fmt::format(", [[{}]]", p.key) : ""));
    Array result;
    for (const Value& item : *given) result.push_back(table(item, row, joined(full, std::to_string(result.size()))));
    return {std::move(result), value.origin};
  }

  Setting setting_;
  std::vector<std::string>& unused_;
};

// Needed before anything else, because vectors may be shorter with dimension 2. A wrong one is found later.
int dimension_of(const Value& root) {
  const Table* table = root.get_if<Table>();
  const Value* method = table != nullptr ? find(*table, "method") : nullptr;
  const Table* keys = method != nullptr ? method->get_if<Table>() : nullptr;
  const Value* dimension = keys != nullptr ? find(*keys, "dimension") : nullptr;
  const auto* number = dimension != nullptr ? dimension->get_if<std::int64_t>() : nullptr;
  return number != nullptr && *number == 2 ? 2 : 3;
}

}  // namespace

NormalCase normalize(const Value& root, const std::string& directory) {
  NormalCase result;
  result.root = Normalizer({dimension_of(root), directory}, result.unused).table(root, "", "");
  return result;
}

}  // namespace tessera::input
