#pragma once

#include <string>
#include <variant>
#include <vector>

namespace tessera {

/// tessera run
struct RunCommand {
  std::string case_file;
  std::string directory;  // empty: "<case stem>.out" beside where the program is called
  int threads = 0;        // 0: as the environment says
  std::vector<std::string> overrides;
  bool resume = false;
  bool force = false;
  bool quiet = false;
};

/// tessera check
struct CheckCommand {
  std::string case_file;
  int threads = 0;
  std::vector<std::string> overrides;
  bool json = false;
};

/// tessera describe
struct DescribeCommand {
  std::string key;  // empty: everything
  bool markdown = false;
};

/// tessera new
struct NewCommand {
  std::string name;
  std::string directory;  // empty: the name
  bool list = false;
};

/// tessera bench
struct BenchCommand {
  int particles = 0;        // 0: all sizes
  int threads = 0;          // 0: one to all
  std::string integration;  // empty: nodal for the speed, all for the accuracy
  std::string formulation;  // empty: voronoi for the speed, both for the accuracy
  bool accuracy = false;    // only that
  bool json = false;
};

/// tessera --version
struct VersionCommand {};

/// tessera --help, tessera help COMMAND
struct HelpCommand {
  std::string text;
};

using Command =
    std::variant<RunCommand, CheckCommand, DescribeCommand, NewCommand, BenchCommand, VersionCommand, HelpCommand>;

/// What the arguments (without the program's name) ask for. Throws UsageError.
Command parse_command_line(const std::vector<std::string>& arguments);

}  // namespace tessera
