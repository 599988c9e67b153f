// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/file_names.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <string_view>
#include <system_error>

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

/// For file systems that know no RENAME_NOREPLACE. A hard link does not replace anything either;
/// where there are none (FAT), a look beforehand has to do.
bool link_or_rename(const fs::path& from, const fs::path& to) {
  if (link(from.c_str(), to.c_str()) == 0) return unlink(from.c_str()) == 0;
  if (errno == EEXIST) return false;
  std::error_code unreadable;
  if (fs::exists(fs::symlink_status(to, unreadable))) {
    errno = EEXIST;
    return false;
  }
  return std::rename(from.c_str(), to.c_str()) == 0;
}

}  // namespace

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code missing;
  return fs::equivalent(a, b, missing) && !missing;
}

bool is_map_file(const fs::path& path) {
  constexpr std::string_view kSqlite{"SQLite format 3\0", 16};
  constexpr std::string_view kOurs{
      "SWLT"};  // SQLite's application_id, see docs/formats/map_file.md
  constexpr std::size_t kIdAt = 68;
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  std::array<unsigned char, kIdAt + 4> head{};
  struct stat status {};
  const bool is_whole = fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
                        read(file, head.data(), head.size()) == std::ssize(head);
  close(file);
  return is_whole && std::memcmp(head.data(), kSqlite.data(), kSqlite.size()) == 0 &&
         std::memcmp(head.data() + kIdAt, kOurs.data(), kOurs.size()) == 0;
}

std::string unguessable_digits() {
  std::random_device source;  // the kernel's
  return fmt::format("{:08x}{:08x}", source() & 0xffffffffU, source() & 0xffffffffU);
}

Status rename_to_new(const fs::path& from, const fs::path& to) {
  bool is_done = renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0;
  if (!is_done && (errno == EINVAL || errno == ENOSYS)) is_done = link_or_rename(from, to);
  if (is_done) {
    settle_folder_of(to);
    return Done{};
  }
  if (errno == EEXIST) {
    return fail(ErrorCode::kUsage, to.string(), "the file exists", "choose another name");
  }
  return fail(ErrorCode::kIo, from.string(),
              fmt::format("it cannot be renamed to {}: {}", to.string(),
                          std::generic_category().message(errno)));
}

void settle_folder_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  (void)fsync(handle);  // not every file system can
  close(handle);
}

}  // namespace swiftlet
