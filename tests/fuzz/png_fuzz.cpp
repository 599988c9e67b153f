// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are a depth image. What is read has the size that the header says, and the same bytes
// give the same image.

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "swiftlet/source/depth_png.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Mends the check sums of most mutants: libpng looks at nothing else of a chunk whose sum is
/// wrong.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (seed % 8 == 0) return size;
  constexpr std::size_t kFrame = 12;  // length, name, sum
  for (std::size_t at = 8; at + kFrame <= size;) {
    const std::size_t length = std::size_t{data[at]} << 24 | std::size_t{data[at + 1]} << 16 |
                               std::size_t{data[at + 2]} << 8 | data[at + 3];
    if (length > size - at - kFrame) break;
    const auto sum = crc32(0, data + at + 4, static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i)
      data[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += kFrame + length;
  }
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto depth = decode_depth_png(bytes, "fuzz.png", {.is_full_scale_invalid = true});
  if (!depth) {
    if (depth.error().what.empty()) std::abort();
    return 0;
  }
  const auto declared = [&](std::size_t at) { return data[at + 2] << 8 | data[at + 3]; };
  if (depth->raw.width() != declared(16) || depth->raw.height() != declared(20)) std::abort();
  if (std::ranges::count(depth->raw.pixels(), 65535) != 0) std::abort();
  const auto again = decode_depth_png(bytes, "fuzz.png", {.is_full_scale_invalid = true});
  if (!again || !std::ranges::equal(again->raw.pixels(), depth->raw.pixels())) std::abort();
  return 0;
}
