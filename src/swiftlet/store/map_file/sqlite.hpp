// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace swiftlet::sqlite {

/// What one statement may do: a file can be made that keeps SQLite busy for years, or have it read
/// the same pages for ever. A sound one needs far less than its size allows.
struct WorkBudget {
  std::int64_t whole = 0;  ///< steps of SQLite's machine
  std::int64_t left = 0;
};

/// A prepared statement. Parameters and columns count as in SQLite: from 1 and from 0.
/// REQUIRES: the Database it came from is still open.
class Statement {
 public:
  Statement() = default;

  /// Text and bytes must live until the statement is reset.
  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::span<const std::uint8_t> bytes);

  /// True while there is a row.
  [[nodiscard]] Expected<bool> step();
  /// Runs a statement that has no rows, and makes it ready for the next use.
  [[nodiscard]] Status run();
  /// Ends a read: as long as a statement stands on a row it holds a read transaction.
  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  /// Valid until the next step() or reset().
  [[nodiscard]] std::string_view text(int column) const;
  [[nodiscard]] std::span<const std::uint8_t> bytes(int column) const;

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  std::shared_ptr<WorkBudget> budget_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string where_;  // the file, for errors
};

/// A connection to a database file. Thread safety: one thread at a time.
class Database {
 public:
  enum class Mode {
    kCreate,
    kReadWrite,
    kReadOnly,
    kImmutable,  ///< reads what nobody can change meanwhile; takes no lock and looks at no log
  };

  Database() = default;

  /// Errors: kIo, kCorruptInput with the path and the reason of the operating system.
  /// `where`: what errors call the file, if not by its path.
  [[nodiscard]] static Expected<Database> open(const std::filesystem::path& path, Mode mode,
                                               const std::string& where = {});

  [[nodiscard]] Status run(const std::string& sql);
  [[nodiscard]] Expected<Statement> prepare(std::string_view sql) const;
  /// The first column of the first row. Errors: kCorruptInput if there is no row.
  [[nodiscard]] Expected<std::int64_t> integer(std::string_view sql) const;
  [[nodiscard]] Expected<std::string> text(std::string_view sql) const;
  /// The bytes of a database in memory, as a file holds them. Errors: kOutOfMemory.
  [[nodiscard]] Expected<std::vector<unsigned char>> image() const;

  [[nodiscard]] bool is_open() const { return connection_ != nullptr; }
  void close() { connection_.reset(); }

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  void limit_work(std::uint64_t bytes);

  std::shared_ptr<WorkBudget> budget_;  // null: opened to write
  std::unique_ptr<sqlite3, Close> connection_;
  std::string where_;
};

}  // namespace swiftlet::sqlite
