// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>

#include "swiftlet/base/registry.hpp"

namespace swiftlet::sim {

class SceneDraft;

/// Draws objects, start, goal and bounds. What it draws must depend on the draft alone.
using DrawScene = void (*)(SceneDraft& draft);

/// The kinds of random scenes, as in `sim:random:forest?seed=7`; null where Embree is missing.
[[nodiscard]] std::span<const Registered<DrawScene>> scene_kinds();

}  // namespace swiftlet::sim
