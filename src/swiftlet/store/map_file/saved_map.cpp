// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/saved_map.hpp"

#include <fmt/format.h>

#include <utility>

#include "swiftlet/store/map_file/block_codec.hpp"
#include "swiftlet/store/map_file/header_lines.hpp"

namespace swiftlet {
namespace {

Status compare_checksums(const MapChecksum& found, const MapChecksum& written,
                         const std::string& where) {
  if (found.blocks == written.blocks && found.block_digest == written.block_digest) return Done{};
  return fail(ErrorCode::kCorruptInput, where,
              fmt::format("the map holds {} blocks, but {} were written or some were replaced",
                          found.blocks, written.blocks));
}

}  // namespace

Expected<SavedMap> load_map(const std::filesystem::path& path) {
  return SavedMap::of(path, MapFile::open_to_read(path));
}

Expected<SavedMap> SavedMap::of(const std::filesystem::path& path, Expected<MapFile> opened) {
  if (!opened) return forward_error(std::move(opened));
  MapFile file = std::move(*opened);
  if (auto held = file.hold_view(); !held) return forward_error(std::move(held));
  auto meta = file.meta();
  if (!meta) return forward_error(std::move(meta));
  auto checksum = file.checksum();
  if (!checksum) return forward_error(std::move(checksum));
  if (checksum->blocks < 0)
    return fail(ErrorCode::kCorruptInput, path.string(), "the map counts less than no blocks");
  auto header = header_from(*meta, path.string());
  if (!header) return forward_error(std::move(header));
  SavedMap map;
  map.path_ = path;
  map.header_ = *header;
  map.block_count_ = static_cast<std::uint64_t>(checksum->blocks);
  map.meta_ = std::move(*meta);
  map.file_ = std::make_unique<MapFile>(std::move(file));
  return map;
}

Status SavedMap::for_each_block(const VisitBlock& visit) const {
  auto written = file_->checksum();
  if (!written) return forward_error(std::move(written));
  BlockCodec codec;
  VoxelBlock block;
  MapChecksum found;
  auto passed = file_->for_each([&](const BlockRow& row) -> Status {
    if (const auto fault = fault_of(row, codec, block)) {
      return fail(ErrorCode::kCorruptInput, path_.string(), *fault,
                  "`swiftlet check` lists all, --salvage reads the rest");
    }
    ++found.blocks;
    found.block_digest += row.checksum;
    return visit(row.index, block);
  });
  if (!passed) return passed;
  return compare_checksums(found, *written, path_.string());
}

Expected<std::optional<VoxelBlock>> SavedMap::find(const BlockIndex& index) const {
  BlockCodec codec;
  VoxelBlock block;
  auto found = file_->read(index, [&](const BlockRow& row) -> Status {
    if (const auto fault = fault_of(row, codec, block)) {
      return fail(ErrorCode::kCorruptInput, path_.string(), *fault,
                  "`swiftlet check` lists all, --salvage reads the rest");
    }
    return Done{};
  });
  if (!found) return forward_error(std::move(found));
  return *found ? std::optional(block) : std::nullopt;
}

Expected<MapSummary> summarize(const SavedMap& map) {
  MapSummary summary;
  auto passed = map.for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    summary.add(index, block, map.thresholds());
    return Done{};
  });
  if (!passed) return forward_error(std::move(passed));
  return summary;
}

std::vector<Error> check_map(const std::filesystem::path& path) {
  std::vector<Error> faults;
  const auto add = [&](std::string what) {
    faults.push_back({ErrorCode::kCorruptInput, path.string(), std::move(what), {}});
  };
  auto file = MapFile::open_to_read(path);
  if (!file) return {std::move(file).error()};
  if (auto held = file->hold_view(); !held) return {std::move(held).error()};
  if (auto complaints = file->integrity_faults(); !complaints) {
    faults.push_back(std::move(complaints).error());
  } else {
    for (const std::string& complaint : *complaints) add("SQLite: " + complaint);
  }

  BlockCodec codec;
  VoxelBlock block;
  MapChecksum found;
  auto passed = file->for_each([&](const BlockRow& row) -> Status {
    if (auto fault = fault_of(row, codec, block)) add(std::move(*fault));
    ++found.blocks;
    found.block_digest += row.checksum;
    return Done{};
  });
  if (!passed) faults.push_back(std::move(passed).error());
  auto written = file->checksum();
  if (!written) {
    faults.push_back(std::move(written).error());
  } else if (auto same = compare_checksums(found, *written, path.string()); !same) {
    faults.push_back(std::move(same).error());
  }
  file->let_go_of_view();
  if (auto map = SavedMap::of(path, std::move(file)); !map) {
    faults.push_back(std::move(map).error());
  }
  return faults;
}

}  // namespace swiftlet
