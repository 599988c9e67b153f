// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/byte_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace swiftlet {
namespace {

tl::unexpected<Error> ends_before(const ByteSource& source, std::uint64_t offset,
                                  std::size_t bytes) {
  return fail(ErrorCode::kCorruptInput, fmt::format("{}: byte {}", source.name(), offset),
              fmt::format("{} more bytes should follow, but the file ends at byte {}", bytes,
                          source.size()),
              "the recording was cut off; copy it again");
}

tl::unexpected<Error> refused(const std::string& name, int error) {
  return fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, name,
              error == ENOENT ? "there is no such file"
                              : "cannot be read: " + std::generic_category().message(error));
}

/// A file descriptor, closed at the end.
class FileBytes final : public ByteSource {
 public:
  FileBytes(int file, std::uint64_t size, std::string name)
      : file_(file), size_(size), name_(std::move(name)) {}
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes() override { ::close(file_); }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::uint64_t size() const override { return size_; }

  [[nodiscard]] Status read(std::uint64_t offset, std::span<std::byte> out) const override {
    while (!out.empty()) {
      const ssize_t got = ::pread(file_, out.data(), out.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return refused(name_, errno);
      if (got == 0) return ends_before(*this, offset, out.size());
      offset += static_cast<std::uint64_t>(got);
      out = out.subspan(static_cast<std::size_t>(got));
    }
    return Done{};
  }

 private:
  int file_;
  std::uint64_t size_;
  std::string name_;
};

}  // namespace

Expected<ByteSourcePtr> open_file_bytes(const std::filesystem::path& path) {
  const int file =
      ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // no pipe keeps us waiting
  if (file < 0) return refused(path.string(), errno);
  struct stat status {};
  const bool is_known = ::fstat(file, &status) == 0;
  if (!is_known || !S_ISREG(status.st_mode)) {
    ::close(file);
    return fail(ErrorCode::kIo, path.string(), "it is not a file");
  }
  return std::make_unique<FileBytes>(file, static_cast<std::uint64_t>(status.st_size),
                                     path.string());
}

Status MemoryBytes::read(std::uint64_t offset, std::span<std::byte> out) const {
  if (offset > bytes_.size() || out.size() > bytes_.size() - offset)
    return ends_before(*this, offset, out.size());
  std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
  return Done{};
}

}  // namespace swiftlet
