#include "tessera/output/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "tessera/base/error.hpp"

namespace tessera {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 8> fixed_names = {"summary.json",      "history.csv",      "case.toml",
                                                         "checkpoint.h5",     "fields.pvd",       "cells.pvd",
                                                         "fields.hdf.series", "fields.csv.series"};

/// STEM_NNNNNN.EXTENSION with at least six digits.
bool is_frame(std::string_view name, std::string_view stem, std::string_view extension) {
  if (!name.starts_with(stem) || !name.ends_with(extension)) return false;
  if (name.size() < stem.size() + 6 + extension.size()) return false;
  const std::string_view digits = name.substr(stem.size(), name.size() - stem.size() - extension.size());
  return std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void remove_results(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!is_result_file(entry.path().filename().string()) || entry.is_directory()) continue;
    std::error_code error;
    if (!fs::remove(entry.path(), error) && error)
      throw RunError(fmt::format("{}: cannot be removed: {}", entry.path().string(), error.message()));
  }
}

void check_existing(const std::string& directory, ExistingResult existing) {
  if (existing == ExistingResult::resume && !fs::exists(checkpoint_path(directory)))
    throw UsageError(
        fmt::format("{}: nothing to resume: no checkpoint.h5 in it (a run that is done leaves one only with "
                    "output.checkpoint); run without --resume",
                    directory));
  if (existing == ExistingResult::refuse && !fs::is_empty(directory))
    throw UsageError(
        fmt::format("{}: the result folder exists and is not empty; --force replaces the results in it, "
                    "--resume goes on from its checkpoint, -o names another folder",
                    directory));
  if (existing == ExistingResult::overwrite) remove_results(directory);
}

}  // namespace

bool is_result_file(const std::string& name) {
  std::string_view final_name = name;
  if (final_name.ends_with(".tmp")) final_name.remove_suffix(4);
  return std::find(fixed_names.begin(), fixed_names.end(), final_name) != fixed_names.end() ||
         is_frame(final_name, "fields_", ".hdf") || is_frame(final_name, "fields_", ".vtu") ||
         is_frame(final_name, "fields_", ".csv") || is_frame(final_name, "cells_", ".vtu");
}

void prepare_result_folder(const std::string& directory, ExistingResult existing) {
  try {
    if (fs::exists(directory) && !fs::is_directory(directory))
      throw UsageError(fmt::format("{}: is a file, not a folder for results; -o names another one", directory));
    if (fs::exists(directory) || existing == ExistingResult::resume) return check_existing(directory, existing);
    fs::create_directories(directory);
  } catch (const fs::filesystem_error& error) {
    throw UsageError(fmt::format("{}: cannot be made the result folder: {}; -o names another one", directory,
                                 error.code().message()));
  }
}

std::string checkpoint_path(const std::string& directory) { return directory + "/checkpoint.h5"; }
std::string history_path(const std::string& directory) { return directory + "/history.csv"; }
std::string summary_path(const std::string& directory) { return directory + "/summary.json"; }
std::string effective_case_path(const std::string& directory) { return directory + "/case.toml"; }

}  // namespace tessera
