#pragma once

#include "tessera/app/command_line.hpp"

namespace tessera {

// Each carries out one command and prints to standard output what it has to say; notes go to standard error. Errors are
// thrown as subclasses of Error.

void execute(const RunCommand& command);
void execute(const CheckCommand& command);
void execute(const DescribeCommand& command);
void execute(const NewCommand& command);
void execute(const BenchCommand& command);
void execute(const VersionCommand& command);
void execute(const HelpCommand& command);

}  // namespace tessera
