// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/map_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <system_error>

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

/// Beyond the largest database (2^48 bytes) and SQLite's own lock bytes (at 2^30). The lock's
/// length is 1 + the writer's process id: so whoever asks learns who it is, and nothing has to be
/// written anywhere that could be out of date.
constexpr off_t kLockByte = off_t{1} << 62;

using FileId = std::pair<dev_t, ino_t>;

/// The files that this process has locked. To ask the kernel, a file must be opened; to close it
/// again would take away the locks that SQLite holds on it in this process (POSIX), so a file of
/// our own is never asked about.
class OwnLocks {
 public:
  bool add(const FileId& file) {
    const std::lock_guard lock(mutex_);
    return files_.insert(file).second;
  }
  void remove(const FileId& file) {
    const std::lock_guard lock(mutex_);
    files_.erase(file);
  }
  bool contains(const FileId& file) {
    const std::lock_guard lock(mutex_);
    return files_.contains(file);
  }
  static OwnLocks& of_this_process() {
    static OwnLocks locks;
    return locks;
  }

 private:
  std::mutex mutex_;
  std::set<FileId> files_;
};

struct flock range(std::int64_t length) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = kLockByte;
  lock.l_len = length;
  return lock;
}

MapWriter writer_with(std::int64_t pid) {
  std::ifstream words(fmt::format("/proc/{}/cmdline", pid), std::ios::binary);
  std::string command{std::istreambuf_iterator<char>(words), {}};
  while (!command.empty() && command.back() == '\0') command.pop_back();
  // Another process chose these bytes: they end in a message on a terminal.
  std::ranges::replace_if(
      command, [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, ' ');
  constexpr std::size_t kLongest = 120;
  if (command.size() > kLongest) command = command.substr(0, kLongest) + " ...";
  return {pid, command};
}

std::optional<FileId> id_of(const fs::path& path) {
  struct stat file {};
  if (stat(path.c_str(), &file) != 0) return std::nullopt;
  return FileId{file.st_dev, file.st_ino};
}

std::optional<FileId> id_of(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0) return std::nullopt;
  return FileId{status.st_dev, status.st_ino};
}

std::optional<MapWriter> holder_of(int file) {
  struct flock lock = range(1);
  if (fcntl(file, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) return std::nullopt;
  return writer_with(lock.l_len - 1);
}

}  // namespace

std::string MapWriter::text() const {
  return command.empty() ? fmt::format("process {}", pid)
                         : fmt::format("process {}: {}", pid, command);
}

tl::unexpected<Error> MapLock::refusal(const fs::path& path, const MapWriter& writer) {
  return fail(ErrorCode::kUsage, path.string(),
              fmt::format("the map is being written ({})", writer.text()),
              "end that first or choose another name");
}

std::optional<MapWriter> MapLock::holder(const fs::path& path) {
  const auto id = id_of(path);
  if (!id) return std::nullopt;
  if (OwnLocks::of_this_process().contains(*id)) return writer_with(getpid());
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return std::nullopt;
  auto writer = holder_of(file);
  close(file);
  return writer;
}

Expected<MapLock> MapLock::take(const fs::path& path) {
  if (auto writer = holder(path)) return refusal(path, *writer);
  MapLock lock;
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    const int reason = errno;
    return fail(reason == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, path.string(),
                "the map may not be written (" + std::generic_category().message(reason) + ")",
                "check the permissions of the file and of its folder");
  }
  struct flock wanted = range(1 + std::int64_t{getpid()});
  if (fcntl(file, F_OFD_SETLK, &wanted) != 0 && (errno == EAGAIN || errno == EACCES)) {
    const auto writer = holder_of(file).value_or(MapWriter{});
    close(file);
    return refusal(path, writer);
  }
  // A file system without locks of this kind: the map can be written, but not guarded.
  const auto id = id_of(file);
  if (id && !OwnLocks::of_this_process().add(*id)) {
    close(file);
    return refusal(path, writer_with(getpid()));
  }
  lock.file_ = file;
  return lock;
}

bool MapLock::is_lock_of(const fs::path& path) const {
  const auto mine = is_held() ? id_of(file_) : std::nullopt;
  return mine && mine == id_of(path);
}

MapLock& MapLock::operator=(MapLock&& other) noexcept {
  if (this == &other) return *this;
  release();
  file_ = std::exchange(other.file_, -1);
  return *this;
}

void MapLock::release() {
  if (file_ < 0) return;
  if (const auto id = id_of(file_)) OwnLocks::of_this_process().remove(*id);
  close(std::exchange(file_, -1));
}

}  // namespace swiftlet
