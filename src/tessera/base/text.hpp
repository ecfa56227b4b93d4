#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tessera {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`; capitals do not count.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` was most likely meant to be; nothing when none is near. Of equals the first wins.
std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string> candidates);

/// " (did you mean "WORD"?)", or nothing when no candidate is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a, b or c".
std::string list_of(std::span<const std::string> words, std::string_view conjunction = "or");

/// `text` in double quotes, with line ends and other control characters escaped, so that it stays on one line.
std::string quoted(std::string_view text);
// Where <iomanip> is included, std::quoted would be the better match for strings without these.
inline std::string quoted(const std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(const char* text) { return quoted(std::string_view(text)); }

/// list_of() with every word in quotes.
std::string quoted_list(std::span<const std::string> words, std::string_view conjunction = "or");

/// `text` without the blanks at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace tessera
