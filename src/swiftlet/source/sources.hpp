// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string_view>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/source/frame_source.hpp"

namespace swiftlet {

/// Opens a source from what stands behind "name:" in its address. Null where the part was not
/// built.
using OpenSource = Expected<FrameSourcePtr> (*)(std::string_view rest);

/// All kinds of sources, built or not, in the order of `swiftlet list`.
[[nodiscard]] std::span<const Registered<OpenSource>> sources();

/// Opens "7scenes:DIR", "tum:DIR", "sim:SCENE", ...
/// Errors: kUsage for an unknown kind (naming those there are), kUnsupported for one that was not
/// built, and those of the source itself.
[[nodiscard]] Expected<FrameSourcePtr> open_source(std::string_view address);

}  // namespace swiftlet
