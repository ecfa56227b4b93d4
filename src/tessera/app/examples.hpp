#pragma once

#include <string>
#include <vector>

namespace tessera {

/// A shipped example: its name and what its README says first.
struct Example {
  std::string name;
  std::string title;
};

/// The shipped examples, by name: those in share/tessera/examples beside the program, otherwise those of the source
/// tree. Throws UsageError when there are none.
std::vector<Example> list_examples();

/// Copies an example to `directory` and returns the case files in it. Throws UsageError for an unknown name, or when
/// the directory is there already with something in it.
std::vector<std::string> copy_example(const std::string& name, const std::string& directory);

}  // namespace tessera
