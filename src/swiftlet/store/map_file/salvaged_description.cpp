// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/salvaged_description.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/store/map_file/header_lines.hpp"

namespace swiftlet {
namespace {

/// Bytes of a description that are kept; half of what a reader takes, and some kilobytes are usual.
constexpr std::size_t kMostDescription = std::size_t{1} << 19U;

std::uint64_t digest_of(const MapMeta& meta) {
  std::uint64_t digest = 0;
  for (const auto& [key, value] : meta) digest += meta_checksum(key, value);
  return digest;
}

/// Takes out of a description what a reader would refuse, and tells it.
void make_readable(MapMeta& meta, double voxel_m, const DescriptionRemains& found,
                   std::vector<std::string>& notes) {
  std::size_t bytes = 0, left_out = 0;
  for (auto line = meta.begin(); line != meta.end();) {
    const std::size_t size = line->first.size() + line->second.size() + 1;
    const bool is_needed = line->first == "voxel_m" || line->first == "frames";
    const bool is_kept = is_needed ? size < 100 : bytes + size <= kMostDescription;
    left_out += is_kept ? 0 : 1;
    bytes += is_kept ? size : 0;
    line = is_kept ? std::next(line) : meta.erase(line);
  }
  if (left_out > 0) notes.emplace_back("its description is longer than any and is shortened");
  const auto start = meta.find("start_m");
  if (start != meta.end() && !place_from(start->second, voxel_m)) {
    meta.erase(start);
    notes.emplace_back("its start_m is no place in the world and is left out");
  }
  if (number_from<std::uint64_t>(meta["frames"])) return;
  meta["frames"] = std::to_string(found.newest_frame);
  notes.push_back(fmt::format("its number of frames is lost: {} is that of its newest block",
                              found.newest_frame));
}

/// Takes out the lines that tell the thresholds; whether there were any.
bool erase_thresholds(MapMeta& meta) {
  return meta.erase("config") + meta.erase("free_below") + meta.erase("occupied_from") > 0;
}

}  // namespace

Expected<MapMeta> salvaged_description(const DescriptionRemains& found,
                                       const std::filesystem::path& path,
                                       std::vector<std::string>& notes) {
  MapMeta meta = found.meta;
  const bool is_sound = found.checksum && digest_of(meta) == found.checksum->meta_digest;
  const auto voxel_m = number_from<double>(meta["voxel_m"]);
  if (!voxel_m || meta["voxel_m"].size() > 80 || !std::isfinite(*voxel_m) || *voxel_m <= 0.0) {
    return fail(
        ErrorCode::kCorruptInput, path.string(),
        fmt::format("{} blocks can be read, but not how large their voxels are", found.blocks),
        "nothing can be made of them");
  }
  make_readable(meta, *voxel_m, found, notes);
  if (is_sound) {
    if (!thresholds_from(meta, path.string()) && erase_thresholds(meta))
      notes.emplace_back("its thresholds cannot be meant; defaults stand in");
    return meta;
  }
  notes.push_back(fmt::format(
      "its description is damaged: a voxel size of {} m is what can be read of it", *voxel_m));
  if (erase_thresholds(meta))
    notes.emplace_back("its config and thresholds are left out; defaults stand in");
  const auto step = meta.find("logodds_per_step");
  if (step == meta.end()) return meta;
  const auto value = number_from<double>(step->second);
  if (!value || !std::isfinite(*value) || *value <= 0.0) meta.erase(step);
  return meta;
}

}  // namespace swiftlet
