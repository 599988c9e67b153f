// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are a map file, with or without a log beside it. It is loaded, checked, counted and
// salvaged; what is salvaged is a sound map.
//
// Input: a byte (0 nothing, 1 a write-ahead log, 2 a rollback journal behind the map), the size of
// the map in 4 bytes, little endian; the map; the log.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "swiftlet/store/map_file/salvage.hpp"

namespace {

using namespace swiftlet;
namespace fs = std::filesystem;

/// In memory where there is such a folder: the disk is not what is tested.
fs::path make_folder() {
  std::string name = fs::exists("/dev/shm") ? "/dev/shm/map-fuzz-XXXXXX" : "/tmp/map-fuzz-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) std::abort();
  setenv("TMPDIR", name.c_str(), 1);
  return name;
}

void write(const fs::path& path, const std::uint8_t* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path folder = make_folder();
  if (size < 5) return 0;
  std::uint32_t length = 0;
  for (int i = 4; i > 0; --i) length = length << 8U | data[i];
  const std::size_t map_size = std::min<std::size_t>(length, size - 5);
  const fs::path path = folder / "a.swl", out = folder / "b.swl";
  for (const char* left : {"a.swl-wal", "a.swl-shm", "a.swl-journal", "b.swl", "b.swl-wal",
                           "b.swl-shm", "b.swl-journal"}) {
    fs::remove(folder / left);
  }
  write(path, data + 5, map_size);
  if (data[0] % 3 != 0) {
    write(path.string() + (data[0] % 3 == 1 ? "-wal" : "-journal"), data + 5 + map_size,
          size - 5 - map_size);
  }
  if (const auto map = load_map(path)) (void)summarize(*map);
  (void)check_map(path);
  const auto report = salvage_map(path, out);
  if (!report) return 0;
  (void)report->lines();
  if (!check_map(out).empty() || load_map(out)->block_count() != report->kept) std::abort();
  return 0;
}
