#pragma once

#include <string>
#include <vector>

namespace tessera {

/// What has changed from one effective case to another, one line for each value ("material.0.young was 1e6, is 2e6"),
/// in the order of the keys. Throws InputError when a text is no TOML; `name_before` is what messages call the first.
std::vector<std::string> case_changes(const std::string& before, const std::string& name_before,
                                      const std::string& now);

}  // namespace tessera
