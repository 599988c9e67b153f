// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The tables of a map file: how they are made, and how they are known again.

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "swiftlet/file/fresh_file.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;

// The schema is compared with these letters when a map is opened, so a damaged one is not followed.
constexpr const char* kBlocksTable =
    "CREATE TABLE blocks(z INTEGER NOT NULL, y INTEGER NOT NULL, x INTEGER NOT NULL, "
    "touched INTEGER NOT NULL, checksum INTEGER NOT NULL, data BLOB NOT NULL, "
    "PRIMARY KEY(z, y, x)) WITHOUT ROWID";
constexpr const char* kMetaTable =
    "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID";
constexpr const char* kChecksumTable =
    "CREATE TABLE seal(id INTEGER PRIMARY KEY, blocks INTEGER NOT NULL, "
    "block_digest INTEGER NOT NULL, meta_digest INTEGER NOT NULL)";

fs::path beside(const fs::path& path, const char* suffix) { return path.string() + suffix; }

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

/// The rows of `meta`, and the checksum over them.
Status write_description(const Database& database, const MapMeta& meta) {
  auto line = database.prepare("INSERT INTO meta VALUES(?1, ?2)");
  if (!line) return forward_error(std::move(line));
  std::uint64_t digest = 0;
  for (const auto& [key, value] : meta) {
    if (auto written = line->bind(1, key).bind(2, value).run(); !written) return written;
    digest += meta_checksum(key, value);
  }
  auto checksum = database.prepare("INSERT INTO seal VALUES(0, 0, 0, ?1)");
  if (!checksum) return forward_error(std::move(checksum));
  return checksum->bind(1, static_cast<std::int64_t>(digest)).run();
}

/// A map of no blocks, as bytes: it takes its name whole, and no journal lies beside it meanwhile.
Expected<std::vector<unsigned char>> empty_map(const fs::path& path, const MapMeta& meta) {
  auto database = Database::open(":memory:", Database::Mode::kCreate, path.string());
  if (!database) return forward_error(std::move(database));
  auto made = database->run(
      fmt::format("PRAGMA page_size = {}; PRAGMA application_id = {}; PRAGMA user_version = {}; "
                  "BEGIN; {}; {}; {}",
                  MapFile::kPageBytes, MapFile::kApplicationId, MapFile::kSchemaVersion,
                  kBlocksTable, kMetaTable, kChecksumTable));
  if (!made) return forward_error(std::move(made));
  if (auto written = write_description(*database, meta); !written) {
    return forward_error(std::move(written));
  }
  if (auto done = database->run("COMMIT"); !done) return forward_error(std::move(done));
  return database->image();
}

Status check_table(const Database& database, const char* name, const char* expected,
                   const fs::path& path) {
  auto sql = database.text(fmt::format("SELECT sql FROM sqlite_schema WHERE name = '{}'", name));
  if (!sql) return forward_error(std::move(sql));
  if (*sql == expected) return Done{};
  return fail(ErrorCode::kCorruptInput, path.string(),
              fmt::format("the table '{}' of the map is not as it should be", name));
}

}  // namespace

namespace {

constexpr std::array<const char*, 3> kLogs{"-shm", "-journal", "-wal"};

/// Whether the file says that it is a map of ours; it may be damaged all the same.
bool says_it_is_a_map(const fs::path& path) {
  constexpr std::size_t kIdAt = 68;
  std::array<char, 72> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  std::int64_t id = 0;
  for (std::size_t i = kIdAt; i < head.size(); ++i) id = id << 8 | (head[i] & 0xff);
  return file.good() && std::string_view(head.data(), 15) == "SQLite format 3" &&
         id == MapFile::kApplicationId;
}

/// A log that lies under the name of a new map would be replayed into it. One of the map that is
/// replaced goes with it; any other is somebody's data.
Status check_no_foreign_logs(const fs::path& path) {
  if (says_it_is_a_map(path)) return Done{};
  for (const char* suffix : kLogs) {
    std::error_code none;
    const fs::path log = beside(path, suffix);
    if (fs::symlink_status(log, none).type() == fs::file_type::not_found) continue;
    return fail(ErrorCode::kUsage, log.string(),
                "the log of another database lies where that of the map would",
                "move it away or choose another name for the map");
  }
  return Done{};
}

/// The lock of the file that is to be replaced; not held if there is none or it is read-only.
Expected<MapLock> lock_old_map(const fs::path& path, bool overwrite) {
  std::error_code none;
  const auto kind = fs::status(path, none).type();
  if (kind == fs::file_type::not_found || kind == fs::file_type::none) return MapLock{};
  if (auto writer = MapLock::holder(path)) return MapLock::refusal(path, *writer);
  if (!overwrite || kind != fs::file_type::regular) {
    return fail(ErrorCode::kUsage, path.string(), "it exists already",
                kind == fs::file_type::regular ? "choose another name or allow to overwrite it"
                                               : "choose the name of a file");
  }
  auto lock = MapLock::take(path);
  if (!lock && lock.error().code != ErrorCode::kUsage) return MapLock{};
  if (lock && !lock->is_lock_of(path)) {
    return fail(ErrorCode::kUsage, path.string(), "another program has just put a file there",
                "choose another name");
  }
  return lock;
}

Status put_in_place(const fs::path& fresh, const fs::path& path, bool replaces) {
  if (!replaces) return rename_if_free(fresh, path);
  // The log of an older map of that name must not be replayed into the new one.
  for (const char* suffix : kLogs) remove_quietly(beside(path, suffix));
  std::error_code error;
  fs::rename(fresh, path, error);
  if (!error) return Done{};
  return fail(ErrorCode::kIo, path.string(), "the map cannot be put there: " + error.message());
}

}  // namespace

Expected<MapLock> MapFile::create(const fs::path& path, bool overwrite, const MapMeta& meta) {
  const auto old = lock_old_map(path, overwrite);  // until the new one stands there
  if (!old) return tl::make_unexpected(old.error());
  std::error_code none;
  const bool replaces =
      overwrite && fs::symlink_status(path, none).type() != fs::file_type::not_found;
  if (auto free = check_no_foreign_logs(path); !free) return forward_error(std::move(free));
  auto bytes = empty_map(path, meta);
  if (!bytes) return forward_error(std::move(bytes));
  auto fresh = make_fresh_file(path, *bytes);
  if (!fresh) return forward_error(std::move(fresh));
  auto lock = MapLock::take(*fresh);
  Status placed = lock ? Status(Done{}) : Status(tl::make_unexpected(lock.error()));
  if (placed) placed = put_in_place(*fresh, path, replaces);
  if (placed) return lock;
  remove_quietly(*fresh);
  return forward_error(std::move(placed));
}

void MapFile::remove(const fs::path& path) {
  const auto writer = MapLock::holder(path);
  if (writer && writer->pid != getpid()) return;
  if (says_it_is_a_map(path)) {
    for (const char* suffix : kLogs) remove_quietly(beside(path, suffix));
  }
  remove_quietly(path);
}

Status MapFile::rename(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (auto writer = MapLock::holder(from)) return MapLock::refusal(from, *writer);
  // One file is renamed at once, a file and its log are not: in between, a kill would part them.
  const bool has_log = fs::exists(beside(from, "-wal"), error) ||  //
                       fs::exists(beside(from, "-journal"), error);
  if (has_log && says_it_is_a_map(from)) {
    if (auto file = open_to_write(from, 0)) (void)file->finish();  // if not, they are moved
  }
  fs::rename(from, to, error);
  if (error) {
    return fail(ErrorCode::kIo, from.string(),
                fmt::format("the map cannot be renamed to {}: {}", to.string(), error.message()));
  }
  for (const char* suffix : {"-wal", "-journal"}) {
    if (fs::exists(beside(from, suffix), error)) {
      fs::rename(beside(from, suffix), beside(to, suffix), error);
    }
  }
  remove_quietly(beside(from, "-shm"));  // only an index of -wal; made anew
  return Done{};
}

Status MapFile::check_identity() const {
  auto id = database_.integer("PRAGMA application_id");
  if (!id) return forward_error(std::move(id));
  if (*id != kApplicationId) {
    return fail(ErrorCode::kCorruptInput, path_.string(), "this is not a Swiftlet map");
  }
  auto version = database_.integer("PRAGMA user_version");
  if (!version) return forward_error(std::move(version));
  if (*version > kSchemaVersion) {
    return fail(ErrorCode::kUnsupported, path_.string(),
                fmt::format("the map is of version {}, this program reads up to version {}",
                            *version, kSchemaVersion),
                "use a newer Swiftlet");
  }
  if (*version < 1) {
    return fail(ErrorCode::kCorruptInput, path_.string(), "the map has no valid version");
  }
  for (const auto& [name, sql] : {std::pair{"blocks", kBlocksTable}, std::pair{"meta", kMetaTable},
                                  std::pair{"seal", kChecksumTable}}) {
    if (auto good = check_table(database_, name, sql, path_); !good) return good;
  }
  return Done{};
}

}  // namespace swiftlet
