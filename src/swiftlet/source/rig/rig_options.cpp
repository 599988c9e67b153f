// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/rig_options.hpp"

#include <cmath>

#include "swiftlet/base/number_text.hpp"

namespace swiftlet {

Expected<std::optional<RigDescription>> rig_of(const SourceAddress& address) {
  for (const auto& [key, value] : address.options) {
    if (key != "rig") continue;
    auto rig = load_rig(value);
    if (!rig) return forward_error(std::move(rig));
    return std::move(*rig);
  }
  return std::nullopt;
}

std::optional<double> number_within(std::string_view text, double low, double high) {
  const auto value = parse_number(text);
  if (!value || !(*value >= low && *value <= high)) return std::nullopt;
  return value;
}

bool apply_rig_option(std::string_view key, std::string_view value, RigOptions& rig) {
  if (key == "rig") return true;
  if (key == "pairing") {
    rig.pairing = value == "nearest" ? PosePairing::kNearest : PosePairing::kInterpolate;
    return value == "nearest" || value == "interpolate";
  }
  if (key == "on_jump") {
    rig.poses.gates.on_jump = value == "clear" ? JumpPolicy::kClear : JumpPolicy::kKeep;
    return value == "clear" || value == "keep";
  }
  const auto offset_ms = number_within(value, -1000.0, 1000.0);
  if (key != "pose_offset_ms" || !offset_ms) return false;
  for (RigCamera& camera : rig.cameras)
    camera.pose_offset = Nanoseconds(std::llround(*offset_ms * 1e6));
  return true;
}

}  // namespace swiftlet
