// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/saved_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/store/map_file/block_codec.hpp"

namespace swiftlet {
namespace {

template <class T>
std::optional<T> number_of(const MapMeta& meta, const std::string& key) {
  const auto line = meta.find(key);
  if (line == meta.end()) return std::nullopt;
  return number_from<T>(line->second);
}

Status compare_seals(const MapSeal& found, const MapSeal& sealed, const std::string& where) {
  if (found.blocks == sealed.blocks && found.block_digest == sealed.block_digest) return Done{};
  return fail(ErrorCode::kCorruptInput, where,
              fmt::format("the map holds {} blocks, but {} were written or some were replaced",
                          found.blocks, sealed.blocks));
}

}  // namespace

std::optional<std::array<double, 3>> place_from(std::string_view text, double voxel_m) {
  constexpr double kMostVoxels = 2147483648.0;  // an index is an int32
  std::array<double, 3> place{};
  for (double& axis : place) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::size_t end = std::min(text.find(' '), text.size());
    const auto value = number_from<double>(text.substr(0, end));
    if (!value || !(std::abs(*value) < kMostVoxels * voxel_m)) return std::nullopt;
    axis = *value;
    text.remove_prefix(end);
  }
  if (text.find_first_not_of(' ') != std::string_view::npos) return std::nullopt;
  return place;
}

Expected<SavedMap> load_map(const std::filesystem::path& path) {
  return SavedMap::of(path, MapFile::open_to_read(path));
}

Expected<SavedMap> SavedMap::of(const std::filesystem::path& path, Expected<MapFile> opened) {
  if (!opened) return forward_error(std::move(opened));
  MapFile file = std::move(*opened);
  if (auto held = file.hold_view(); !held) return forward_error(std::move(held));
  auto meta = file.meta();
  if (!meta) return forward_error(std::move(meta));
  auto seal = file.seal();
  if (!seal) return forward_error(std::move(seal));
  const auto voxel_m = number_of<double>(*meta, "voxel_m");
  const auto frames = number_of<std::uint64_t>(*meta, "frames");
  const bool is_sane = voxel_m && frames && std::isfinite(*voxel_m) && *voxel_m > 0.0;
  if (!is_sane || seal->blocks < 0) {
    return fail(ErrorCode::kCorruptInput, path.string(),
                "the map does not say its cell size or its number of frames");
  }
  SavedMap map;
  if (const auto start = meta->find("start_m"); start != meta->end()) {
    map.start_m_ = place_from(start->second, *voxel_m);
    if (!map.start_m_) {
      return fail(ErrorCode::kCorruptInput, path.string(),
                  "its start_m is no place in the world: three numbers in metres are expected",
                  "--salvage reads the map without it");
    }
  }
  map.path_ = path;
  map.voxel_m_ = *voxel_m;
  map.frames_ = *frames;
  map.block_count_ = static_cast<std::uint64_t>(seal->blocks);
  map.meta_ = std::move(*meta);
  map.file_ = std::make_unique<MapFile>(std::move(file));
  return map;
}

Status SavedMap::for_each_block(const VisitBlock& visit) const {
  auto sealed = file_->seal();
  if (!sealed) return forward_error(std::move(sealed));
  BlockCodec codec;
  VoxelBlock block;
  MapSeal found;
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
  return compare_seals(found, *sealed, path_.string());
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

Expected<MapSummary> summarize(const SavedMap& map, const OccupancyThresholds& thresholds) {
  MapSummary summary;
  auto passed = map.for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    for (int offset = 0; offset < kBlockVoxels; ++offset) {
      const Occupancy state = thresholds.classify(block.cells[static_cast<std::size_t>(offset)]);
      ++summary.cells[static_cast<std::size_t>(state)];
      if (state == Occupancy::kUnknown) continue;
      const VoxelIndex v = voxel_at(index, offset);
      if (!summary.bounds) summary.bounds = VoxelBox{v, v};
      auto& [low, high] = *summary.bounds;
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
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
  MapSeal found;
  auto passed = file->for_each([&](const BlockRow& row) -> Status {
    if (auto fault = fault_of(row, codec, block)) add(std::move(*fault));
    ++found.blocks;
    found.block_digest += row.checksum;
    return Done{};
  });
  if (!passed) faults.push_back(std::move(passed).error());
  auto sealed = file->seal();
  if (!sealed) {
    faults.push_back(std::move(sealed).error());
  } else if (auto same = compare_seals(found, *sealed, path.string()); !same) {
    faults.push_back(std::move(same).error());
  }
  file->let_go_of_view();
  if (auto map = SavedMap::of(path, std::move(file)); !map) {
    faults.push_back(std::move(map).error());
  }
  return faults;
}

}  // namespace swiftlet
