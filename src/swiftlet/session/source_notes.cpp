// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/session/source_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace swiftlet {
namespace {

constexpr Nanoseconds kSilentFor = std::chrono::seconds(2);

void note_clock(std::string_view whose, const ClockSteps& steps, std::vector<std::string>& notes) {
  if (steps.back > 0) {
    notes.push_back(fmt::format("the clock of the {} was set back {}, by {:.3g} s; mapping went on",
                                whose, times_text(steps.back), seconds(steps.last_back)));
  }
  if (steps.ahead > 0) {
    notes.push_back(fmt::format("the clock of the {} was set ahead {}, by {:.3g} h", whose,
                                times_text(steps.ahead), seconds(steps.last_ahead) / 3600.0));
  }
}

void append(std::vector<std::string>& notes, std::vector<std::string> more) {
  std::ranges::move(more, std::back_inserter(notes));
}

}  // namespace

std::string times_text(std::size_t count) {
  return fmt::format("{} time{}", count, count == 1 ? "" : "s");
}

std::vector<std::string> clock_notes(const FrameTally& tally) {
  std::vector<std::string> notes;
  note_clock("poses", tally.pose_clock, notes);
  note_clock("images", tally.image_clock, notes);
  return notes;
}

std::vector<std::string> silence_notes(const RigStatistics& facts, const RigOptions& rig) {
  std::optional<Stamp> first, last;
  for (const CameraStatistics& camera : facts.cameras) {
    if (!camera.first) continue;
    first = first ? std::min(*first, *camera.first) : *camera.first;
    last = last ? std::max(*last, *camera.last) : *camera.last;
  }
  std::vector<std::string> notes;
  for (std::size_t i = 0; last && i < facts.cameras.size(); ++i) {
    const auto& own = facts.cameras[i].last;
    if (own && *last - *own <= kSilentFor) continue;
    const std::string since =
        own ? fmt::format("no image after {:.2f} s", seconds(*own - *first)) : "not one image";
    notes.push_back(
        fmt::format("{}: {} of {:.2f}", rig.cameras[i].title(), since, seconds(*last - *first)));
  }
  return notes;
}

std::vector<std::string> intrinsics_notes(const RigStatistics& facts, const RigOptions& rig) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < facts.cameras.size(); ++i) {
    const CameraStatistics& camera = facts.cameras[i];
    if (!camera.intrinsics_changed) continue;
    notes.push_back(
        fmt::format("{}: its intrinsics changed {}, first {:.2f} s after its first "
                    "image; each image was mapped with its own",
                    rig.cameras[i].title(), times_text(camera.intrinsics_changes),
                    seconds(*camera.intrinsics_changed - *camera.first)));
  }
  return notes;
}

std::vector<std::string> source_notes(const FrameSource& source) {
  std::vector<std::string> notes = source.info().choices;
  append(notes, clock_notes(source.tally()));
  if (source.statistics() != nullptr && source.rig() != nullptr) {
    append(notes, silence_notes(*source.statistics(), *source.rig()));
    append(notes, intrinsics_notes(*source.statistics(), *source.rig()));
  }
  return notes;
}

}  // namespace swiftlet
