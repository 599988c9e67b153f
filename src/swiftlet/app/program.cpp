// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>
#include <utility>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/base/nearest_name.hpp"

namespace swiftlet::app {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int exit_code(const Faults& faults) {
  const auto is_usage = [](const Error& e) {
    return e.code == ErrorCode::kUsage || e.code == ErrorCode::kInvalidConfig;
  };
  if (faults.empty()) return kDone;
  return std::ranges::any_of(faults, is_usage) ? kWrongUsage : kFailed;
}

/// fputs, which fmt's print is not, is silent where standard error cannot be written.
int report(const Faults& faults) {
  for (const Error& fault : faults)
    std::fputs(("swiftlet: " + visible(fault.text()) + "\n").c_str(), stderr);
  return exit_code(faults);
}

/// What the command printed counts as done only when it has arrived: `swiftlet list > /dev/full`.
Faults flushed(Faults faults) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return faults;
  faults.push_back({ErrorCode::kIo, "standard output", "it cannot be written",
                    "is the disk full or the reader gone?"});
  return faults;
}

/// The first word on the command line is no command.
int report_unknown(const std::string& word) {
  std::vector<std::string> names;
  for (const auto& command : commands()) names.emplace_back(command.name);
  const auto meant = nearest_name(word, names);
  return report({{ErrorCode::kUsage, "command line", fmt::format("there is no command '{}'", word),
                  meant ? fmt::format("did you mean '{}'", *meant) : "try 'swiftlet --help'"}});
}

/// Help and version are asked for by the user and are no faults, though CLI11 throws them too.
int report(const CLI::App& program, const CLI::ParseError& stop) {
  if (stop.get_exit_code() == 0) return program.exit(stop);
  std::string place = "command line";
  std::string help = "swiftlet --help";
  for (const CLI::App* chosen : program.get_subcommands()) {
    place = chosen->get_name();
    help = fmt::format("swiftlet {} --help", chosen->get_name());
  }
  const bool has_command = !program.get_subcommands().empty();
  const auto strangers = program.remaining();
  if (!has_command && !strangers.empty()) return report_unknown(strangers.front());
  return report({{ErrorCode::kUsage, place, stop.what(), fmt::format("try '{}'", help)}});
}

}  // namespace

int run_program(int argc, char** argv) {
  // A file that reaches its limit (ulimit -f) is an error of writing, with a message and no half
  // file left; for flights, InterruptGuard does more.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App program{"Swiftlet: real-time 3-D occupancy maps for small drones", "swiftlet"};
  program.set_version_flag("--version", "swiftlet " SWIFTLET_VERSION);
  program.footer(
      "Examples:\n"
      "  swiftlet map sim:apartment -o flat.swl     fly a simulated rig and map what it sees\n"
      "  swiftlet render flat.swl -o flat.png       look at the map\n"
      "  swiftlet list                              everything there is to choose from\n"
      "'swiftlet COMMAND --help' tells more.");
  program.require_subcommand(0, 1);  // of "experiment fly" the second word is no command
  const VisibleStdout visible_output;
  Action chosen;
  for (const auto& command : commands()) {
    CLI::App* parser =
        program.add_subcommand(std::string(command.name), std::string(command.summary));
    parser->callback([&chosen, work = command.make(*parser)] { chosen = work; });
  }
  try {
    program.parse(argc, argv);
    if (!chosen) throw CLI::RequiredError("a command");
    return report(flushed(chosen()));
  } catch (const CLI::ParseError& stop) {
    return report(program, stop);
  } catch (const std::system_error& refused) {
    if (refused.code() == std::errc::resource_unavailable_try_again) {
      return report({{ErrorCode::kOutOfMemory, "threads", "the system starts no further one",
                      "raise its limit ('ulimit -u', memory) or end other programs"}});
    }
    return report({{ErrorCode::kIo, "standard output", refused.what(), {}}});  // fmt, printing
  } catch (const std::bad_alloc&) {
    return report({{ErrorCode::kOutOfMemory,
                    {},
                    "the memory does not suffice",
                    "choose larger voxels or a smaller window"}});
  }
}

}  // namespace swiftlet::app
