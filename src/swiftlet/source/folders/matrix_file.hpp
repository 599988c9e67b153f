// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// A text file that holds nothing but a matrix, row by row, separated by white space.
/// Errors: kNotFound, kIo; kCorruptInput if a word is no number or there are too few or too many.
/// Values may be NaN or infinite: what they mean is the caller's to judge.
[[nodiscard]] Expected<Eigen::Matrix3d> read_matrix3(const std::filesystem::path& path);
[[nodiscard]] Expected<Eigen::Matrix4d> read_matrix4(const std::filesystem::path& path);

}  // namespace swiftlet
