// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/station_flags.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <thread>

namespace swiftlet::app {
namespace {

/// In one piece, and over a line of progress that may stand there: the station's thread calls it.
void tell_line(const std::string& what) {
  const char* clear_line = isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "";
  std::fputs(fmt::format("{}ground station: {}\n", clear_line, what).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

void declare_station_flags(CLI::App& parser, StationFlags& flags) {
  constexpr const char* kGroup = "Ground station";
  parser.add_option("--listen", flags.listen, "where to serve; port 0 takes any that is free")
      ->type_name("ADDR:PORT")
      ->capture_default_str()
      ->group(kGroup);
  parser.add_option("--token", flags.token, "who looks must know it; made up where it is needed")
      ->type_name("TOKEN")
      ->group(kGroup);
  parser
      .add_option("--origin", flags.origins,
                  "a page that may connect, as in https://app.example.org")
      ->type_name("URL")
      ->allow_extra_args(false)
      ->group(kGroup);
}

Expected<station::StationOptions> station_options(const StationFlags& flags) {
  auto address = station::parse_listen_address(flags.listen);
  if (!address) return forward_error(std::move(address));
  station::StationOptions options;
  options.listen = std::move(*address);
  options.access = {flags.token, flags.origins};
  options.tell = tell_line;
  if (options.access.token.empty() && !options.listen.is_loopback()) {
    options.access.token = station::random_token();
  }
  return options;
}

void tell_address(const station::Station& station) {
  for (const std::string& url : station.urls()) tell_line(url);
  if (!station.address().is_loopback()) {
    tell_line("other machines can reach it; it shows the map to whoever has the token");
  }
}

void wait_for(const InterruptGuard& interrupt) {
  using namespace std::chrono_literals;
  while (!interrupt.is_interrupted()) std::this_thread::sleep_for(50ms);
}

}  // namespace swiftlet::app
