// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/map/block_window.hpp"

namespace swiftlet {

using BlockId = std::uint32_t;  ///< place of a block in the pool
inline constexpr BlockId kNoBlock = 0xffffffffU;

/// Which pool block stands for which block of space, for one window: a 3-D array addressed modulo
/// its size.
///
/// Wrap-around: block b lives at b mod size along each axis, wherever the window is. Moving the
/// window moves no entry; a block that enters takes over the entry of one that left.
class BlockDirectory {
 public:
  BlockDirectory() = default;
  explicit BlockDirectory(const BlockIndex& size)
      : window_{{0, 0, 0}, size}, ids_(BlockWindow{{}, size}.block_count(), kNoBlock) {}

  [[nodiscard]] const BlockWindow& window() const { return window_; }
  [[nodiscard]] std::size_t entry_count() const { return ids_.size(); }

  /// Moves the window. REQUIRES: the entries of all blocks that leave are kNoBlock.
  void move_to(const BlockIndex& first) {
    window_.first = first;
    phase_ = {floor_mod(first.x, window_.size.x), floor_mod(first.y, window_.size.y),
              floor_mod(first.z, window_.size.z)};
  }

  /// REQUIRES: window().contains(b).
  [[nodiscard]] std::size_t entry_of(const BlockIndex& b) const {
    const auto wrap = [](std::int32_t v, std::int32_t first, std::int32_t phase, std::int32_t n) {
      const std::int32_t i = v - first + phase;
      return static_cast<std::size_t>(i < n ? i : i - n);
    };
    const auto nx = static_cast<std::size_t>(window_.size.x);
    const auto ny = static_cast<std::size_t>(window_.size.y);
    const std::size_t x = wrap(b.x, window_.first.x, phase_.x, window_.size.x);
    const std::size_t y = wrap(b.y, window_.first.y, phase_.y, window_.size.y);
    const std::size_t z = wrap(b.z, window_.first.z, phase_.z, window_.size.z);
    return (z * ny + y) * nx + x;
  }

  [[nodiscard]] BlockId at(std::size_t entry) const { return ids_[entry]; }
  void set(std::size_t entry, BlockId id) { ids_[entry] = id; }

  /// kNoBlock outside the window, too.
  [[nodiscard]] BlockId find(const BlockIndex& b) const {
    return window_.contains(b) ? ids_[entry_of(b)] : kNoBlock;
  }

 private:
  [[nodiscard]] static constexpr std::int32_t floor_mod(std::int32_t v, std::int32_t n) {
    const std::int32_t r = v % n;
    return r < 0 ? r + n : r;
  }

  BlockWindow window_{};
  BlockIndex phase_{};  // window_.first modulo window_.size
  std::vector<BlockId> ids_;
};

}  // namespace swiftlet
