// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// A process that writes a map.
struct MapWriter {
  std::int64_t pid = 0;
  std::string command;  ///< as it was called; empty if the system does not tell

  /// "process 4711: swiftlet map ..."
  [[nodiscard]] std::string text() const;
};

/// One writer a map file: a lock on the file itself (an open file description lock of Linux on a
/// byte that no map reaches), so it follows the file when it is renamed, and the kernel lets go of
/// it when the process ends, however it ends. Readers do not ask for it.
/// It must be released after the last database connection of this process to the file is closed.
class MapLock {
 public:
  MapLock() = default;
  /// Errors: kUsage naming the writer if there is one; kNotFound, kIo.
  [[nodiscard]] static Expected<MapLock> take(const std::filesystem::path& path);
  /// Who holds the lock of the file `path`; nobody if there is no such file.
  [[nodiscard]] static std::optional<MapWriter> holder(const std::filesystem::path& path);
  /// What refuses to touch a map that is being written.
  [[nodiscard]] static tl::unexpected<Error> refusal(const std::filesystem::path& path,
                                                     const MapWriter& writer);

  MapLock(MapLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  MapLock& operator=(MapLock&& other) noexcept;
  ~MapLock() { release(); }

  [[nodiscard]] bool is_held() const { return file_ >= 0; }
  /// Whether `path` is still the name of the file that is locked.
  [[nodiscard]] bool is_lock_of(const std::filesystem::path& path) const;
  void release();

 private:
  int file_ = -1;
};

}  // namespace swiftlet
