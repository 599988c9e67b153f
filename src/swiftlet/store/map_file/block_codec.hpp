// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/voxel_block.hpp"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace swiftlet {

/// Checksum of a stored block: its place, its age and its compressed bytes, so that no bit of a row
/// can change unseen. On disk: never change it within a schema version (docs/formats/map_file.md).
[[nodiscard]] std::uint64_t block_checksum(const BlockIndex& index, std::int64_t touched,
                                           std::span<const std::uint8_t> data);
/// Checksum of a line of the table `meta`.
[[nodiscard]] std::uint64_t meta_checksum(std::string_view key, std::string_view value);

/// Blocks to compressed bytes and back: one zstd frame, level 1, with content size and checksum.
/// Thread safety: one thread at a time. Does not allocate after its first use.
class BlockCodec {
 public:
  static constexpr std::size_t kMaxBytes = 640;  ///< ZSTD_compressBound(512) and the checksum

  BlockCodec();

  /// Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> compress(const VoxelBlock& block);
  /// False unless the bytes are one whole frame of exactly 512 voxels with a good checksum.
  [[nodiscard]] bool decompress(std::span<const std::uint8_t> data, VoxelBlock& out);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
    void operator()(ZSTD_DCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> compressor_;
  std::unique_ptr<ZSTD_DCtx_s, Free> decompressor_;
  std::array<std::uint8_t, kMaxBytes> buffer_{};
};

}  // namespace swiftlet
