#pragma once

#include <string>
#include <vector>

#include "tessera/input/reader.hpp"

namespace tessera::input {

/// The `name` of every table. Throws InputError when two of them are equal.
std::vector<std::string> unique_names(const std::vector<Reader>& tables, const std::string& noun);

/// The position of the name that `key` holds. Throws InputError for an unknown name, with the nearest known one.
std::size_t position_of(const Reader& table, const std::string& key, const std::vector<std::string>& names,
                        const std::string& noun);

/// Checks the key `body` of a table against the names of the bodies. Throws InputError when it is unknown, or when it
/// is missing although there are several bodies. Returns the name, empty for the only body.
std::string body_of(const Reader& table, const std::vector<std::string>& bodies);

}  // namespace tessera::input
