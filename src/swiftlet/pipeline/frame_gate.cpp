// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/frame_gate.hpp"

#include <algorithm>
#include <cstring>

namespace swiftlet {
namespace {

constexpr double kMoved_m = 0.1, kMoved_rad = 0.05;

std::uint64_t hash_of_some_rows(const Image<std::uint16_t>& raw) {
  constexpr int kEvery = 8;
  constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (int v = 0; v < raw.height(); v += kEvery) {
    const auto row = raw.row(v);
    const std::size_t bytes = row.size_bytes();
    const auto* data = reinterpret_cast<const unsigned char*>(row.data());
    for (std::size_t i = 0; i < bytes; i += sizeof hash) {
      std::uint64_t word = 0;
      std::memcpy(&word, data + i, std::min(sizeof word, bytes - i));
      hash = (hash ^ word) * kFactor;
      hash ^= hash >> 32U;
    }
  }
  return hash;
}

}  // namespace

bool FrameGate::is_frozen(const Frame& frame) {
  if (limits_.max_frozen == 0) return false;
  Run& run = runs_[frame.camera];
  const std::uint64_t hash = hash_of_some_rows(frame.depth.raw);
  if (run.images == 0 || std::ranges::find(run.hashes, hash) == run.hashes.end()) {
    if (run.images == 0) run.hashes.fill(hash);
    run.hashes[run.next] = hash;
    run.next = (run.next + 1) % kInTurn;
    run.images = 1;
    run.T_world_camera = frame.T_world_camera;
    return false;
  }
  ++run.images;
  if (run.images <= limits_.max_frozen) return false;
  const auto& T = frame.T_world_camera;
  const double moved_m = (T.translation() - run.T_world_camera.translation()).norm();
  const double turned_rad = T.rotation().angularDistance(run.T_world_camera.rotation());
  return moved_m > kMoved_m || turned_rad > kMoved_rad;
}

std::optional<FrameVerdict> FrameGate::refusal(const Frame& frame) {
  const DepthImage& depth = frame.depth;
  const ReadingShares shares = shares_of_readings(depth);
  if (shares.valid == 0.0) return FrameVerdict::kNoReadings;
  if (shares.valid < limits_.min_valid) return FrameVerdict::kMostlyEmpty;
  if (shares.saturated > limits_.max_saturated) return FrameVerdict::kSaturated;
  if (limits_.max_at_one_value < 1.0 && share_at_one_value(depth) > limits_.max_at_one_value)
    return FrameVerdict::kSaturated;
  if (is_frozen(frame)) return FrameVerdict::kFrozen;
  if (limits_.max_smeared < 1.0 && share_of_smeared_edges(depth) > limits_.max_smeared)
    return FrameVerdict::kSmeared;
  if (limits_.max_rough < 1.0 && share_of_rough_pairs(depth) > limits_.max_rough)
    return FrameVerdict::kNoise;
  return std::nullopt;
}

}  // namespace swiftlet
