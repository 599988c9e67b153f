// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/rig_event.hpp"

namespace swiftlet {

/// An image that a recording names and that cannot be used.
struct SkippedImage {
  FrameLoss loss;
  Error why;  ///< with the file
};

/// What to count an image as that could not be read.
[[nodiscard]] inline FrameLoss loss_of_image(const Error& why) {
  return why.code == ErrorCode::kNotFound ? FrameLoss::kImageMissing : FrameLoss::kImageUnreadable;
}

/// The bad records of a recording: one must not cost the others. The first few are told as events,
/// and the first is the error of a recording in which nothing is good. Counting is the owner's.
class SkippedRecords {
 public:
  void add(Error why) {
    if (told_++ < kMostTold) events_.add({RigEventKind::kSkipped, why.where, why.what});
    if (!first_) first_ = std::move(why);
  }
  [[nodiscard]] std::vector<RigEvent> take_events() { return events_.take(); }

  /// What the end of a recording is: an error if nothing came of it. Empties itself, so that after
  /// the error there is an end.
  [[nodiscard]] Expected<std::optional<Frame>> end(const FrameTally& tally) {
    if (!first_ || tally.delivered > 0) return std::nullopt;
    return tl::make_unexpected(*std::exchange(first_, std::nullopt));
  }

 private:
  static constexpr std::size_t kMostTold = 5;
  RigEventList events_;
  std::optional<Error> first_;
  std::size_t told_ = 0;
};

}  // namespace swiftlet
