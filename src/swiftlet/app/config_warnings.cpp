// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/config_warnings.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/config/config_aliases.hpp"

namespace swiftlet::app {
namespace {

void tell(const Error& warning) {
  std::fputs(visible(fmt::format("swiftlet: warning: {}\n", warning.text())).c_str(), stderr);
}

}  // namespace

void tell_warnings(const LoadedConfig& config) {
  for (const Error& warning : config.warnings) tell(warning);
}

void tell_renamed(const std::string& place, const std::string& before, const std::string& now) {
  tell(renamed_warning(place, before, now));
}

std::string current_model(const std::string& name, const std::string& place) {
  const std::string now(current_value("integrate.model", name));
  if (now != name) tell_renamed(place, name, now);
  return now;
}

}  // namespace swiftlet::app
