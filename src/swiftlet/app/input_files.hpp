// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace swiftlet::app {

/// The files that the address of a source names, KIND:FILE[,FILE...][?...]; those that exist.
[[nodiscard]] std::vector<std::filesystem::path> input_files(std::string_view address);

}  // namespace swiftlet::app
