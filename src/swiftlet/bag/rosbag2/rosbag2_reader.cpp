// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/rosbag2/rosbag2_reader.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "swiftlet/bag/byte_cursor.hpp"
#include "swiftlet/bag/chunk_codec.hpp"
#include "swiftlet/bag/message_types.hpp"
#include "swiftlet/file/sqlite_uri.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMostTopics = 65536;
constexpr int kMostMessageBytes = static_cast<int>(kMaxChunkBytes);
// Of SQLite's machine, for a row: it has some twenty. A database can be made to take for ever.
constexpr int kMostStepsARow = 100'000'000;

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using DatabasePtr = std::unique_ptr<sqlite3, CloseDatabase>;
using StatementPtr = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

/// Whether there is a log with messages that the database does not hold yet.
bool has_write_ahead_log(const std::filesystem::path& path) {
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(path.string() + "-wal", missing);
  return !missing && bytes > 0;
}

std::string_view text_of(sqlite3_stmt* row, int column) {
  const void* data = sqlite3_column_blob(row, column);
  const int bytes = sqlite3_column_bytes(row, column);
  if (data == nullptr || bytes <= 0) return {};
  return {static_cast<const char*>(data), static_cast<std::size_t>(bytes)};
}

}  // namespace

bool has_sqlite_magic(std::span<const std::byte> start) {
  constexpr std::string_view kMagic{"SQLite format 3\0", 16};
  return ByteCursor::text_of(start).starts_with(kMagic);
}

/// The messages of an open database, row by row.
class Rosbag2Reader::Rows {
 public:
  /// Opened so that reading changes nothing on the disk, unless a log has to be read, too.
  static int open(const std::filesystem::path& name, Rows& rows) {
    std::error_code unknown;  // behind a link, the log lies beside the file itself
    std::filesystem::path path = std::filesystem::canonical(name, unknown);
    if (unknown) path = name;
    const bool is_logged = has_write_ahead_log(path);
    const std::string uri = sqlite_uri(path, is_logged ? "mode=ro" : "mode=ro&immutable=1");
    constexpr int kFlags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
    sqlite3* raw = nullptr;
    const int code = sqlite3_open_v2(uri.c_str(), &raw, kFlags, nullptr);
    rows.database_.reset(raw);
    if (code != SQLITE_OK) return code;
    sqlite3_extended_result_codes(raw, 1);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, kMostMessageBytes);
    constexpr int kEvery = 10'000;
    sqlite3_progress_handler(
        raw, kEvery, [](void* left) { return (*static_cast<int*>(left) -= kEvery) < 0 ? 1 : 0; },
        rows.steps_left_.get());
    return SQLITE_OK;
  }

  int prepare(std::string_view sql) {
    *steps_left_ = kMostStepsARow;
    sqlite3_stmt* raw = nullptr;
    const int code = sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()),
                                        &raw, nullptr);
    row_.reset(raw);
    return code;
  }
  /// SQLITE_ROW while there is one.
  int step() {
    *steps_left_ = kMostStepsARow;
    return sqlite3_step(row_.get());
  }
  [[nodiscard]] sqlite3_stmt* row() const { return row_.get(); }
  [[nodiscard]] const char* message() const { return sqlite3_errmsg(database_.get()); }

  [[nodiscard]] tl::unexpected<Error> failure(int code, const std::string& name) const {
    const int kind = code & 0xff;
    if (kind == SQLITE_NOTADB || kind == SQLITE_CORRUPT || kind == SQLITE_TOOBIG ||
        kind == SQLITE_INTERRUPT || kind == SQLITE_FORMAT)
      return fail(ErrorCode::kCorruptInput, name,
                  fmt::format("the database is damaged ({})", message()),
                  "`sqlite3 FILE .recover` may save what is left");
    if (kind == SQLITE_ERROR)
      return fail(ErrorCode::kCorruptInput, name,
                  fmt::format("it is no recording of ROS 2 ({})", message()));
    return fail(ErrorCode::kIo, name, fmt::format("it cannot be read: {}", message()));
  }

 private:
  std::unique_ptr<int> steps_left_ = std::make_unique<int>(kMostStepsARow);
  DatabasePtr database_;
  StatementPtr row_;
};

Rosbag2Reader::Rosbag2Reader(std::string name, std::unique_ptr<Rows> rows)
    : name_(std::move(name)), rows_(std::move(rows)) {}
Rosbag2Reader::Rosbag2Reader(Rosbag2Reader&&) noexcept = default;
Rosbag2Reader::~Rosbag2Reader() = default;

void Rosbag2Reader::end() { rows_.reset(); }

RecordingInfo Rosbag2Reader::info() const { return {.format = "rosbag2 SQLite"}; }

std::string Rosbag2Reader::place_of(const BagMessage& message) const {
  return fmt::format("{}: message {} ({})", name_, message.offset, message.connection->topic);
}

Expected<Rosbag2Reader> Rosbag2Reader::open(const std::filesystem::path& path,
                                            const std::string& name) {
  auto rows = std::make_unique<Rows>();
  if (const int code = Rows::open(path, *rows); code != SQLITE_OK) return rows->failure(code, name);
  Rosbag2Reader reader(name, std::move(rows));
  if (auto read = reader.read_topics(); !read) return forward_error(std::move(read));
  // By row and not by time: that is the order of writing, and needs no sorting.
  const int code = reader.rows_->prepare(
      "SELECT rowid, topic_id, timestamp, data FROM messages "
      "ORDER BY rowid");
  if (code != SQLITE_OK) return reader.rows_->failure(code, name);
  return reader;
}

Status Rosbag2Reader::read_topics() {
  int code = rows_->prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
  if (code != SQLITE_OK) return rows_->failure(code, name_);
  while ((code = rows_->step()) == SQLITE_ROW) {
    const sqlite3_int64 id = sqlite3_column_int64(rows_->row(), 0);
    const std::string_view topic = text_of(rows_->row(), 1);
    const std::string_view type = text_of(rows_->row(), 2);
    if (topics_.size() == kMostTopics || id < 0 || id > std::numeric_limits<std::uint32_t>::max() ||
        topic.size() > kMostNameBytes || type.size() > kMostNameBytes)
      return fail(ErrorCode::kCorruptInput, name_, "its table of topics cannot be");
    const auto number = static_cast<std::uint32_t>(id);
    const bool is_cdr = text_of(rows_->row(), 3) == "cdr";
    topics_.insert_or_assign(number, BagConnection{.id = number,
                                                   .topic = std::string(topic),
                                                   .type = plain_type_name(type),
                                                   .encoding = is_cdr ? MessageEncoding::kCdr
                                                                      : MessageEncoding::kOther});
  }
  if (code != SQLITE_DONE) return rows_->failure(code, name_);
  return Done{};
}

Expected<std::optional<BagMessage>> Rosbag2Reader::read_next() {
  if (!rows_) return std::nullopt;
  const int code = rows_->step();
  if (code == SQLITE_DONE) {
    end();
    return std::nullopt;
  }
  if (code != SQLITE_ROW) {
    auto failure = rows_->failure(code, name_);
    end();
    return failure;
  }
  sqlite3_stmt* row = rows_->row();
  const sqlite3_int64 id = sqlite3_column_int64(row, 0);
  const sqlite3_int64 topic_id = sqlite3_column_int64(row, 1);
  const Stamp time{sqlite3_column_int64(row, 2)};
  const auto topic = std::in_range<std::uint32_t>(topic_id)
                         ? topics_.find(static_cast<std::uint32_t>(topic_id))
                         : topics_.end();
  if (topic == topics_.end() || time.ns < 0) {
    end();
    return fail(ErrorCode::kCorruptInput, fmt::format("{}: message {}", name_, id),
                topic == topics_.end() ? "it tells no known topic" : "it tells no time",
                "the recording is damaged there; copy it again");
  }
  return BagMessage{&topic->second, time, std::as_bytes(std::span(text_of(row, 3))),
                    static_cast<std::uint64_t>(id)};
}

}  // namespace swiftlet
