// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Writes the seeds of map_file_fuzz into the folder that is named: a map as a flight leaves it, one
// with its write-ahead log, and one with the journal of a transaction that was cut off.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "swiftlet/store/map_file/save_map.hpp"

namespace {

using namespace swiftlet;
namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_seed(const fs::path& path, char kind, const std::string& map, const std::string& log) {
  std::string seed(1, kind);
  for (int i = 0; i < 4; ++i) seed += static_cast<char>(map.size() >> (8 * i) & 0xff);
  std::ofstream(path, std::ios::binary) << seed << map << log;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const fs::path out(words[1]), map = out / "map.swl";
  BlockMap blocks({0.1, {}, 7, Eigen::Vector3d(0, 1, 2)});
  for (int i = 0; i < 40; ++i) {
    VoxelBlock block;
    block.voxels.fill(static_cast<QuantizedLogOdds>(100 + i));
    blocks.put({i, -i, i % 3}, block);
  }
  if (!save_map(map, blocks, {{"config", "map:\n  voxel_m: 0.1\n"}})) return 1;
  write_seed(out / "plain", 0, content_of(map), {});
  {
    auto file = MapFile::open_to_write(map, 0);
    if (!file || !file->begin() || !file->erase({0, 0, 0}) || !file->commit()) return 1;
    write_seed(out / "with_log", 1, content_of(map), content_of(map.string() + "-wal"));
    if (!file->finish()) return 1;
  }
  {
    auto database = sqlite::Database::open(map, sqlite::Database::Mode::kReadWrite);
    if (!database || !database->run("PRAGMA cache_size = 1; BEGIN IMMEDIATE;"
                                    "UPDATE blocks SET touched = 9")) {
      return 1;
    }
    write_seed(out / "with_journal", 2, content_of(map), content_of(map.string() + "-journal"));
  }
  fs::remove(map);
  return 0;
}
