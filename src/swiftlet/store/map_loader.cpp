// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_loader.hpp"

#include <utility>

#include "swiftlet/store/opened_map.hpp"

namespace swiftlet {

Expected<BlockMap> read_whole_map(const SavedMap& saved) {
  BlockMap map(saved.header());
  auto read = saved.for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    map.put(index, block);
    return Done{};
  });
  if (!read) return forward_error(std::move(read));
  return map;
}

Expected<BlockMap> read_whole_map(const std::string& path, bool is_salvaged) {
  auto opened = open_map(path, is_salvaged);
  if (!opened) return forward_error(std::move(opened));
  return read_whole_map(opened->file);
}

}  // namespace swiftlet
