// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/folders/folder_options.hpp"

#include <cmath>

#include "swiftlet/source/rig/rig_options.hpp"

namespace swiftlet {

bool apply_depth_unit(std::string_view key, std::string_view value, FolderOptions& options) {
  const auto unit_m = number_within(value, 1e-6, 0.1);
  if (key != "depth_unit_m" || !unit_m) return false;
  options.depth_unit_m = static_cast<float>(*unit_m);
  return true;
}

bool apply_time_offset(std::string_view key, std::string_view value, FolderOptions& options) {
  constexpr double kMost_ms = 4e12;  // any two epochs
  const auto offset_ms = number_within(value, -kMost_ms, kMost_ms);
  if (key != "time_offset_ms" || !offset_ms) return false;
  options.time_offset = Nanoseconds(std::llround(*offset_ms * 1e6));
  return true;
}

Expected<FolderOptions> parse_folder_options(std::string_view rest, std::string_view kind,
                                             bool has_clock) {
  auto address = parse_place_address(rest, kind);
  if (!address) return forward_error(std::move(address));
  FolderOptions options{.folder = address->place};
  for (const auto& [key, value] : address->options) {
    if (key == "intrinsics" && !value.empty()) {
      options.intrinsics = value;
    } else if (key == "up" && axes_with_up(value)) {
      options.up = axes_with_up(value);
    } else if (!apply_depth_unit(key, value, options) &&
               !(has_clock && apply_time_offset(key, value, options))) {
      return bad_option(
          kind, key, value,
          std::string("depth_unit_m, up=+z|-y|..., intrinsics=fx,fy,cx,cy or intrinsics=FILE") +
              (has_clock ? ", time_offset_ms" : ""));
    }
  }
  return options;
}

}  // namespace swiftlet
