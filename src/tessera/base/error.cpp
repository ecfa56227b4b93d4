#include "tessera/base/error.hpp"

namespace tessera {

std::string describe(const Origin& origin) {
  std::string text;
  if (!origin.file.empty()) text = origin.file + ":";
  if (origin.line > 0) text += std::to_string(origin.line) + ":" + std::to_string(origin.column) + ":";
  if (!text.empty()) text += " ";
  if (!origin.key.empty()) text += origin.key + ": ";
  return text;
}

}  // namespace tessera
