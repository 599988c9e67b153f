// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The tables of a map file: how they are made, and how they are known again.

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "swiftlet/store/map_file.hpp"

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
constexpr const char* kSealTable =
    "CREATE TABLE seal(id INTEGER PRIMARY KEY, blocks INTEGER NOT NULL, "
    "block_digest INTEGER NOT NULL, meta_digest INTEGER NOT NULL)";
fs::path beside(const fs::path& path, const char* suffix) { return path.string() + suffix; }

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

/// The rows of `meta`, and the seal over them.
Status write_description(const Database& database, const MapMeta& meta) {
  auto line = database.prepare("INSERT INTO meta VALUES(?1, ?2)");
  if (!line) return forward_error(std::move(line));
  std::uint64_t digest = 0;
  for (const auto& [key, value] : meta) {
    if (auto written = line->bind(1, key).bind(2, value).run(); !written) return written;
    digest += meta_checksum(key, value);
  }
  auto seal = database.prepare("INSERT INTO seal VALUES(0, 0, 0, ?1)");
  if (!seal) return forward_error(std::move(seal));
  return seal->bind(1, static_cast<std::int64_t>(digest)).run();
}

Status write_empty_map(const fs::path& path, const MapMeta& meta) {
  auto database = Database::open(path, Database::Mode::kCreate);
  if (!database) return forward_error(std::move(database));
  auto made = database->run(
      fmt::format("PRAGMA page_size = {}; PRAGMA application_id = {}; PRAGMA user_version = {}; "
                  "BEGIN; {}; {}; {}",
                  MapFile::kPageBytes, MapFile::kApplicationId, MapFile::kSchemaVersion,
                  kBlocksTable, kMetaTable, kSealTable));
  if (!made) return made;
  if (auto written = write_description(*database, meta); !written) return written;
  return database->run("COMMIT");
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

Status MapFile::create(const fs::path& path, bool overwrite, const MapMeta& meta) {
  std::error_code error;
  const auto kind = fs::status(path, error).type();
  if (fs::exists(path, error) && (!overwrite || kind != fs::file_type::regular)) {
    return fail(ErrorCode::kUsage, path.string(), "it exists already",
                kind == fs::file_type::regular ? "choose another name or allow to overwrite it"
                                               : "choose the name of a file");
  }
  const fs::path fresh = beside(path, ".new");
  remove_quietly(fresh);
  if (auto written = write_empty_map(fresh, meta); !written) {
    remove_quietly(fresh);
    remove_quietly(beside(fresh, "-journal"));
    return written;
  }
  // The log of an older map of that name must not be replayed into the new one.
  for (const char* suffix : {"-wal", "-shm", "-journal"}) remove_quietly(beside(path, suffix));
  fs::rename(fresh, path, error);
  if (error) {
    remove_quietly(fresh);
    return fail(ErrorCode::kIo, path.string(), "the map cannot be put there: " + error.message());
  }
  return Done{};
}

void MapFile::remove(const fs::path& path) {
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) remove_quietly(beside(path, suffix));
}

Status MapFile::rename(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) {
    return fail(ErrorCode::kIo, from.string(),
                fmt::format("the map cannot be renamed to {}: {}", to.string(), error.message()));
  }
  for (const char* suffix : {"-wal", "-journal"}) {  // of a writer that was killed
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
                                  std::pair{"seal", kSealTable}}) {
    if (auto good = check_table(database_, name, sql, path_); !good) return good;
  }
  return Done{};
}

}  // namespace swiftlet
