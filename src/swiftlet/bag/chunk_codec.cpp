// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/chunk_codec.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

namespace swiftlet {
namespace {

constexpr std::size_t kStepBytes = 1U << 20U;

/// What a decoder writes into: a vector that grows step by step up to the promised size, and keeps
/// its memory for the next chunk. One byte more is offered, so that a stream that is longer than
/// promised is noticed.
class GrowingOutput {
 public:
  enum class Promise { kExactly, kAtMost };
  GrowingOutput(std::vector<std::byte>& out, std::uint32_t size,
                Promise promise = Promise::kExactly)
      : out_(out), limit_(size), promise_(promise) {
    if (out_.size() > limit_ + 1) out_.resize(limit_ + 1);
  }
  /// Room for the decoder.
  std::span<std::byte> room() {
    if (used_ == out_.size()) out_.resize(std::min(limit_ + 1, used_ + kStepBytes));
    return std::span(out_).subspan(used_);
  }
  void use(std::size_t bytes) { used_ += bytes; }
  [[nodiscard]] bool is_too_long() const { return used_ > limit_; }
  [[nodiscard]] std::optional<std::string> finish() {
    out_.resize(used_);
    if (used_ == limit_ || (promise_ == Promise::kAtMost && !is_too_long())) return std::nullopt;
    return fmt::format("it unpacks to {} bytes where {} were promised", used_, limit_);
  }

 private:
  std::vector<std::byte>& out_;
  std::size_t limit_;
  std::size_t used_ = 0;
  Promise promise_;
};

std::optional<std::string> unpack_lz4(std::span<const std::byte> packed, GrowingOutput output) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0U)
    return "no memory for the LZ4 decoder";
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      raw, LZ4F_freeDecompressionContext);
  for (std::size_t hint = 1; hint != 0;) {
    const auto room = output.room();
    std::size_t produced = room.size();
    std::size_t consumed = packed.size();
    hint =
        LZ4F_decompress(context.get(), room.data(), &produced, packed.data(), &consumed, nullptr);
    if (LZ4F_isError(hint) != 0U)
      return fmt::format("its LZ4 data are damaged ({})", LZ4F_getErrorName(hint));
    output.use(produced);
    packed = packed.subspan(consumed);
    if (output.is_too_long()) break;
    if (hint != 0 && produced == 0 && consumed == 0) return "its LZ4 data end too early";
  }
  return output.finish();
}

std::optional<std::string> unpack_bz2(std::span<const std::byte> packed, GrowingOutput output) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return "no memory for the bzip2 decoder";
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> guard(&stream,
                                                                         BZ2_bzDecompressEnd);
  // The library's interface is not const-correct; it only reads its input.
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));
  stream.avail_in = static_cast<unsigned>(packed.size());
  for (int state = BZ_OK; state != BZ_STREAM_END;) {
    const auto room = output.room();
    stream.next_out = reinterpret_cast<char*>(room.data());
    stream.avail_out = static_cast<unsigned>(room.size());
    const unsigned in_before = stream.avail_in;
    state = BZ2_bzDecompress(&stream);
    const std::size_t produced = room.size() - stream.avail_out;
    output.use(produced);
    if (state != BZ_OK && state != BZ_STREAM_END) return "its bzip2 data are damaged";
    if (output.is_too_long()) break;
    if (state == BZ_OK && produced == 0 && stream.avail_in == in_before)
      return "its bzip2 data end too early";
  }
  return output.finish();
}

/// The memory that a frame asks its reader for: writers of recordings take 8 MiB at most.
constexpr int kMostWindowBits = 25;

std::optional<std::string> unpack_zstd(std::span<const std::byte> packed, GrowingOutput output) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     ZSTD_freeDCtx);
  if (!context) return "no memory for the Zstandard decoder";
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, kMostWindowBits);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (std::size_t hint = 1; hint != 0;) {
    const auto room = output.room();
    ZSTD_outBuffer out{room.data(), room.size(), 0};
    const std::size_t before = in.pos;
    hint = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(hint) != 0U)
      return fmt::format("its Zstandard data are damaged ({})", ZSTD_getErrorName(hint));
    output.use(out.pos);
    if (output.is_too_long()) break;
    if (hint != 0 && out.pos == 0 && in.pos == before) return "its Zstandard data end too early";
  }
  return output.finish();
}

}  // namespace

bool is_zstd(std::span<const std::byte> bytes) {
  constexpr std::array<std::byte, 4> kMagic{std::byte{0x28}, std::byte{0xb5}, std::byte{0x2f},
                                            std::byte{0xfd}};
  return bytes.size() >= kMagic.size() && std::ranges::equal(bytes.first(kMagic.size()), kMagic);
}

std::optional<std::string> unpack_zstd_frame(std::span<const std::byte> packed,
                                             std::vector<std::byte>& out) {
  return unpack_zstd(packed, GrowingOutput(out, kMaxChunkBytes, GrowingOutput::Promise::kAtMost));
}

bool is_growth_plausible(std::uint64_t packed_bytes, std::uint64_t unpacked_bytes) {
  constexpr std::uint64_t kFreeBytes = 64U << 20U;
  constexpr std::uint64_t kMostGrowth = 32'768;  // images without a reading shrink 7000 times
  return unpacked_bytes <= kFreeBytes + kMostGrowth * packed_bytes;
}

std::optional<std::string> unpack_chunk(std::string_view compression,
                                        std::span<const std::byte> packed, std::uint32_t size,
                                        std::vector<std::byte>& out) {
  if (size > kMaxChunkBytes || packed.size() > kMaxChunkBytes)
    return fmt::format("a chunk of {} bytes is larger than any camera writes", size);
  if (compression == "lz4") return unpack_lz4(packed, GrowingOutput(out, size));
  if (compression == "zstd") return unpack_zstd(packed, GrowingOutput(out, size));
  if (compression == "bz2") return unpack_bz2(packed, GrowingOutput(out, size));
  if (compression != "none") return fmt::format("its compression '{}' is unknown", compression);
  if (packed.size() != size)
    return fmt::format("it holds {} bytes where {} were promised", packed.size(), size);
  out.assign(packed.begin(), packed.end());
  return std::nullopt;
}

}  // namespace swiftlet
