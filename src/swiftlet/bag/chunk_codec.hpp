// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// The most that an unpacked chunk may take [bytes]. rosbag's own writers start a new chunk at
/// 768 KiB, unless one message is larger; nobody's depth image is this large.
inline constexpr std::uint32_t kMaxChunkBytes = 256U << 20U;

/// Unpacks a chunk: "none", "lz4" (an LZ4 frame, whose checksum is verified), "bz2" or "zstd".
/// `out` grows with what really comes out, up to `size`, so that a lie about the size costs
/// nothing. Errors: what is wrong, in words; then `out` holds rubbish.
[[nodiscard]] std::optional<std::string> unpack_chunk(std::string_view compression,
                                                      std::span<const std::byte> packed,
                                                      std::uint32_t size,
                                                      std::vector<std::byte>& out);

/// Whether bytes begin as a frame of Zstandard does.
[[nodiscard]] bool is_zstd(std::span<const std::byte> bytes);

/// Unpacks one frame of Zstandard of at most kMaxChunkBytes. Errors: as unpack_chunk().
[[nodiscard]] std::optional<std::string> unpack_zstd_frame(std::span<const std::byte> packed,
                                                           std::vector<std::byte>& out);

/// Whether so many bytes of messages can have become so many. Depth shrinks to a third or a
/// twentieth; an image without any reading more, but that is one among others. Zstandard can be
/// made to grow 30000 times, and to keep its reader busy for as long.
[[nodiscard]] bool is_growth_plausible(std::uint64_t packed_bytes, std::uint64_t unpacked_bytes);

}  // namespace swiftlet
