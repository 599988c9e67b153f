// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <locale>
#include <streambuf>
#include <system_error>
#include <utility>

#include "swiftlet/file/file_names.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

std::string reason_of(int error) { return std::generic_category().message(error); }

/// Beside the file, so that the rename stays on one file system; short enough for any name.
fs::path temporary_beside(const fs::path& path) {
  constexpr std::size_t kMostLetters = 200;
  const std::string name = path.filename().string().substr(0, kMostLetters);
  return path.parent_path() / fmt::format("{}.{}.part", name, unguessable_digits());
}

}  // namespace

/// A stream into a file descriptor: the standard's own file streams cannot be told to make a file
/// anew and to follow no link.
class OutputFile::Sink final : private std::streambuf {
 public:
  explicit Sink(int descriptor) : descriptor_(descriptor), stream_(this) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    stream_.imbue(std::locale::classic());  // no decimal comma of the host program
  }
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  ~Sink() override { (void)close(); }

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// All that was written is on the disk; the reason if it is not.
  [[nodiscard]] bool finish() {
    bool is_good = static_cast<bool>(stream_.flush());
    if (is_good && fsync(descriptor_) != 0) is_good = keep_error();
    return close() && is_good;
  }
  [[nodiscard]] int error() const { return error_; }

 private:
  bool keep_error() {
    error_ = errno;
    return false;
  }
  bool close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor < 0 || ::close(descriptor) == 0 || keep_error();
  }
  int sync() override {
    for (const char* at = pbase(); at < pptr();) {
      const ssize_t written = ::write(descriptor_, at, static_cast<std::size_t>(pptr() - at));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return keep_error() ? 0 : -1;
      at += written;
    }
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return 0;
  }
  int_type overflow(int_type letter) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(letter, traits_type::eof())) sputc(static_cast<char>(letter));
    return traits_type::not_eof(letter);
  }

  int descriptor_;
  int error_ = 0;
  std::array<char, 1U << 16U> buffer_;
  std::ostream stream_;
};

Status check_output(const fs::path& path, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    if (!is_same_file(path, input)) continue;
    return fail(ErrorCode::kUsage, path.string(),
                fmt::format("this is the input {}; it would be lost", input.string()),
                "choose another name");
  }
  std::error_code unreadable;
  const fs::file_status status = fs::status(path, unreadable);  // of what a link leads to
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return fail(ErrorCode::kUsage, path.string(), "it exists and is not a file",
                "choose the name of a file");
  }
  if (is_map_file(path)) {
    return fail(ErrorCode::kUsage, path.string(), "this is a Swiftlet map; it would be lost",
                "choose another name, or remove the map first");
  }
  return Done{};
}

OutputFile::OutputFile(fs::path path, fs::path temporary, int descriptor)
    : path_(std::move(path)),
      temporary_(std::move(temporary)),
      sink_(std::make_unique<Sink>(descriptor)) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, fs::path{})),
      sink_(std::move(other.sink_)) {}

Expected<OutputFile> OutputFile::create(const fs::path& path, std::span<const fs::path> inputs) {
  if (auto allowed = check_output(path, inputs); !allowed) return forward_error(std::move(allowed));
  constexpr int kAnew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const fs::path temporary = temporary_beside(path);
  const int descriptor = open(temporary.c_str(), kAnew, 0666);
  if (descriptor >= 0) return OutputFile(path, temporary, descriptor);
  return fail(ErrorCode::kIo, path.string(),
              "the file cannot be written (" + reason_of(errno) + ")",
              "check that the folder exists and may be written");
}

OutputFile::~OutputFile() {
  if (temporary_.empty()) return;
  sink_.reset();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

std::ostream& OutputFile::stream() { return sink_->stream(); }

Status OutputFile::commit() {
  if (!sink_->finish()) {
    return fail(ErrorCode::kIo, path_.string(),
                fmt::format("the file could not be written whole ({})", reason_of(sink_->error())),
                "check the free space and quota of the disk");
  }
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) {
    return fail(ErrorCode::kIo, path_.string(), "the file cannot be put there: " + error.message());
  }
  temporary_.clear();
  settle_folder_of(path_);
  return Done{};
}

void OutputFile::pack(const void* value, unsigned char* out, std::size_t size) {
  std::memcpy(out, value, size);
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t i = 0; i < size / 2; ++i) std::swap(out[i], out[size - 1 - i]);
  }
}

}  // namespace swiftlet
