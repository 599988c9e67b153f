// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/byte_sink.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace swiftlet {
namespace {

tl::unexpected<Error> cannot_write(const std::string& name, int error) {
  return fail(ErrorCode::kIo, name, "cannot be written: " + std::generic_category().message(error),
              "check the folder, its permissions and the free space");
}

class FileSink final : public ByteSink {
 public:
  FileSink(int file, std::string name) : file_(file), name_(std::move(name)) {}
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;
  ~FileSink() override { ::close(file_); }

  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return cannot_write(name_, errno);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return Done{};
  }

 private:
  int file_;
  std::string name_;
};

}  // namespace

Expected<ByteSinkPtr> open_file_sink(const std::filesystem::path& path) {
  constexpr mode_t kMode = 0666;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (file < 0) return cannot_write(path.string(), errno);
  return std::make_unique<FileSink>(file, path.string());
}

}  // namespace swiftlet
