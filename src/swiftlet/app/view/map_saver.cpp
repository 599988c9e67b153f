// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/map_saver.hpp"

#include <filesystem>
#include <fstream>
#include <utility>

#include "swiftlet/file/private_folder.hpp"
#include "swiftlet/store/map_file/save_map.hpp"

namespace swiftlet::app {
namespace {

Expected<std::vector<std::uint8_t>> read_bytes(const std::filesystem::path& path) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  std::vector<std::uint8_t> bytes(none ? 0 : size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (none || !file) return fail(ErrorCode::kIo, path.string(), "cannot be read back");
  return bytes;
}

}  // namespace

station::MapSaver map_saver(MapMeta meta) {
  return [meta = std::move(meta)](const BlockMap& map) -> Expected<std::vector<std::uint8_t>> {
    const auto folder = PrivateFolder::create();
    if (!folder) return tl::make_unexpected(folder.error());
    const auto path = folder->path() / "map.swl";
    if (auto saved = save_map(path, map, meta); !saved) return forward_error(std::move(saved));
    return read_bytes(path);
  };
}

}  // namespace swiftlet::app
