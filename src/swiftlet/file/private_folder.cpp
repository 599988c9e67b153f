// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/private_folder.hpp"

#include <stdlib.h>

#include <string>
#include <system_error>

namespace swiftlet {

Expected<PrivateFolder> PrivateFolder::create() {
  std::error_code none;
  std::string name = (std::filesystem::temp_directory_path(none) / "swiftlet-XXXXXX").string();
  if (none || mkdtemp(name.data()) == nullptr) {
    return fail(ErrorCode::kIo, "temporary files", "no folder can be made for them",
                "set TMPDIR to a folder that can be written to");
  }
  PrivateFolder folder;
  folder.path_ = name;
  return folder;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace swiftlet
