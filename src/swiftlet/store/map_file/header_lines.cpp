// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/header_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/file/yaml_document_private.hpp"

namespace swiftlet {
namespace {

constexpr const char* kFreeBelow = "free_below";
constexpr const char* kOccupiedFrom = "occupied_from";
constexpr const char* kLogoddsPerStep = "logodds_per_step";

template <class T>
std::optional<T> number_of(const MapMeta& meta, const std::string& key) {
  const auto line = meta.find(key);
  if (line == meta.end()) return std::nullopt;
  return number_from<T>(line->second);
}

auto corrupt(const std::string& path, std::string what) {
  return fail(ErrorCode::kCorruptInput, path, std::move(what),
              "--salvage reads the map without it");
}

bool is_sane(const OccupancyThresholds& t) {
  return t.free_below >= 1 && t.free_below <= kUnknownVoxel && t.occupied_from > kUnknownVoxel &&
         t.occupied_from <= kOccupiedVoxel;
}

/// Older files tell them in their config alone, of which nothing else is read here: its other
/// parameters come and go with the versions of the program.
Expected<OccupancyThresholds> thresholds_in_config(const std::string& yaml,
                                                   const std::string& path) {
  auto root = parse_yaml(yaml, path + ": config");
  if (!root) return corrupt(path, "its config cannot be read: " + root.error().text());
  OccupancyThresholds thresholds;
  try {
    if (!root->IsMap()) return thresholds;
    const YAML::Node group = std::as_const(*root)["occupancy"];
    if (!group.IsDefined() || !group.IsMap()) return thresholds;
    if (const YAML::Node value = group[kFreeBelow]) thresholds.free_below = value.as<int>();
    if (const YAML::Node value = group[kOccupiedFrom]) thresholds.occupied_from = value.as<int>();
  } catch (const YAML::Exception& fault) {
    return corrupt(path,
                   std::string("the thresholds in its config cannot be read: ") + fault.what());
  }
  if (!is_sane(thresholds)) return corrupt(path, "the thresholds in its config cannot be meant");
  return thresholds;
}

}  // namespace

std::optional<Eigen::Vector3d> place_from(std::string_view text, double voxel_m) {
  constexpr double kMostVoxels = 2147483648.0;  // an index is an int32
  Eigen::Vector3d place;
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

Expected<OccupancyThresholds> thresholds_from(const MapMeta& meta, const std::string& path) {
  if (meta.contains(kFreeBelow) || meta.contains(kOccupiedFrom)) {
    const OccupancyThresholds thresholds{number_of<int>(meta, kFreeBelow).value_or(0),
                                         number_of<int>(meta, kOccupiedFrom).value_or(0)};
    if (is_sane(thresholds)) return thresholds;
    return corrupt(path, "its thresholds (free_below, occupied_from) cannot be meant");
  }
  const auto config = meta.find("config");
  if (config == meta.end()) return OccupancyThresholds{};
  return thresholds_in_config(config->second, path);
}

Expected<MapHeader> header_from(const MapMeta& meta, const std::string& path) {
  const auto voxel_m = number_of<double>(meta, "voxel_m");
  const auto frames = number_of<std::uint64_t>(meta, "frames");
  if (!voxel_m || !frames || !std::isfinite(*voxel_m) || *voxel_m <= 0.0) {
    return fail(ErrorCode::kCorruptInput, path,
                "the map does not say its voxel size or its number of frames");
  }
  MapHeader header{*voxel_m, {}, *frames};
  auto thresholds = thresholds_from(meta, path);
  if (!thresholds) return forward_error(std::move(thresholds));
  header.scale.thresholds = *thresholds;
  if (const auto step = number_of<double>(meta, kLogoddsPerStep);
      step && std::isfinite(*step) && *step > 0.0) {
    header.scale.logodds_per_step = *step;
  }
  if (const auto start = meta.find("start_m"); start != meta.end()) {
    header.start_m = place_from(start->second, *voxel_m);
    if (!header.start_m) {
      return corrupt(path,
                     "its start_m is no place in the world: three numbers in metres are expected");
    }
  }
  return header;
}

void put_header(const MapHeader& header, MapMeta& meta) {
  meta["voxel_m"] = fmt::format("{}", header.voxel_m);
  if (header.frame_count > 0 || !meta.contains("frames"))
    meta["frames"] = std::to_string(header.frame_count);
  meta[kFreeBelow] = std::to_string(header.scale.thresholds.free_below);
  meta[kOccupiedFrom] = std::to_string(header.scale.thresholds.occupied_from);
  meta[kLogoddsPerStep] = fmt::format("{}", header.scale.logodds_per_step);
  if (const auto& at = header.start_m)
    meta["start_m"] = fmt::format("{} {} {}", at->x(), at->y(), at->z());
}

}  // namespace swiftlet
