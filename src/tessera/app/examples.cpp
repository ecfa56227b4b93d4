#include "tessera/app/examples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tessera/base/error.hpp"
#include "tessera/base/text.hpp"

namespace tessera {

namespace fs = std::filesystem;

namespace {

bool is_case_file(const fs::path& path) { return path.extension() == ".toml"; }

std::vector<std::string> case_files_in(const fs::path& directory) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.is_regular_file() && is_case_file(entry.path())) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

fs::path examples_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share" / "tessera" / "examples";
  for (const fs::path& folder : {installed, fs::path(TESSERA_SOURCE_EXAMPLES)})
    if (fs::is_directory(folder, error)) return folder;
  throw UsageError(fmt::format("the examples are not installed: there is no folder {}", installed.string()));
}

/// The first heading of the README, or else nothing.
std::string title_of(const fs::path& example) {
  std::ifstream readme(example / "README.md");
  for (std::string line; std::getline(readme, line);)
    if (line.starts_with("# ")) return line.substr(2);
  return {};
}

/// Results of earlier runs do not belong to an example.
bool is_result(const fs::path& path) { return path.extension() == ".out"; }

void copy_folder(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(from)) {
    const fs::path target = to / entry.path().filename();
    if (entry.is_directory() && !is_result(entry.path())) copy_folder(entry.path(), target);
    if (entry.is_regular_file()) fs::copy_file(entry.path(), target, fs::copy_options::none);
  }
}

}  // namespace

std::vector<Example> list_examples() {
  const fs::path folder = examples_folder();
  std::vector<Example> examples;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && !case_files_in(entry.path()).empty())
      examples.push_back({entry.path().filename().string(), title_of(entry.path())});
  if (examples.empty()) throw UsageError(fmt::format("there are no examples in {}", folder.string()));
  std::sort(examples.begin(), examples.end(), [](const Example& a, const Example& b) { return a.name < b.name; });
  return examples;
}

std::vector<std::string> copy_example(const std::string& name, const std::string& directory) {
  std::vector<std::string> names;
  for (const Example& e : list_examples()) names.push_back(e.name);
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError(fmt::format("unknown example {}{}; known are {}", quoted(name), did_you_mean(name, names),
                                 list_of(names, "and")));
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_empty(directory, error))
    throw UsageError(fmt::format("{} exists and is not empty; give another folder, as in `tessera new {} my-case`",
                                 quoted(directory), name));
  try {
    copy_folder(examples_folder() / name, directory);
  } catch (const fs::filesystem_error& fault) {
    throw UsageError(fmt::format("the example cannot be copied to {}: {}", quoted(directory), fault.code().message()));
  }
  return case_files_in(directory);
}

}  // namespace tessera
