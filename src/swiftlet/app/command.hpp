// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <span>
#include <string>

#include "swiftlet/base/faults.hpp"
#include "swiftlet/base/registry.hpp"

namespace CLI {
class App;
}

namespace swiftlet::app {

/// The work of a command, once its options have been read.
using Action = std::function<Faults()>;

/// Declares the options of a command on its parser and returns its work.
using DeclareCommand = Action (*)(CLI::App& parser);

/// The table of subcommands.
[[nodiscard]] std::span<const Registered<DeclareCommand>> commands();

/// Reads the command line, runs the command, prints faults on standard error as
/// `swiftlet: <where>: <what>; <what to do>`, and returns the exit code of the program:
/// 0 done, 1 the work failed, 2 wrong usage (kUsage, kInvalidConfig).
[[nodiscard]] int run_program(int argc, char** argv);

}  // namespace swiftlet::app
