// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/recovered_map.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;

constexpr std::array<const char*, 2> kRecoveredLogs{"-wal", "-journal"};

/// An open file; none if `number` is negative.
struct OpenFile {
  explicit OpenFile(int n) : number(n) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (number >= 0) close(number);
  }
  int number;
};

/// Size and time of change of a file and its logs: as long as they stay, nobody writes them.
struct Stand {
  std::vector<std::int64_t> numbers;
  std::uint64_t bytes = 0;
  friend bool operator==(const Stand&, const Stand&) = default;
};

Stand stand_of(const fs::path& path) {
  Stand stand;
  for (const char* suffix : {"", "-wal", "-journal"}) {
    struct stat file {};
    if (lstat((path.string() + suffix).c_str(), &file) != 0) file = {};
    stand.bytes += static_cast<std::uint64_t>(file.st_size);
    for (const std::int64_t n : {std::int64_t{file.st_size}, std::int64_t{file.st_mtim.tv_sec},
                                 std::int64_t{file.st_mtim.tv_nsec}}) {
      stand.numbers.push_back(n);
    }
  }
  return stand;
}

/// 0, or the reason of the operating system. `more`: bytes of zero put behind.
int copy_bytes(const fs::path& from, const fs::path& to, std::size_t more) {
  const OpenFile in(open(from.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  if (in.number < 0) return errno;
  const OpenFile out(open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (out.number < 0) return errno;
  std::vector<char> piece(std::size_t{1} << 18U);
  for (bool is_end = false; !is_end;) {
    ssize_t size = read(in.number, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return errno;
    if (size == 0) {
      is_end = true;
      size = static_cast<ssize_t>(more);
      piece.assign(more, 0);
    }
    for (ssize_t done = 0; done < size;) {
      const ssize_t n =
          write(out.number, piece.data() + done, static_cast<std::size_t>(size - done));
      if (n < 0 && errno != EINTR) return errno;
      if (n > 0) done += n;
    }
  }
  return 0;
}

tl::unexpected<Error> no_copy(const fs::path& path, const std::string& reason) {
  return fail(
      ErrorCode::kIo, path.string(),
      "its writer was killed or the folder is read-only, and no copy can be made to read (" +
          reason + ")",
      "set TMPDIR to a folder with room for the map");
}

/// The map and its logs as files of their own, all from one moment.
Status copy_all(const fs::path& path, const fs::path& copy) {
  constexpr int kTries = 5;
  for (int i = 0; i < kTries; ++i) {
    const Stand before = stand_of(path);
    std::error_code error;
    const auto space = fs::space(copy.parent_path(), error);
    if (!error && space.available < before.bytes + before.bytes / 8) {
      return no_copy(path, fmt::format("{} bytes are needed in {}", before.bytes,
                                       copy.parent_path().parent_path().string()));
    }
    for (const char* suffix : {"", "-wal", "-journal"}) fs::remove(copy.string() + suffix, error);
    if (const int reason = copy_bytes(path, copy, 0); reason != 0) {
      return no_copy(path, std::generic_category().message(reason));
    }
    for (const char* suffix : kRecoveredLogs) {
      // A journal may end in the name of a file that SQLite is to delete. Ours do not; with a byte
      // behind it, SQLite does not find it.
      const std::size_t more = std::string_view(suffix) == "-journal" ? 1 : 0;
      const int reason = copy_bytes(path.string() + suffix, copy.string() + suffix, more);
      if (reason != 0 && reason != ENOENT && reason != ELOOP) {
        return no_copy(path, std::generic_category().message(reason));
      }
    }
    if (stand_of(path) == before) return Done{};
  }
  return fail(ErrorCode::kIo, path.string(), "the map changes while it is read",
              "try again when it is not being written");
}

}  // namespace

bool has_logs(const fs::path& path) {
  std::error_code none;
  const fs::path real = fs::canonical(path, none);
  for (const char* suffix : kRecoveredLogs) {
    const auto size = fs::file_size(real.string() + suffix, none);
    if (!none && size > 0) return true;
  }
  return false;
}

Expected<fs::path> copy_recovered(const fs::path& path, const PrivateFolder& folder) {
  std::error_code none;
  fs::path real = fs::canonical(path, none);
  if (none) real = path;
  const fs::path copy = folder.path() / "map.swl";
  if (auto copied = copy_all(real, copy); !copied) {
    return forward_error(std::move(copied));
  }
  auto database = Database::open(copy, Database::Mode::kReadWrite, path.string());
  if (!database) return forward_error(std::move(database));
  auto mode = database->text("PRAGMA journal_mode = DELETE");
  if (!mode) return forward_error(std::move(mode));
  // A log can ask for any size; a sound one adds the pages that it holds.
  const auto grown = fs::file_size(copy, none);
  if (none || grown > stand_of(real).bytes) {
    return fail(ErrorCode::kCorruptInput, path.string(), "the log of the map is damaged",
                "--salvage reads what is sound");
  }
  return copy;
}

Expected<Database> open_recovered(const fs::path& path) {
  auto folder = PrivateFolder::create();
  if (!folder) return forward_error(std::move(folder));
  auto copy = copy_recovered(path, *folder);
  if (!copy) return forward_error(std::move(copy));
  return Database::open(*copy, Database::Mode::kReadOnly, path.string());
}

}  // namespace swiftlet
