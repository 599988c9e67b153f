// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/reaction.hpp"

#include <algorithm>

namespace swiftlet::eval {

void Reactions::observe(const MoverSights& sights, const Claims& claims) {
  const auto voxels = states_.voxels();
  for (std::size_t i = 0; i < voxels.size(); ++i)
    observe(voxels[i], sights.voxels()[i], claims.voxels()[i]);
  last_claims_ = claims;
  last_sights_ = sights;
}

void Reactions::observe(State& state, MoverSight sight, Occupancy claim) {
  const bool shows_matter = sight == MoverSight::kMatter;
  if (shows_matter && state.phase == Phase::kGoing) state = {Phase::kThere, 0};
  if (shows_matter && state.phase == Phase::kEmpty && claim != Occupancy::kOccupied)
    state = {Phase::kComing, 0};
  if (shows_matter && state.phase == Phase::kEmpty) {
    until_occupied_.push_back(1);
    state = {Phase::kThere, 0};
  }
  if (state.phase == Phase::kComing && shows_matter) {
    ++state.frames;
    if (claim != Occupancy::kOccupied) return;
    until_occupied_.push_back(state.frames);
    state = {Phase::kThere, 0};
    return;
  }
  if (sight != MoverSight::kLookedThrough) return;
  if (state.phase == Phase::kComing) {
    missed_ += state.frames >= kJudgedAfter ? 1 : 0;
    state = {};
    return;
  }
  if (state.phase == Phase::kThere) state = {Phase::kGoing, 0};
  if (state.phase != Phase::kGoing) return;
  ++state.frames;
  if (claim != Occupancy::kFree) {
    not_freed_ += state.frames == kFreedWithin ? 1 : 0;
    return;
  }
  until_free_.push_back(state.frames);
  state = {};
}

std::size_t Reactions::freed() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(until_free_, [](int frames) { return frames <= kFreedWithin; }));
}

std::size_t Reactions::ghosts() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < last_claims_.size(); ++i) {
    const Phase phase = states_.voxels()[i].phase;
    const bool was_there = phase == Phase::kThere || phase == Phase::kGoing;
    const bool is_there = last_sights_.voxels()[i] == MoverSight::kMatter;
    const bool is_claimed = last_claims_.voxels()[i] == Occupancy::kOccupied;
    count += was_there && !is_there && is_claimed ? 1 : 0;
  }
  return count;
}

}  // namespace swiftlet::eval
