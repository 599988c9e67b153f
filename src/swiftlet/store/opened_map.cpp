// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/opened_map.hpp"

#include <filesystem>
#include <utility>

#include "swiftlet/file/file_kind.hpp"
#include "swiftlet/store/export/octomap_blocks.hpp"
#include "swiftlet/store/map_file/save_map.hpp"

namespace swiftlet {
namespace {

Expected<OpenedMap> lay_out_octomap(const std::string& path) {
  auto laid_out = read_octomap_blocks(path, OccupancyThresholds{});
  if (!laid_out) return forward_error(std::move(laid_out));
  auto folder = PrivateFolder::create();
  if (!folder) return forward_error(std::move(folder));
  const auto copy = folder->path() / "map.swl";
  if (auto saved = save_map(copy, laid_out->blocks, {{"source", "OctoMap " + path}}); !saved)
    return forward_error(std::move(saved));
  auto map = load_map(copy);
  if (!map) return forward_error(std::move(map));
  return OpenedMap{std::move(*folder), std::move(*map)};
}

Expected<OpenedMap> salvage(const std::string& path) {
  auto found = load_salvaged(path);
  if (!found) return forward_error(std::move(found));
  auto& [map, report] = *found;
  return OpenedMap{std::nullopt, std::move(map), std::move(report)};
}

}  // namespace

Expected<OpenedMap> open_map(const std::string& path, bool is_salvaged) {
  auto facts = look_at_file(path);
  if (!facts) return forward_error(std::move(facts));
  if (facts->kind == FileKind::kOctomap) return lay_out_octomap(path);
  if (is_salvaged) return salvage(path);  // its first bytes may be damaged, too
  if (facts->kind != FileKind::kMap)
    return tl::make_unexpected(wrong_kind(path, *facts, "a map (.swl, .bt or .ot)"));
  auto map = load_map(path);
  if (!map) return forward_error(std::move(map));
  return OpenedMap{std::nullopt, std::move(*map)};
}

}  // namespace swiftlet
