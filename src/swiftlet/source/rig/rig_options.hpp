// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/rig/rig_file.hpp"

namespace swiftlet {

/// The options that every source with a rig knows, for its messages.
inline constexpr std::string_view kRigOptions =
    "rig=FILE, pairing=interpolate|nearest, on_jump=keep|clear, pose_offset_ms";

/// The rig of the file that an address names; nullopt if it names none. Errors: those of
/// load_rig().
[[nodiscard]] Expected<std::optional<RigDescription>> rig_of(const SourceAddress& address);

/// Applies an option of kRigOptions; false if it is none or its value cannot be meant. `rig=` has
/// been read before by rig_of().
[[nodiscard]] bool apply_rig_option(std::string_view key, std::string_view value, RigOptions& rig);

/// A number within limits, both ends included; nullopt for anything else.
[[nodiscard]] std::optional<double> number_within(std::string_view text, double low, double high);

}  // namespace swiftlet
