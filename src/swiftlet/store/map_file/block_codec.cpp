// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/block_codec.hpp"

#include <zstd.h>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

/// A chain of bijections: two inputs of equal length that differ in one word never collide.
class Checksum {
 public:
  void add(std::uint64_t word) { state_ = mix_bits(state_ ^ word); }
  void add(std::int32_t value) { add(std::uint64_t{static_cast<std::uint32_t>(value)}); }
  void add(std::span<const std::uint8_t> bytes) {
    add(std::uint64_t{bytes.size()});
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
      std::uint64_t word = 0;  // little endian, the last one filled up with zeros
      for (std::size_t k = 0; k < 8 && i + k < bytes.size(); ++k) {
        word |= std::uint64_t{bytes[i + k]} << (8 * k);
      }
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

std::uint64_t block_checksum(const BlockIndex& index, std::int64_t touched,
                             std::span<const std::uint8_t> data) {
  Checksum sum;
  sum.add(index.x);
  sum.add(index.y);
  sum.add(index.z);
  sum.add(static_cast<std::uint64_t>(touched));
  sum.add(data);
  return sum.value();
}

std::uint64_t meta_checksum(std::string_view key, std::string_view value) {
  Checksum sum;
  sum.add(bytes_of(key));
  sum.add(bytes_of(value));
  return sum.value();
}

void BlockCodec::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }
void BlockCodec::Free::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

BlockCodec::BlockCodec() : compressor_(ZSTD_createCCtx()), decompressor_(ZSTD_createDCtx()) {
  SWIFTLET_REQUIRE(compressor_ && decompressor_, "zstd needs memory for its contexts");
  SWIFTLET_REQUIRE(ZSTD_compressBound(kBlockVoxels) <= kMaxBytes, "a block fits the buffer");
  // Level 1: a block is small and mostly flat; higher levels gain 2 % and cost four times as much.
  ZSTD_CCtx_setParameter(compressor_.get(), ZSTD_c_compressionLevel, 1);
  ZSTD_CCtx_setParameter(compressor_.get(), ZSTD_c_checksumFlag, 1);
}

std::span<const std::uint8_t> BlockCodec::compress(const VoxelBlock& block) {
  const std::size_t size = ZSTD_compress2(compressor_.get(), buffer_.data(), buffer_.size(),
                                          block.voxels.data(), block.voxels.size());
  SWIFTLET_REQUIRE(!ZSTD_isError(size), "512 bytes always compress into the bound");
  return {buffer_.data(), size};
}

bool BlockCodec::decompress(std::span<const std::uint8_t> data, VoxelBlock& out) {
  const std::size_t frame = ZSTD_findFrameCompressedSize(data.data(), data.size());
  if (ZSTD_isError(frame) || frame != data.size()) return false;
  const std::size_t size = ZSTD_decompressDCtx(decompressor_.get(), out.voxels.data(),
                                               out.voxels.size(), data.data(), data.size());
  return !ZSTD_isError(size) && size == out.voxels.size();
}

}  // namespace swiftlet
