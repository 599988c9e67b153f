// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/config/config_aliases.hpp"

#include <algorithm>
#include <array>

namespace swiftlet {
namespace {

constexpr std::array kKeys{RenamedKey{"integrate.fusion", "integrate.model"}};

constexpr std::array kValues{RenamedValue{"integrate.model", "thesis", "inverse_sensor_model"},
                             RenamedValue{"integrate.model", "guarded", "thin_obstacle_preserving"},
                             RenamedValue{"integrate.model", "sharp", "precision_weighted"}};

}  // namespace

std::span<const RenamedKey> renamed_keys() { return kKeys; }
std::span<const RenamedValue> renamed_values() { return kValues; }

std::string_view current_key(std::string_view key) {
  const auto found = std::ranges::find(kKeys, key, &RenamedKey::before);
  return found == kKeys.end() ? key : found->now;
}

std::string_view current_value(std::string_view key, std::string_view value) {
  const auto found = std::ranges::find_if(
      kValues, [&](const RenamedValue& v) { return v.key == key && v.before == value; });
  return found == kValues.end() ? value : found->now;
}

}  // namespace swiftlet
