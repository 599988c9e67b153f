// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/output_file.hpp"

#include <bit>
#include <cerrno>
#include <cstring>
#include <locale>
#include <system_error>
#include <utility>

namespace swiftlet {

OutputFile::OutputFile(std::filesystem::path path, std::filesystem::path temporary)
    : path_(std::move(path)),
      temporary_(std::move(temporary)),
      stream_(temporary_, std::ios::binary | std::ios::trunc) {
  stream_.imbue(std::locale::classic());  // no decimal comma of the host program
}

Expected<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  OutputFile file(path, path.string() + ".part");
  if (file.stream_) return file;
  const std::string reason = std::generic_category().message(errno);
  file.temporary_.clear();  // there is nothing to remove
  return fail(ErrorCode::kIo, path.string(), "the file cannot be written (" + reason + ")",
              "check that the folder exists and may be written");
}

OutputFile::~OutputFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

Status OutputFile::commit() {
  stream_.close();
  if (!stream_) {
    return fail(ErrorCode::kIo, path_.string(), "the file could not be written whole",
                "check the free space and quota of the disk");
  }
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) {
    return fail(ErrorCode::kIo, path_.string(), "the file cannot be put there: " + error.message());
  }
  temporary_.clear();
  return Done{};
}

void OutputFile::pack(const void* value, unsigned char* out, std::size_t size) {
  std::memcpy(out, value, size);
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t i = 0; i < size / 2; ++i) std::swap(out[i], out[size - 1 - i]);
  }
}

}  // namespace swiftlet
