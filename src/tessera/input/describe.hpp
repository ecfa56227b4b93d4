#pragma once

#include <string>

namespace tessera {

/// The input reference as plain text: every key with type, unit, range, default and one sentence.
std::string describe_input();

/// The same as Markdown, one table a section.
std::string describe_input_markdown();

/// The rows of a key ("material.density"), of a section ("time") with all that is in it, or of the end of a key path
/// when it is the only one or the same in all ("jitter"). Numbers of list items are left out. Throws UsageError for an
/// unknown key, with the nearest known one.
std::string describe_key(const std::string& key);

}  // namespace tessera
