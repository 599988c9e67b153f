// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Bytes that can be read at any place: a file, or memory in tests.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// What messages call it: its path.
  [[nodiscard]] virtual const std::string& name() const = 0;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Fills `out` from `offset` on. Errors: kIo; kCorruptInput if the source ends before.
  [[nodiscard]] virtual Status read(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

using ByteSourcePtr = std::unique_ptr<ByteSource>;

/// Opens a file for reading; it is read piece by piece, never as a whole. Errors: kNotFound, kIo.
[[nodiscard]] Expected<ByteSourcePtr> open_file_bytes(const std::filesystem::path& path);

/// Bytes in memory.
class MemoryBytes final : public ByteSource {
 public:
  explicit MemoryBytes(std::vector<std::byte> bytes, std::string name = "memory")
      : bytes_(std::move(bytes)), name_(std::move(name)) {}

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] Status read(std::uint64_t offset, std::span<std::byte> out) const override;

 private:
  std::vector<std::byte> bytes_;
  std::string name_;
};

}  // namespace swiftlet
