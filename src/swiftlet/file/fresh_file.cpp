// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/fresh_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> refusal(const fs::path& path, int reason) {
  if (reason == ENOSPC || reason == EDQUOT) {
    return fail(ErrorCode::kIo, path.string(), "there is no space left for the map",
                "free some space or set a byte cap");
  }
  return fail(
      ErrorCode::kIo, path.string(),
      "the map cannot be opened or created (" + std::generic_category().message(reason) + ")",
      "check that the folder exists and may be written");
}

/// 0, or the reason of the operating system.
int write_all(int file, std::span<const unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return EIO;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return fsync(file) == 0 || errno == EINVAL ? 0 : errno;
}

}  // namespace

Expected<fs::path> make_fresh_file(const fs::path& path, std::span<const unsigned char> bytes) {
  std::uint64_t chance = 0;
  if (getrandom(&chance, sizeof chance, 0) != ssize_t{sizeof chance}) return refusal(path, errno);
  const fs::path fresh =
      path.parent_path() / fmt::format(".{}.{:016x}.new", path.filename().string(), chance);
  const int file = open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) return refusal(path, errno);
  int reason = write_all(file, bytes);
  if (close(file) != 0 && reason == 0) reason = errno;
  if (reason == 0) return fresh;
  unlink(fresh.c_str());
  return refusal(path, reason);
}

Status rename_if_free(const fs::path& from, const fs::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return Done{};
  int reason = errno;
  if (reason == EINVAL || reason == ENOSYS) {  // a file system that knows no such promise
    struct stat there {};
    reason = EEXIST;
    if (lstat(to.c_str(), &there) != 0) reason = rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
  }
  if (reason == 0) return Done{};
  if (reason == EEXIST) {
    return fail(ErrorCode::kUsage, to.string(), "it exists already",
                "choose another name or allow to overwrite it");
  }
  return fail(ErrorCode::kIo, to.string(),
              "the map cannot be put there: " + std::generic_category().message(reason));
}

}  // namespace swiftlet
