// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// What a file holds that was packed as a whole by zstd, in a file of its own in the folder for
/// temporary files ($TMPDIR, else /tmp). It goes with its last user.
class UnpackedFile {
 public:
  explicit UnpackedFile(std::filesystem::path path) : path_(std::move(path)) {}
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;
  ~UnpackedFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The first bytes of what a packed file holds; fewer if it holds or tells fewer.
[[nodiscard]] std::vector<std::byte> unpacked_start(const ByteSource& packed, std::size_t bytes);

/// Those who ask for the same file share one copy, as long as one of them keeps it.
/// Errors: kNotFound, kIo (no space, too); kCorruptInput if it is damaged or cut off, or unpacks to
/// more than recordings do. Memory: some MiB. Thread safety: any.
[[nodiscard]] Expected<std::shared_ptr<const UnpackedFile>> unpacked_copy_of(
    const std::filesystem::path& path);

}  // namespace swiftlet
