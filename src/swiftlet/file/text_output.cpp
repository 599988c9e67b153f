// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/text_output.hpp"

#include <system_error>
#include <utility>

#include "swiftlet/file/output_file.hpp"

namespace swiftlet {

Status make_folder(const std::string& folder) {
  std::error_code refused;
  std::filesystem::create_directories(folder, refused);
  if (!refused) return Done{};
  return fail(ErrorCode::kIo, folder, "the folder cannot be made: " + refused.message(),
              "choose another");
}

Status write_text(const std::filesystem::path& path, std::string_view text) {
  auto file = OutputFile::create(path);
  if (!file) return forward_error(std::move(file));
  file->write(text);
  return file->commit();
}

}  // namespace swiftlet
