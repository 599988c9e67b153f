// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string_view>

#include "swiftlet/source/frame_source.hpp"

namespace swiftlet {

/// The simulated rig: `sim:SCENE` or `sim:SCENE?option=value&...`, where SCENE is a built-in scene,
/// the path of a .yaml file, or `random:KIND` for one that is drawn (sim/random). Options:
///   seed=N         other noise, same flight (default: the scene's); another random scene
///   noise=on|off   off: ideal instruments, trusted from the start (default: on)
///   start=SECONDS  switches the rig on that far into the flight (default: 0)
///   frames=N       at most N depth images (default: to the end of the flight)
///   rate=HZ        depth images a second (default: the scene's)
///   barrel=SHARE   a bent stereo pair, see sim::StereoOptions::barrel (default: the scene's)
///   cameras=N      that many, evenly around the body, the first is the scene's (default: 1)
///   shuffle=N      images of one period arrive in an order drawn from this seed
///   fault=NAME     something goes wrong with the poses, see sim/pose_faults.cpp
///   fault_at=SECONDS  when, where that matters (default: 5)
/// those of random scenes, see sim::RandomSceneOptions:
///   size=METRES, density=0..3, thinnest=METRES
/// and those of every rig: rig=FILE, pairing, on_jump, pose_offset_ms.
///
/// Depth images and T265 samples come in time order and meet in a Rig, as those of a real rig
/// would; frames before the tracker is sure of itself are lost and counted.
/// World frame: the scene's. A T265's world starts at the body's place and heading; the simulation
/// knows where that is in the scene and puts it there (as a surveyed take-off point would), so the
/// map's axes are exactly those of the scene file, up to the tracker's noise and drift.
/// Errors: kUsage for unknown options, and those of load_scene().
[[nodiscard]] Expected<FrameSourcePtr> open_sim_source(std::string_view rest);

}  // namespace swiftlet
