#pragma once

#include <string>

namespace tessera {

/// What may happen to results that are already in the folder.
enum class ExistingResult { refuse, overwrite, resume };

/// Makes the result folder `directory` ready and creates it when needed.
///   refuse     a folder that is not empty is left alone: UsageError
///   overwrite  files that Tessera writes are removed, others stay
///   resume     everything stays; UsageError when there is no checkpoint
/// Throws UsageError when the path is a file, RunError when the folder cannot be made or a file cannot be removed.
void prepare_result_folder(const std::string& directory, ExistingResult existing);

/// True for names of files that Tessera writes into a result folder, also under their temporary names.
bool is_result_file(const std::string& name);

/// Paths of the files in the folder.
std::string checkpoint_path(const std::string& directory);
std::string history_path(const std::string& directory);
std::string summary_path(const std::string& directory);
std::string effective_case_path(const std::string& directory);

}  // namespace tessera
