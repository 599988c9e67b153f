// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/sqlite.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/file/sqlite_uri.hpp"

namespace swiftlet::sqlite {
namespace {

constexpr int kBusyTimeout_ms = 1000;
constexpr int kLongestValue = 16 << 20;  // a config is some kilobytes
constexpr auto kNoSize = static_cast<std::uintmax_t>(-1);

std::string system_reason(sqlite3* connection) {
  const int number = connection == nullptr ? 0 : sqlite3_system_errno(connection);
  return number == 0 ? std::string{}
                     : std::string(" (") + std::generic_category().message(number) + ")";
}

tl::unexpected<Error> failure(sqlite3* connection, int code, const std::string& where) {
  const std::string reason = system_reason(connection);
  switch (code & 0xff) {
    case SQLITE_FULL:
      return fail(ErrorCode::kIo, where, "there is no space left for the map" + reason,
                  "free some space or set a byte cap");
    case SQLITE_CANTOPEN:
      return fail(ErrorCode::kIo, where, "the map cannot be opened or created" + reason,
                  "check that the folder exists and may be written");
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return fail(ErrorCode::kIo, where, "the map may not be written" + reason,
                  "check the permissions of the file and of its folder");
    case SQLITE_PROTOCOL:  // the index of a log that may only be read, and whose writer is gone
      return fail(ErrorCode::kIo, where, "the map cannot be locked to be read" + reason,
                  "check the permissions of the file and of its folder");
    case SQLITE_IOERR:
      return fail(ErrorCode::kIo, where, "the disk refused to read or write the map" + reason,
                  "check the free space, quota and health of the disk");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return fail(ErrorCode::kIo, where, "the map is in use by another program",
                  "close it there and try again");
    case SQLITE_NOTADB:
      return fail(ErrorCode::kCorruptInput, where, "this is not a Swiftlet map");
    case SQLITE_CORRUPT:
    case SQLITE_FORMAT:
      return fail(ErrorCode::kCorruptInput, where, "the map file is damaged",
                  "`swiftlet check` lists what is, --salvage reads the rest");
    case SQLITE_INTERRUPT:  // the budget of work
    case SQLITE_TOOBIG:
      return fail(ErrorCode::kCorruptInput, where,
                  "the map file is damaged: there is no end to what its size could not hold",
                  "--salvage reads what is sound");
    default:
      break;
  }
  const char* text = connection == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(connection);
  return fail(ErrorCode::kCorruptInput, where, std::string("the map cannot be read: ") + text);
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
void Database::Close::operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }

Statement& Statement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), parameter, value);
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view text) {
  sqlite3_bind_text(statement_.get(), parameter, text.data(), to<int>(text.size()), SQLITE_STATIC);
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::uint8_t> bytes) {
  sqlite3_bind_blob(statement_.get(), parameter, bytes.data(), to<int>(bytes.size()),
                    SQLITE_STATIC);
  return *this;
}

Expected<bool> Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  auto error = failure(sqlite3_db_handle(statement_.get()), code, where_);
  reset();
  return error;
}

Status Statement::run() {
  if (auto stepped = step(); !stepped) return forward_error(std::move(stepped));
  reset();
  return Done{};
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  if (budget_) budget_->left = budget_->whole;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string_view Statement::text(int column) const {
  const std::span<const std::uint8_t> raw = bytes(column);
  // Bytes as characters: the one place where SQLite's view of text meets ours.
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

std::span<const std::uint8_t> Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  if (data == nullptr || size <= 0) return {};
  return {static_cast<const std::uint8_t*>(data), static_cast<std::size_t>(size)};
}

Expected<Database> Database::open(const std::filesystem::path& path, Mode mode,
                                  const std::string& where) {
  int flags = SQLITE_OPEN_READONLY;
  if (mode == Mode::kReadWrite) flags = SQLITE_OPEN_READWRITE;
  if (mode == Mode::kCreate) flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  Database database;
  database.where_ = where.empty() ? path.string() : where;
  std::string name = path.string();
  if (mode == Mode::kImmutable) {
    flags |= SQLITE_OPEN_URI;
    name = sqlite_uri(path, "immutable=1");
  }
  sqlite3* connection = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &connection, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  database.connection_.reset(connection);
  if (code != SQLITE_OK) return failure(connection, code, database.where_);
  sqlite3_busy_timeout(connection, kBusyTimeout_ms);
  sqlite3_extended_result_codes(connection, 1);
  // A map from elsewhere is data, not program: nothing in its schema may run.
  sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  if (mode == Mode::kReadOnly || mode == Mode::kImmutable) {
    std::error_code none;
    const auto bytes = std::filesystem::file_size(path, none);
    const auto log = std::filesystem::file_size(path.string() + "-wal", none);
    database.limit_work((bytes == kNoSize ? 0 : bytes) + (log == kNoSize ? 0 : log));
  }
  return database;
}

void Database::limit_work(std::uint64_t bytes) {
  // A row takes some 25 bytes at least, and SQLite's integrity check some 25 steps a row.
  constexpr std::int64_t kBase = 5'000'000;
  constexpr std::int64_t kPerByte = 4;
  constexpr int kEvery = 1000;
  budget_ = std::make_shared<WorkBudget>();
  const auto size = static_cast<std::int64_t>(std::min<std::uint64_t>(bytes, 1ULL << 48U));
  budget_->whole = kBase + kPerByte * size;
  budget_->left = budget_->whole;
  sqlite3_limit(connection_.get(), SQLITE_LIMIT_LENGTH, kLongestValue);
  sqlite3_progress_handler(
      connection_.get(), kEvery,
      [](void* budget) {
        auto& left = static_cast<WorkBudget*>(budget)->left;
        left -= kEvery;
        return left < 0 ? 1 : 0;
      },
      budget_.get());
}

Status Database::run(const std::string& sql) {
  const int code = sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return failure(connection_.get(), code, where_);
  return Done{};
}

Expected<Statement> Database::prepare(std::string_view sql) const {
  Statement statement;
  statement.where_ = where_;
  statement.budget_ = budget_;
  if (budget_) budget_->left = budget_->whole;
  sqlite3_stmt* raw = nullptr;
  const int code = sqlite3_prepare_v3(connection_.get(), sql.data(), to<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &raw, nullptr);
  statement.statement_.reset(raw);
  if (code != SQLITE_OK) return failure(connection_.get(), code, where_);
  return statement;
}

Expected<std::int64_t> Database::integer(std::string_view sql) const {
  auto statement = prepare(sql);
  if (!statement) return forward_error(std::move(statement));
  auto row = statement->step();
  if (!row) return forward_error(std::move(row));
  if (!*row) return fail(ErrorCode::kCorruptInput, where_, "the map file is incomplete");
  return statement->integer(0);
}

Expected<std::string> Database::text(std::string_view sql) const {
  auto statement = prepare(sql);
  if (!statement) return forward_error(std::move(statement));
  auto row = statement->step();
  if (!row) return forward_error(std::move(row));
  if (!*row) return fail(ErrorCode::kCorruptInput, where_, "the map file is incomplete");
  return std::string(statement->text(0));
}

Expected<std::vector<unsigned char>> Database::image() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
      sqlite3_serialize(connection_.get(), "main", &size, 0), &sqlite3_free);
  if (!bytes) return fail(ErrorCode::kOutOfMemory, where_, "the memory does not suffice");
  return std::vector<unsigned char>(bytes.get(), bytes.get() + size);
}

}  // namespace swiftlet::sqlite
