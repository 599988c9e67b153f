// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/save_map.hpp"

#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/store/map_file/block_codec.hpp"
#include "swiftlet/store/map_file/header_lines.hpp"

namespace swiftlet {
namespace {

Status fill(const std::filesystem::path& path, const BlockMap& map, std::int64_t frames,
            MapLock lock) {
  auto file = MapFile::open_to_write(path, 0, std::move(lock));
  if (!file) return forward_error(std::move(file));
  auto checksum = file->checksum();
  if (!checksum) return forward_error(std::move(checksum));
  if (auto begun = file->begin(); !begun) return begun;
  BlockCodec codec;
  for (const BlockIndex& index : map.sorted_blocks()) {
    BlockRow row{index, frames, 0, codec.compress(*map.find(index))};
    row.checksum = block_checksum(row.index, row.touched, row.data);
    if (auto done = file->put(row); !done) return done;
    ++checksum->blocks;
    checksum->block_digest += row.checksum;
  }
  if (auto done = file->put_checksum(*checksum); !done) return done;
  if (auto done = file->commit(); !done) return done;
  return file->finish();
}

}  // namespace

Status save_map(const std::filesystem::path& path, const BlockMap& map, MapMeta meta) {
  put_header(map.header(), meta);
  auto lock = MapFile::create(path, false, meta);
  if (!lock) return forward_error(std::move(lock));
  const auto frames = number_from<std::int64_t>(meta.at("frames")).value_or(0);
  Status written = fill(path, map, frames, std::move(*lock));
  if (!written) MapFile::remove(path);
  return written;
}

}  // namespace swiftlet
