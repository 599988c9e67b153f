// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// How a map file is opened and closed. What lies in it is in map_file.cpp.

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <system_error>
#include <utility>

#include "swiftlet/store/map_file/map_file.hpp"
#include "swiftlet/store/map_file/recovered_map.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::Statement;

// Made only for maps with a byte cap, which need to find the oldest blocks.
constexpr const char* kAgeIndex =
    "CREATE INDEX IF NOT EXISTS blocks_by_age ON blocks(touched, z, y, x)";

/// Whether SQLite may keep an index of the log beside the file, whatever links lead to it.
bool may_write_beside(const fs::path& path) {
  std::error_code none;
  const fs::path real = fs::canonical(path, none);
  if (none) return false;
  const fs::path index = real.string() + "-shm";
  return access(real.parent_path().c_str(), W_OK) == 0 &&
         (!fs::exists(index, none) || access(index.c_str(), W_OK) == 0);
}

/// Whether a map that was cut off has lost its log, as when it was copied without. SQLite would
/// make a new one, and an index of it, and leave both.
bool has_lost_its_log(const fs::path& path) {
  constexpr std::size_t kReadVersionAt = 19;  // of the header: 2 asks for a log
  std::array<char, kReadVersionAt + 1> head{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(head.data(), head.size()) || head[kReadVersionAt] != 2) return false;
  std::error_code none;
  const fs::path real = fs::canonical(path, none);
  return !none && !fs::exists(real.string() + "-wal", none) && !has_logs(path);
}

}  // namespace

Expected<MapFile> MapFile::open_to_read(const fs::path& path, const fs::path& shown_as) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    return fail(ErrorCode::kNotFound, path.string(), "there is no such map");
  }
  if (!fs::is_regular_file(path, error)) {
    return fail(ErrorCode::kCorruptInput, path.string(), "this is not a file");
  }
  if (!shown_as.empty()) {
    return with(shown_as, Database::open(path, Database::Mode::kReadOnly, shown_as.string()));
  }
  const auto writer = writer_of(path);
  // To SQLite, reading a log is to write an index of it; where it may not, it waits long in vain.
  const bool is_alone = !writer && (!may_write_beside(path) || has_lost_its_log(path));
  if (is_alone && has_logs(path)) return with(path, open_recovered(path));
  // On read-only media nobody writes: without logs the file is the map. So it is where its log is
  // lost; a flight that takes it up meanwhile only moves it aside.
  if (is_alone) return with(path, Database::open(path, Database::Mode::kImmutable));
  auto file = with(path, Database::open(path, Database::Mode::kReadOnly));
  if (file || file.error().code != ErrorCode::kIo) return file;
  // To copy the file of a writer in this process would cost it its locks.
  if (writer && writer->pid == getpid()) return file;
  auto copy = with(path, open_recovered(path));
  return copy ? std::move(copy) : std::move(file);
}

Expected<MapFile> MapFile::with(const fs::path& path, Expected<Database> database) {
  if (!database) return forward_error(std::move(database));
  MapFile file;
  file.path_ = path;
  file.database_ = std::move(*database);
  if (auto mine = file.check_identity(); !mine) return forward_error(std::move(mine));
  if (auto ready = file.prepare_reading(); !ready) return forward_error(std::move(ready));
  return file;
}

Expected<MapFile> MapFile::open_to_write(const fs::path& path, std::uint64_t max_bytes,
                                         MapLock lock) {
  MapFile file;
  file.path_ = path;
  file.lock_ = std::move(lock);
  if (!file.lock_.is_held()) {
    auto taken = MapLock::take(path);
    if (!taken) return forward_error(std::move(taken));
    file.lock_ = std::move(*taken);
  }
  auto database = Database::open(path, Database::Mode::kReadWrite);
  if (!database) return forward_error(std::move(database));
  file.database_ = std::move(*database);
  if (auto mine = file.check_identity(); !mine) return forward_error(std::move(mine));
  auto mode = file.database_.text("PRAGMA journal_mode = WAL");
  if (!mode) return forward_error(std::move(mode));
  if (*mode != "wal") {
    return fail(ErrorCode::kIo, path.string(), "this file system cannot hold a write-ahead log",
                "write the map to a local disk");
  }
  // FULL: a drone loses its power when it crashes, which is when its map is wanted.
  std::string settings = "PRAGMA synchronous = FULL; PRAGMA journal_size_limit = 8388608;";
  if (max_bytes > 0) {
    settings += fmt::format("PRAGMA max_page_count = {}; {};",
                            max_bytes / static_cast<std::uint64_t>(kPageBytes), kAgeIndex);
  }
  if (auto set = file.database_.run(settings); !set) return forward_error(std::move(set));
  if (auto ready = file.prepare_reading(); !ready) return forward_error(std::move(ready));
  if (auto ready = file.prepare_writing(); !ready) return forward_error(std::move(ready));
  return file;
}

namespace {

Status prepare_each(const Database& database,
                    std::initializer_list<std::pair<Statement*, const char*>> statements) {
  for (const auto& [statement, sql] : statements) {
    auto prepared = database.prepare(sql);
    if (!prepared) return forward_error(std::move(prepared));
    *statement = std::move(*prepared);
  }
  return Done{};
}

}  // namespace

// SQLite tells the length of a blob without reading it: one that is too long to be a block
// (BlockCodec::kMaxBytes) may be a loop of pages.
Status MapFile::prepare_reading() {
  static_assert(BlockCodec::kMaxBytes == 640);
  return prepare_each(
      database_, {{&read_,
                   "SELECT z, y, x, touched, checksum, CASE WHEN length(data) <= 640 THEN data END "
                   "FROM blocks WHERE z = ?1 AND y = ?2 AND x = ?3"},
                  {&all_,
                   "SELECT z, y, x, touched, checksum, CASE WHEN length(data) <= 640 THEN data END "
                   "FROM blocks ORDER BY z, y, x"}});
}

Status MapFile::prepare_writing() {
  return prepare_each(
      database_,
      {{&put_, "INSERT OR REPLACE INTO blocks VALUES(?1, ?2, ?3, ?4, ?5, ?6)"},
       {&erase_, "DELETE FROM blocks WHERE z = ?1 AND y = ?2 AND x = ?3"},
       {&put_meta_, "INSERT OR REPLACE INTO meta VALUES(?1, ?2)"},
       {&put_checksum_,
        "UPDATE seal SET blocks = ?1, block_digest = ?2, meta_digest = ?3 WHERE id = 0"},
       {&oldest_,
        "SELECT z, y, x, touched, 0, NULL FROM blocks ORDER BY touched, z, y, x LIMIT ?1"},
       {&page_count_, "PRAGMA page_count"},
       {&free_pages_, "PRAGMA freelist_count"}});
}

void MapFile::close() {
  for (Statement* statement : {&read_, &all_, &put_, &erase_, &put_meta_, &put_checksum_, &oldest_,
                               &page_count_, &free_pages_}) {
    *statement = Statement{};
  }
  database_.close();
  lock_.release();
}

Status MapFile::finish() {
  auto mode = database_.text("PRAGMA journal_mode = DELETE");
  close();
  if (mode && *mode == "delete") return Done{};
  const std::string reason = mode ? "" : " (" + mode.error().what + ")";
  return fail(ErrorCode::kIo, path_.string(),
              "the write-ahead log cannot be folded into the map" + reason,
              "nothing is lost: keep the file with -wal at its end beside the map");
}

}  // namespace swiftlet
