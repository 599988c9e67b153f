// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/registry.hpp"

namespace swiftlet::app {

/// What went wrong, all of it; empty means that the work is done.
using Faults = std::vector<Error>;

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

/// The single fault of an Expected that has failed.
template <class T>
[[nodiscard]] Faults fault_of(Expected<T>&& failed) {
  return {std::move(failed).error()};
}

}  // namespace swiftlet::app
