// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace swiftlet::app {

/// A folder that nobody else can look into; gone with what is in it at the end.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::error_code none;
    path_ = (std::filesystem::temp_directory_path(none) / "swiftlet-XXXXXX").string();
    if (none || mkdtemp(path_.data()) == nullptr) path_.clear();
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::string& path() const { return path_; }  ///< empty: there is none

 private:
  std::string path_;
};

}  // namespace swiftlet::app
