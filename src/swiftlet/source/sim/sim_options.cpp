// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim/sim_options.hpp"

#include <fmt/format.h>

#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/source/rig/rig_options.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kSimOptions =
    "seed=N, noise=on|off, drift=on|off, start=SECONDS, frames=N, rate=HZ, barrel=SHARE, "
    "cameras=1..8, shuffle=N, fault=NAME, fault_at=SECONDS; of random scenes: size=METRES, "
    "density=0..3, thinnest=METRES";

/// "on" or "off"; false if it is neither.
bool apply_switch(std::string_view value, bool& out) {
  out = value == "on";
  return value == "on" || value == "off";
}

/// A time since the start; false if it cannot be meant.
bool apply_time(std::string_view value, Stamp& out) {
  const auto time = parse_stamp(value);
  if (time) out = *time;
  return time && time->ns >= 0;
}

/// Applies an option of random scenes; nullopt if it is none, false if it cannot be meant.
std::optional<bool> apply_random(std::string_view key, std::string_view value,
                                 SimOptions& options) {
  const auto number = number_from<double>(value);
  if (key == "size") {
    options.random.size_m = number;
  } else if (key == "density") {
    options.random.density = number.value_or(1.0);
  } else if (key == "thinnest") {
    options.random.thinnest_m = number.value_or(0.01);
  } else {
    return std::nullopt;
  }
  options.only_random = key;
  return number.has_value();
}

/// Applies one "key=value"; false if it cannot be meant.
bool apply(std::string_view key, std::string_view value, SimOptions& options) {
  if (key == "seed") return (options.seed = number_from<std::uint64_t>(value)).has_value();
  if (key == "frames") return (options.frames = number_from<std::size_t>(value)).has_value();
  if (key == "shuffle") return (options.shuffle = number_from<std::uint64_t>(value)).has_value();
  if (key == "rate") {
    options.rate_hz = number_from<double>(value);
    return options.rate_hz && *options.rate_hz >= 0.1 && *options.rate_hz <= 1000.0;
  }
  if (key == "barrel") {
    options.barrel = number_from<double>(value);
    return options.barrel && *options.barrel >= -0.5 && *options.barrel <= 0.5;
  }
  if (key == "fault") return !(options.fault = value)->empty();
  if (key == "fault_at") return apply_time(value, options.fault_at);
  if (key == "noise") return apply_switch(value, options.has_noise);
  if (key == "drift") return apply_switch(value, options.has_drift);
  if (key == "cameras") {
    options.cameras = number_from<std::size_t>(value).value_or(0);
    return options.cameras >= 1 && options.cameras <= kMaxCameras;
  }
  if (key == "start") {
    Stamp start;
    const bool is_meant = apply_time(value, start);
    options.start = Nanoseconds(start.ns);
    return is_meant;
  }
  if (const auto is_meant = apply_random(key, value, options)) return *is_meant;
  return apply_rig_option(key, value, options.rig);
}

}  // namespace

Expected<SimOptions> parse_sim_options(const SourceAddress& address) {
  SimOptions options;
  auto rig = rig_of(address);
  if (!rig) return forward_error(std::move(rig));
  options.rig_file = std::move(*rig);
  options.rig = options.rig_file ? options.rig_file->rig : intel_t265_d435_rig().rig;
  for (const auto& [key, value] : address.options) {
    if (!apply(key, value, options))
      return bad_option("sim", key, value, fmt::format("{}, {}", kSimOptions, kRigOptions));
  }
  return options;
}

}  // namespace swiftlet
