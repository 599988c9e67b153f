// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/file_content.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "swiftlet/file/text_encoding.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kReadStep = std::size_t{1} << 16;

/// A file descriptor, closed at the end; -1 is none.
class OpenFile {
 public:
  /// Not waiting for the other end, should the path have become a pipe in the meantime.
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFile& operator=(OpenFile&&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

tl::unexpected<Error> refused_by_system(const std::string& where, int error) {
  if (error == ENOENT) return fail(ErrorCode::kNotFound, where, "there is no such file");
  return fail(ErrorCode::kIo, where, "cannot be read: " + std::generic_category().message(error));
}

tl::unexpected<Error> too_long(const std::string& where, std::size_t most_bytes) {
  const std::size_t most = most_bytes >= kReadStep * 16 ? most_bytes >> 20 : most_bytes >> 10;
  return fail(ErrorCode::kUnsupported, where,
              fmt::format("it is longer than {} {}, which is more than such a file may hold", most,
                          most_bytes >= kReadStep * 16 ? "MiB" : "KiB"),
              "check that it is the file that you mean");
}

std::string_view name_of_kind(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

Status check_mode(const std::string& where, mode_t mode) {
  if (S_ISREG(mode)) return Done{};
  return fail(ErrorCode::kIo, where, fmt::format("it is {}, not a file", name_of_kind(mode)),
              S_ISDIR(mode) ? "name a file in it" : "write its content into a file, and name that");
}

/// A regular file, opened, and how long it says that it is.
struct RegularFile {
  OpenFile file;
  std::size_t told_bytes;
};

/// Asked twice: what is opened need not be what was asked about before.
Expected<RegularFile> open_regular(const std::filesystem::path& path) {
  if (auto usable = check_regular_file(path); !usable) return forward_error(std::move(usable));
  OpenFile file(path);
  struct stat status {};
  if (file.descriptor() < 0 || ::fstat(file.descriptor(), &status) != 0)
    return refused_by_system(path.string(), errno);
  if (auto usable = check_mode(path.string(), status.st_mode); !usable)
    return forward_error(std::move(usable));
  return RegularFile{std::move(file), static_cast<std::size_t>(std::max<off_t>(status.st_size, 0))};
}

/// Bytes read into `content` from `have` on; negative with the reason in errno.
ssize_t read_some(const OpenFile& file, std::string& content, std::size_t have) {
  while (true) {
    const ssize_t got = ::read(file.descriptor(), content.data() + have, content.size() - have);
    if (got >= 0 || errno != EINTR) return got;
  }
}

}  // namespace

Status check_regular_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return refused_by_system(path.string(), errno);
  return check_mode(path.string(), status.st_mode);
}

Expected<std::string> read_file(const std::filesystem::path& path, std::size_t most_bytes) {
  const std::string where = path.string();
  const auto opened = open_regular(path);
  if (!opened) return tl::make_unexpected(opened.error());
  const auto& [file, told_bytes] = *opened;
  if (told_bytes > most_bytes) return too_long(where, most_bytes);

  // Not trusting the size: a file may grow while it is read, and those of /proc tell none.
  std::string content(told_bytes + 1, '\0');
  for (std::size_t have = 0;;) {
    if (have == content.size()) content.resize(have + std::max(kReadStep, have / 2));
    const ssize_t got = read_some(file, content, have);
    if (got < 0) return refused_by_system(where, errno);
    have += static_cast<std::size_t>(got);
    if (have > most_bytes) return too_long(where, most_bytes);
    if (got > 0) continue;
    content.resize(have);
    return content;
  }
}

Expected<std::string> read_head(const std::filesystem::path& path, std::size_t most_bytes) {
  const auto opened = open_regular(path);
  if (!opened) return tl::make_unexpected(opened.error());
  std::string head(most_bytes, '\0');
  std::size_t have = 0;
  for (ssize_t got = 1; got > 0 && have < most_bytes; have += static_cast<std::size_t>(got)) {
    got = read_some(opened->file, head, have);
    if (got < 0) return refused_by_system(path.string(), errno);
  }
  head.resize(have);
  return head;
}

Expected<std::string> read_text_file(const std::filesystem::path& path, std::size_t most_bytes) {
  auto text = read_file(path, most_bytes);
  if (!text) return text;
  return without_byte_order_mark(std::move(*text));
}

}  // namespace swiftlet
