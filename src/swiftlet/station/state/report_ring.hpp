// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/station/state/map_info.hpp"

namespace swiftlet::station {

/// A queue of frame reports from one thread to one other, of fixed room. Neither side waits for the
/// other or allocates; what does not fit is dropped and counted.
class ReportRing {
 public:
  explicit ReportRing(std::size_t room) : slots_(room) {}

  /// The writer's. False if there is no room.
  bool push(const FrameReport& report) {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == slots_.size()) {
      missed_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[tail % slots_.size()] = report;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// The reader's: calls visit(const FrameReport&) for all that have come, oldest first.
  template <class Visit>
  void drain(Visit&& visit) {
    std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t tail = tail_.load(std::memory_order_acquire);
    for (; head != tail; ++head) {
      visit(slots_[head % slots_.size()]);
      head_.store(head + 1, std::memory_order_release);
    }
  }

  [[nodiscard]] std::uint64_t missed() const { return missed_.load(std::memory_order_relaxed); }

 private:
  std::vector<FrameReport> slots_;
  std::atomic<std::uint64_t> head_{0};
  std::atomic<std::uint64_t> tail_{0};
  std::atomic<std::uint64_t> missed_{0};
};

}  // namespace swiftlet::station
