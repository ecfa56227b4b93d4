#include "tessera/input/case_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tessera/input/build_case.hpp"
#include "tessera/input/normalize.hpp"
#include "tessera/input/overrides.hpp"
#include "tessera/input/toml_reader.hpp"

namespace tessera {

namespace {

std::string read_text(const std::string& path) {
  const Origin origin{path, 0, 0, ""};
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(origin, "is a folder; give the case file in it");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(origin, "cannot be read; is the name right, and may you read it?");
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw InputError(origin, "cannot be read to its end");
  return text;
}

}  // namespace

CaseFile read_case_text(const std::string& text, const std::string& path, const std::vector<std::string>& overrides) {
  input::Value root = input::read_toml(text, path);
  input::apply_overrides(root, overrides);
  const std::string directory = std::filesystem::path(path).parent_path().string();
  input::NormalCase normal = input::normalize(root, directory);
  CaseFile result{input::build_case(*normal.root.get_if<input::Table>()), std::move(normal.unused)};
  result.value.file = path;
  result.value.effective = "# The case as run: SI units, all defaults filled in.\n" +
                           input::to_toml_document(*normal.root.get_if<input::Table>());
  return result;
}

CaseFile read_case_file(const std::string& path, const std::vector<std::string>& overrides) {
  return read_case_text(read_text(path), path, overrides);
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  return read_case_file(path, overrides).value;
}

}  // namespace tessera
