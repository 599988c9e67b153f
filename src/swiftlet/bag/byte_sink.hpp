// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Where bytes go one after the other: a file, or memory in tests.
class ByteSink {
 public:
  virtual ~ByteSink() = default;
  /// When it returns, the bytes survive the end of the program. Errors: kIo.
  [[nodiscard]] virtual Status write(std::span<const std::uint8_t> bytes) = 0;
};

using ByteSinkPtr = std::unique_ptr<ByteSink>;

/// A new file at `path`; one that was there is gone. Errors: kIo.
[[nodiscard]] Expected<ByteSinkPtr> open_file_sink(const std::filesystem::path& path);

}  // namespace swiftlet
