#include "tessera/input/names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/base/text.hpp"

namespace tessera::input {

std::vector<std::string> unique_names(const std::vector<Reader>& tables, const std::string& noun) {
  std::vector<std::string> names;
  for (const Reader& table : tables) {
    const std::string& name = table.text("name");
    const auto same = std::find(names.begin(), names.end(), name);
    if (same != names.end())
      throw InputError(table.origin_of("name"),
                       fmt::format("found {}, which is already the name of {}.{}; every {} needs "
                                   "its own",
                                   quoted(name), noun, same - names.begin(), noun));
    names.push_back(name);
  }
  return names;
}

std::size_t position_of(const Reader& table, const std::string& key, const std::vector<std::string>& names,
                        const std::string& noun) {
  const std::string& name = table.text(key);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw InputError(table.origin_of(key), fmt::format("found {}, no {} of this case{}; known: {}", quoted(name), noun,
                                                     did_you_mean(name, names), quoted_list(names, "and")));
}

std::string body_of(const Reader& table, const std::vector<std::string>& bodies) {
  if (table.has("body")) return bodies[position_of(table, "body", bodies, "body")];
  if (bodies.size() <= 1) return {};
  Origin origin = table.origin();
  origin.key += ".body";
  throw InputError(origin, fmt::format("missing; with several bodies say which one is meant: {}", quoted_list(bodies)));
}

}  // namespace tessera::input
