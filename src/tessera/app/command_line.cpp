#include "tessera/app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "tessera/base/error.hpp"
#include "tessera/base/text.hpp"

namespace tessera {

namespace {

constexpr int most_threads = 4096;

const std::vector<std::string> command_names = {"run", "check", "describe", "new", "bench", "help"};

/// The library's parser together with the variables that it fills.
class CommandLine {
 public:
  CommandLine() : app_("Tessera, a particle solver for large deformations of solids.", "tessera") {
    app_.require_subcommand(0, 1);
    app_.set_help_flag("-h,--help", "Print this help, or with a command its help");
    app_.add_flag("--version", version_, "Print version, build options and the papers to cite");
    app_.footer(
        "Exit status: 0 done, 2 wrong usage, 3 case file wrong, 4 geometry cannot be built, 5 run failed, "
        "6 stopped by a signal.");
    add_run();
    add_check();
    add_describe();
    add_new();
    add_bench();
    help_ = app_.add_subcommand("help", "Print the help of a command");
    help_->add_option("COMMAND", help_for_, "run, check, describe, new or bench");
  }

  Command parse(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());  // as the library wants them
    try {
      app_.parse(arguments);
    } catch (const CLI::CallForHelp&) {
      return HelpCommand{app_.help()};
    } catch (const CLI::ParseError& error) {
      throw UsageError(fmt::format("{}; see `tessera {}`", one_line(error.what()), help_hint()));
    }
    return chosen();
  }

 private:
  void add_run() {
    run_ = app_.add_subcommand("run", "Run a case");
    run_->add_option("CASE", run_values_.case_file, "Case file (TOML)")->required();
    run_->add_option("-o,--output", run_values_.directory, "Result folder; default CASE.out where you are")
        ->type_name("DIR");
    add_threads(run_, run_values_.threads);
    add_overrides(run_, run_values_.overrides);
    auto* resume = run_->add_flag("--resume", run_values_.resume, "Go on from the checkpoint in the result folder");
    run_->add_flag("--force", run_values_.force, "Replace the result folder if it exists")->excludes(resume);
    run_->add_flag("-q,--quiet", run_values_.quiet, "No progress, no notes; warnings and errors stay");
  }

  void add_check() {
    check_ = app_.add_subcommand("check", "Build particles, cells and bonds, check them, estimate the cost; no step");
    check_->add_option("CASE", check_values_.case_file, "Case file (TOML)")->required();
    check_->add_flag("--json", check_values_.json, "Print JSON");
    add_threads(check_, check_values_.threads);
    add_overrides(check_, check_values_.overrides);
  }

  void add_describe() {
    describe_ = app_.add_subcommand("describe", "Print the input reference: unit, range, default and meaning of keys");
    describe_->add_option("KEY", describe_values_.key, "A key or section, as in time.step; default all");
    describe_->add_flag("--markdown", describe_values_.markdown, "Print everything as Markdown");
  }

  void add_bench() {
    bench_ = app_.add_subcommand("bench", "Measure the speed of every stage and what accuracy costs on this machine");
    CLI::Option* particles =
        bench_->add_option("--particles", bench_values_.particles, "About how many; default 10^4, 10^5 and 10^6")
            ->check(CLI::Range(1000, 100'000'000));
    bench_
        ->add_option("--formulation", bench_values_.formulation,
                     "voronoi or delaunay; default voronoi for the speed, both for the accuracy")
        ->check(CLI::IsMember({"voronoi", "delaunay"}));
    bench_
        ->add_option("--integration", bench_values_.integration,
                     "nodal, cell or second-order (voronoi); default nodal for the speed, all for the accuracy")
        ->check(CLI::IsMember({"nodal", "cell", "second-order"}));
    bench_->add_flag("--accuracy", bench_values_.accuracy, "Only the time for 1% error of a cantilever's path")
        ->excludes(particles);
    bench_->add_flag("--json", bench_values_.json, "Print JSON");
    add_threads(bench_, bench_values_.threads);
  }

  void add_new() {
    new_ = app_.add_subcommand("new", "Copy one of the shipped examples as a starting point");
    new_->add_option("NAME", new_values_.name, "Name of the example");
    new_->add_option("DIR", new_values_.directory, "Where to; default NAME");
    new_->add_flag("--list", new_values_.list, "List the examples");
  }

  static void add_threads(CLI::App* command, int& threads) {
    command->add_option("-j,--threads", threads, "Number of threads; default OMP_NUM_THREADS or all")
        ->check(CLI::Range(1, most_threads))
        ->type_name("THREADS");
  }

  static void add_overrides(CLI::App* command, std::vector<std::string>& overrides) {
    command->add_option("--set", overrides, "Override a key, as in --set time.end=0.1 body.0.particles.jitter=0.2")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("KEY=VALUE ...");
  }

  Command chosen() {
    if (version_) return VersionCommand{};
    if (*run_) return run_values_;
    if (*check_) return check_values_;
    if (*bench_) return bench_values_;
    if (*describe_) return describe_values_;
    if (*help_) return help();
    if (*new_) {
      if (new_values_.name.empty() && !new_values_.list)
        throw UsageError("new: which example? `tessera new --list` lists them");
      return new_values_;
    }
    throw UsageError("no command; commands are " + list_of(command_names, "and") + "; see `tessera --help`");
  }

  HelpCommand help() {
    // The library prints the help of what was parsed; a fresh one has parsed nothing.
    if (help_for_.empty()) return {CommandLine().app_.help()};
    const auto known = std::find(command_names.begin(), command_names.end(), help_for_);
    if (known == command_names.end()) throw UsageError(unknown_command(help_for_));
    return {app_.get_subcommand(help_for_)->help("tessera")};
  }

  std::string help_hint() const {
    for (const CLI::App* command : {run_, check_, describe_, new_, bench_})
      if (*command) return "help " + command->get_name();
    return "--help";
  }

  static std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }

 public:
  static std::string unknown_command(const std::string& name) {
    return fmt::format("unknown command {}{}; commands are {}", quoted(name), did_you_mean(name, command_names),
                       list_of(command_names, "and"));
  }

 private:
  CLI::App app_;
  bool version_ = false;
  CLI::App *run_, *check_, *describe_, *new_, *bench_, *help_;
  RunCommand run_values_;
  CheckCommand check_values_;
  DescribeCommand describe_values_;
  NewCommand new_values_;
  BenchCommand bench_values_;
  std::string help_for_;
};

bool is_override(const std::string& argument) {
  return !argument.starts_with("-") && argument.find('=') != std::string::npos;
}

/// `--set a=1 b=2` means `--set a=1 --set b=2`; whatever has no equals sign ends the list.
std::vector<std::string> repeat_set(const std::vector<std::string>& arguments) {
  std::vector<std::string> result;
  bool after_set = false;
  for (const std::string& argument : arguments) {
    const bool continues = after_set && is_override(argument) && result.back() != "--set";
    if (continues) result.emplace_back("--set");
    after_set = argument == "--set" || (after_set && is_override(argument));
    result.push_back(argument);
  }
  return result;
}

}  // namespace

Command parse_command_line(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && !arguments[0].starts_with("-") &&
      std::find(command_names.begin(), command_names.end(), arguments[0]) == command_names.end())
    throw UsageError(CommandLine::unknown_command(arguments[0]));
  return CommandLine().parse(repeat_set(arguments));
}

}  // namespace tessera
