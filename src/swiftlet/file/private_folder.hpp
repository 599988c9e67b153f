// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <utility>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// A folder that nobody else can look into; gone with what is in it at the end.
class PrivateFolder {
 public:
  /// Errors: kIo.
  [[nodiscard]] static Expected<PrivateFolder> create();
  PrivateFolder(PrivateFolder&& other) noexcept
      : path_(std::exchange(other.path_, std::filesystem::path{})) {}
  PrivateFolder& operator=(PrivateFolder&&) = delete;
  ~PrivateFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  PrivateFolder() = default;
  std::filesystem::path path_;
};

}  // namespace swiftlet
