// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/chunk_codec.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace swiftlet {
namespace {

constexpr std::size_t kStepBytes = 1U << 20U;

/// What a decoder writes into: a vector that grows step by step up to the promised size. One byte
/// more is offered, so that a stream that is longer than promised is noticed.
class GrowingOutput {
 public:
  GrowingOutput(std::vector<std::byte>& out, std::uint32_t size) : out_(out), limit_(size) {
    out_.clear();
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
    if (used_ == limit_) return std::nullopt;
    return fmt::format("it unpacks to {} bytes where {} were promised", used_, limit_);
  }

 private:
  std::vector<std::byte>& out_;
  std::size_t limit_;
  std::size_t used_ = 0;
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

}  // namespace

std::optional<std::string> unpack_chunk(std::string_view compression,
                                        std::span<const std::byte> packed, std::uint32_t size,
                                        std::vector<std::byte>& out) {
  if (size > kMaxChunkBytes || packed.size() > kMaxChunkBytes)
    return fmt::format("a chunk of {} bytes is larger than any camera writes", size);
  if (compression == "lz4") return unpack_lz4(packed, GrowingOutput(out, size));
  if (compression == "bz2") return unpack_bz2(packed, GrowingOutput(out, size));
  if (compression != "none") return fmt::format("its compression '{}' is unknown", compression);
  if (packed.size() != size)
    return fmt::format("it holds {} bytes where {} were promised", packed.size(), size);
  out.assign(packed.begin(), packed.end());
  return std::nullopt;
}

}  // namespace swiftlet
