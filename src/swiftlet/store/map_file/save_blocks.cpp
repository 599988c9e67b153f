// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/save_blocks.hpp"

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/number_text.hpp"
#include "swiftlet/store/map_file/block_codec.hpp"

namespace swiftlet {
namespace {

Status fill(const std::filesystem::path& path,
            std::span<const std::pair<BlockIndex, VoxelBlock>> blocks, std::int64_t frames,
            MapLock lock) {
  auto file = MapFile::open_to_write(path, 0, std::move(lock));
  if (!file) return forward_error(std::move(file));
  auto seal = file->seal();
  if (!seal) return forward_error(std::move(seal));
  if (auto begun = file->begin(); !begun) return begun;
  BlockCodec codec;
  for (const auto& [index, block] : blocks) {
    BlockRow row{index, frames, 0, codec.compress(block)};
    row.checksum = block_checksum(row.index, row.touched, row.data);
    if (auto done = file->put(row); !done) return done;
    ++seal->blocks;
    seal->block_digest += row.checksum;
  }
  if (auto done = file->put_seal(*seal); !done) return done;
  if (auto done = file->commit(); !done) return done;
  return file->finish();
}

}  // namespace

Status save_blocks(const std::filesystem::path& path,
                   std::span<const std::pair<BlockIndex, VoxelBlock>> blocks, const MapMeta& meta) {
  SWIFTLET_REQUIRE(meta.contains("voxel_m") && meta.contains("frames"),
                   "a map tells its cell size and its frames");
  auto lock = MapFile::create(path, false, meta);
  if (!lock) return forward_error(std::move(lock));
  const auto frames = number_from<std::int64_t>(meta.at("frames")).value_or(0);
  Status written = fill(path, blocks, frames, std::move(*lock));
  if (!written) MapFile::remove(path);
  return written;
}

}  // namespace swiftlet
