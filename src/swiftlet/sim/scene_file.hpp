// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

/// A built-in scene by name ("apartment"), or a file by path ("my/room.yaml": anything with a slash
/// or that ends in .yaml). Errors: kNotFound naming the built-in scenes, and those of
/// parse_scene().
[[nodiscard]] Expected<Scene> load_scene(std::string_view name_or_path);

/// Reads a scene from YAML. `origin` names the text in errors; meshes are looked for beside it.
/// The keys are described in docs/scenes.md; unknown keys, wrong types and impossible values are
/// errors. Errors: kInvalidConfig with file, line, and what there could be.
[[nodiscard]] Expected<Scene> parse_scene(std::string_view yaml, std::string_view origin);

}  // namespace swiftlet::sim
