// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

#include "swiftlet/base/progress.hpp"

namespace swiftlet::app {

/// How far the work has come.
struct ProgressState {
  std::size_t done = 0;
  std::optional<std::size_t> total;  ///< absent where only the end tells
  double elapsed_s = 0.0;
};

/// "123/270 frames, 31.2 fps, 5 s left": rate and remaining time from the work done so far.
[[nodiscard]] std::string progress_text(const ProgressState& state);
/// "[=====>    ] " of `width` characters inside; empty if the total is not known.
[[nodiscard]] std::string progress_bar(const ProgressState& state, int width);

/// Shows progress on standard error: a bar that redraws itself on a terminal, a plain line every
/// few seconds into a file or pipe.
class Progress {
 public:
  explicit Progress(std::optional<std::size_t> total);

  /// Cheap enough for every frame.
  void update(std::size_t done);
  /// A line of its own above the progress.
  void tell(const std::string& text) const;
  /// Ends the line that a terminal shows.
  void finish();
  [[nodiscard]] double elapsed_s() const;

 private:
  using Clock = std::chrono::steady_clock;

  const bool is_terminal_;
  std::optional<std::size_t> total_;
  std::size_t done_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

/// What shows the progress of one piece of work after another, as Progress does; the last line ends
/// with the last copy.
[[nodiscard]] ProgressFunction shown_progress();

}  // namespace swiftlet::app
