#pragma once

#include <stdexcept>
#include <string>

namespace tessera {

/// What the program tells its caller when it ends.
enum class ExitStatus : int { done = 0, usage = 2, input = 3, geometry = 4, run = 5, interrupted = 6 };

/// Where in the case file something was said. `line` and `column` count from one; a zero line means "not in a file".
struct Origin {
  std::string file;
  int line = 0;
  int column = 0;
  std::string key;
};

/// "file:line:column: key: ", leaving out what is not known.
std::string describe(const Origin& origin);

/// The base of everything Tessera throws on purpose; what() is one line for the person who can mend it.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// The command line is wrong (status 2).
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ExitStatus::usage, message) {}
};

/// The case file is wrong (status 3): says where, what was found and what is allowed.
struct InputError : Error {
  InputError(const Origin& origin, const std::string& message) : Error(ExitStatus::input, describe(origin) + message) {}
};

/// Particles, cells or bonds cannot be built (status 4): says which particles and where.
struct GeometryError : Error {
  explicit GeometryError(const std::string& message) : Error(ExitStatus::geometry, message) {}
};

/// The run cannot go on (status 5): says step, time, particle, position and reason.
struct RunError : Error {
  explicit RunError(const std::string& message) : Error(ExitStatus::run, message) {}
};

/// Stopped by a signal after a checkpoint was written (status 6).
struct Interrupted : Error {
  explicit Interrupted(const std::string& message) : Error(ExitStatus::interrupted, message) {}
};

}  // namespace tessera
