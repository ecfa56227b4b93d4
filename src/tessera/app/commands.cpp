#include "tessera/app/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tessera/app/examples.hpp"
#include "tessera/app/version.hpp"
#include "tessera/base/text.hpp"
#include "tessera/bench/bench.hpp"
#include "tessera/input/case_changes.hpp"
#include "tessera/input/case_file.hpp"
#include "tessera/input/describe.hpp"
#include "tessera/output/result_folder.hpp"
#include "tessera/simulation/run.hpp"

namespace tessera {

namespace fs = std::filesystem;

namespace {

void print_notes(const CaseFile& file) {
  for (const std::string& line : file.unused) fmt::print(stderr, "tessera: note: {}\n", line);
}

/// A resumed run goes on with the case of today; what has changed since the results began may be meant or not.
void print_changes(const CaseFile& file, const std::string& folder) {
  const std::string path = effective_case_path(folder);
  std::ifstream then(path, std::ios::binary);
  if (!then) return;
  const std::string before{std::istreambuf_iterator<char>(then), std::istreambuf_iterator<char>()};
  for (const std::string& line : case_changes(before, path, file.value.effective))
    fmt::print(stderr, "tessera: note: goes on with another case than before: {}\n", line);
}

std::string result_folder(const RunCommand& command) {
  if (!command.directory.empty()) return command.directory;
  return fs::path(command.case_file).stem().string() + ".out";
}

/// Nothing is replaced unless the user says so; an empty folder holds nothing to replace.
void check_folder(const RunCommand& command, const std::string& folder) {
  std::error_code error;
  const bool exists = fs::exists(folder, error);
  if (exists && !fs::is_directory(folder, error))
    throw UsageError(fmt::format("the result folder {} is a file; give another name with -o", quoted(folder)));
  if (command.resume && !exists)
    throw UsageError(
        fmt::format("there is no result folder {} to resume; leave out --resume, or name it with -o", quoted(folder)));
  if (exists && !fs::is_empty(folder, error) && !command.resume && !command.force)
    throw UsageError(
        fmt::format("the result folder {} exists; give --force to replace it, --resume to go on with it, "
                    "or another name with -o",
                    quoted(folder)));
}

}  // namespace

void execute(const RunCommand& command) {
  const std::string folder = result_folder(command);
  check_folder(command, folder);
  const CaseFile file = read_case_file(command.case_file, command.overrides);
  if (!command.quiet) print_notes(file);
  if (command.resume && !command.quiet) print_changes(file, folder);
  RunOptions options;
  options.directory = folder;
  options.threads = command.threads;
  options.overwrite = command.force;
  options.resume = command.resume;
  options.quiet = command.quiet;
  run_case(file.value, options);
}

void execute(const CheckCommand& command) {
  const CaseFile file = read_case_file(command.case_file, command.overrides);
  print_notes(file);
  const CheckReport report = check_case(file.value, command.threads);
  const std::string& text = command.json ? report.json : report.text;
  fmt::print("{}{}", text, text.ends_with("\n") ? "" : "\n");
}

void execute(const DescribeCommand& command) {
  if (command.markdown) {
    fmt::print("{}", describe_input_markdown());
  } else {
    fmt::print("{}", command.key.empty() ? describe_input() : describe_key(command.key));
  }
}

void execute(const NewCommand& command) {
  if (command.list) {
    for (const Example& e : list_examples()) fmt::print("{:<24} {}\n", e.name, e.title);
    return;
  }
  const std::string directory = command.directory.empty() ? command.name : command.directory;
  for (const std::string& file : copy_example(command.name, directory)) fmt::print("tessera run {}\n", file);
}

void execute(const BenchCommand& command) {
  BenchOptions options;
  if (command.particles > 0) options.particles = command.particles;
  if (command.threads > 0) options.threads = command.threads;
  if (!command.formulation.empty())
    options.formulation = command.formulation == "delaunay" ? Formulation::delaunay : Formulation::voronoi;
  if (command.integration == "nodal") options.integration = Integration::nodal;
  if (command.integration == "cell") options.integration = Integration::cell;
  if (command.integration == "second-order") options.integration = Integration::second_order;
  if (options.integration == Integration::second_order && options.formulation == Formulation::delaunay)
    throw UsageError("--integration second-order needs --formulation voronoi");
  if (command.accuracy) {
    options.parts = BenchParts::accuracy;
  } else if (options.particles || options.threads) {
    options.parts = BenchParts::speed;
  }
  if (command.json) {
    fmt::print("{}", to_json(run_bench(options)));
    return;
  }
  // Minutes lie between the two tables: each is shown when it is there.
  using Parts = std::vector<BenchParts>;
  for (const BenchParts part : options.parts == BenchParts::everything ? Parts{BenchParts::speed, BenchParts::accuracy}
                                                                       : Parts{options.parts}) {
    options.parts = part;
    fmt::print("{}\n", to_table(run_bench(options)));
    std::fflush(stdout);
  }
}

void execute(const VersionCommand&) { fmt::print("{}", version_text()); }

void execute(const HelpCommand& command) { fmt::print("{}", command.text); }

}  // namespace tessera
