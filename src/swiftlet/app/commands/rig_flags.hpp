// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace swiftlet::app {

/// Flags that stand for options of the source's address; empty where not given.
struct RigFlags {
  std::string rig, pairing, on_jump, depth_topic, info_topic, pose_topic, body_frame, world_frame;

  /// "bag:a.bag" with --pairing nearest is "bag:a.bag?pairing=nearest", as the user could write it.
  [[nodiscard]] std::string added_to(std::string address) const;
};

void declare_rig_flags(CLI::App& parser, RigFlags& flags);

}  // namespace swiftlet::app
