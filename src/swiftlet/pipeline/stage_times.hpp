// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// The stages of one frame, in order.
enum class Stage : std::size_t { kPreprocess, kRecentre, kIntegrate, kPublish };
inline constexpr std::array<std::string_view, 4> kStageNames{"preprocess", "recentre", "integrate",
                                                             "publish"};

/// How long each stage of one frame took.
struct StageTimes {
  std::array<Nanoseconds, kStageNames.size()> of{};

  [[nodiscard]] Nanoseconds total() const {
    Nanoseconds sum{0};
    for (const Nanoseconds t : of) sum += t;
    return sum;
  }
};

/// Splits a frame into stages: each call of finish() books the time since the last one.
class StageTimer {
 public:
  explicit StageTimer(StageTimes& times) : times_(times) {}

  void finish(Stage stage) {
    const auto now = std::chrono::steady_clock::now();
    times_.of[static_cast<std::size_t>(stage)] += now - last_;
    last_ = now;
  }

 private:
  StageTimes& times_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace swiftlet
