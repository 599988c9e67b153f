// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/rosbag2/unpacked_file.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/bag/chunk_codec.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kCopyStepBytes = 1U << 20U;
constexpr int kMostFileWindowBits = 27;  // as zstd's own program takes without being asked

tl::unexpected<Error> refused(const std::filesystem::path& path, const char* what, int error) {
  return fail(ErrorCode::kIo, path.string(),
              fmt::format("{}: {}", what, std::generic_category().message(error)),
              "free some space, or set TMPDIR to a folder that has it");
}

Status write_all(int file, std::span<const std::byte> bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return refused(path, "it cannot be unpacked", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return Done{};
}

/// Unpacks all frames of a file into another.
Status unpack_into(int file, const ByteSource& packed) {
  const auto damaged = [&](std::string what) {
    return fail(ErrorCode::kCorruptInput, packed.name(), std::move(what),
                "unpack it with `zstd -d` to see how far it is sound");
  };
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     ZSTD_freeDCtx);
  if (!context) return fail(ErrorCode::kOutOfMemory, packed.name(), "no memory to unpack it");
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, kMostFileWindowBits);
  std::vector<std::byte> in_bytes(kCopyStepBytes), out_bytes(kCopyStepBytes);
  std::uint64_t unpacked_bytes = 0;
  std::size_t hint = 0;  // 0: a frame has ended
  for (std::uint64_t at = 0; at < packed.size();) {
    const auto step = std::span(in_bytes).first(std::min(kCopyStepBytes, packed.size() - at));
    if (auto read = packed.read(at, step); !read) return read;
    at += step.size();
    ZSTD_inBuffer in{step.data(), step.size(), 0};
    bool is_full = false;
    while (in.pos < in.size || is_full) {
      ZSTD_outBuffer out{out_bytes.data(), out_bytes.size(), 0};
      hint = ZSTD_decompressStream(context.get(), &out, &in);
      if (ZSTD_isError(hint) != 0U)
        return damaged(fmt::format("its Zstandard data are damaged ({})", ZSTD_getErrorName(hint)));
      unpacked_bytes += out.pos;
      if (!is_growth_plausible(at, unpacked_bytes))
        return damaged("it unpacks to more than recordings do");
      auto written = write_all(file, std::span(out_bytes).first(out.pos), packed.name());
      if (!written) return written;
      is_full = out.pos == out.size;
    }
  }
  return hint == 0 ? Status(Done{}) : damaged("its Zstandard data end too early");
}

Expected<std::shared_ptr<const UnpackedFile>> unpack(const std::filesystem::path& path) {
  auto packed = open_file_bytes(path);
  if (!packed) return forward_error(std::move(packed));
  std::error_code none;
  const auto folder = std::filesystem::temp_directory_path(none);
  std::string name = ((none ? "/tmp" : folder) / "swiftlet-unpacked-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) return refused(path, "no temporary file can be made for it", errno);
  auto unpacked = std::make_shared<const UnpackedFile>(name);
  auto done = unpack_into(file, **packed);
  if (::close(file) != 0 && done) done = refused(path, "it cannot be unpacked", errno);
  if (!done) return forward_error(std::move(done));
  return unpacked;
}

}  // namespace

std::vector<std::byte> unpacked_start(const ByteSource& packed, std::size_t bytes) {
  constexpr std::size_t kLookBytes = 256U << 10U;  // more than a block
  std::vector<std::byte> in_bytes(std::min<std::uint64_t>(kLookBytes, packed.size()));
  std::vector<std::byte> out_bytes(bytes);
  if (!packed.read(0, in_bytes)) return {};
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     ZSTD_freeDCtx);
  ZSTD_inBuffer in{in_bytes.data(), in_bytes.size(), 0};
  ZSTD_outBuffer out{out_bytes.data(), out_bytes.size(), 0};
  while (context && out.pos < out.size && in.pos < in.size) {
    if (ZSTD_isError(ZSTD_decompressStream(context.get(), &out, &in)) != 0U) break;
  }
  out_bytes.resize(out.pos);
  return out_bytes;
}

UnpackedFile::~UnpackedFile() { ::unlink(path_.c_str()); }

Expected<std::shared_ptr<const UnpackedFile>> unpacked_copy_of(const std::filesystem::path& path) {
  using Key = std::tuple<std::string, std::uintmax_t, std::filesystem::file_time_type>;
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<const UnpackedFile>> copies;  // guarded by mutex

  std::error_code unknown;
  const Key key(std::filesystem::absolute(path, unknown).string(),
                std::filesystem::file_size(path, unknown),
                std::filesystem::last_write_time(path, unknown));
  const std::lock_guard lock(mutex);
  std::erase_if(copies, [](const auto& copy) { return copy.second.expired(); });
  if (const auto found = copies.find(key); found != copies.end()) {
    if (auto copy = found->second.lock()) return copy;
  }
  auto copy = unpack(path);
  if (copy) copies[key] = *copy;
  return copy;
}

}  // namespace swiftlet
