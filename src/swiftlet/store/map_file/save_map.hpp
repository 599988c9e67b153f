// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/block_map.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {

/// Saves a map that is in memory as a new file, in one transaction; the same map gives the same
/// bytes. `meta`: what else is known of it (docs/formats/map_file.md); its header goes over that.
/// Errors: kUsage if the file exists; kIo, and there is none.
[[nodiscard]] Status save_map(const std::filesystem::path& path, const BlockMap& map,
                              MapMeta meta = {});

}  // namespace swiftlet
