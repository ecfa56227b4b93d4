#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <variant>
#include <vector>

#include "tessera/app/commands.hpp"
#include "tessera/base/error.hpp"

namespace {

bool colours_on_standard_error() {
  const char* no_colour = std::getenv("NO_COLOR");
  return (no_colour == nullptr || *no_colour == '\0') && isatty(STDERR_FILENO) != 0;
}

/// One line, whatever the message holds.
int report(tessera::ExitStatus status, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  const bool colours = colours_on_standard_error();
  std::cerr << (colours ? "\033[1;31mtessera:\033[0m " : "tessera: ") << message << std::endl;
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  using tessera::ExitStatus;
  try {
    const tessera::Command command = tessera::parse_command_line(std::vector<std::string>(argv + 1, argv + argc));
    std::visit([](const auto& c) { tessera::execute(c); }, command);
    return static_cast<int>(ExitStatus::done);
  } catch (const tessera::Error& error) {
    return report(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitStatus::run, "out of memory; fewer particles need less (`tessera check` estimates how much)");
  } catch (const std::exception& error) {
    return report(ExitStatus::run, std::string("unexpected fault: ") + error.what());
  }
}
