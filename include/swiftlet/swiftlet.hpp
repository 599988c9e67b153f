// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

/// @file
/// What swiftlet::swiftlet offers beside the core: where frames come from and maps go to, and what
/// is made of them. These headers, and what they include, are installed; all others may change with
/// any version.

#include "swiftlet/core.hpp"

// Parameters from files.
#include "swiftlet/config/config_file.hpp"

// Frames: recordings, the simulated rig, cameras; or depth images and poses of your own.
#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/live/live_rig.hpp"
#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/rig_file.hpp"
#include "swiftlet/source/sources.hpp"

// A source through a mapper into files.
#include "swiftlet/session/flight.hpp"
#include "swiftlet/session/mapping_session.hpp"
#include "swiftlet/session/mapping_summary.hpp"
#include "swiftlet/session/session_observer.hpp"

// Map files: written while a flight goes on or at once, read block by block or whole, exported.
#include "swiftlet/store/export/exporters.hpp"
#include "swiftlet/store/map_file/save_map.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"
#include "swiftlet/store/map_loader.hpp"
#include "swiftlet/store/opened_map.hpp"
#include "swiftlet/store/stream/block_store.hpp"

// Paths on the map: where a body can get to, and how.
#include "swiftlet/plan/plan_path.hpp"
#include "swiftlet/plan/reachable_space.hpp"

// A map as a picture.
#include "swiftlet/render/picture.hpp"
#include "swiftlet/render/projection.hpp"

// Is the map right, and fast; what the camera is worth; what is wrong with the rig.
#include "swiftlet/doctor/doctor_exam.hpp"
#include "swiftlet/eval/bench/bench_rows.hpp"
#include "swiftlet/eval/camera/calibration.hpp"
#include "swiftlet/eval/camera/fill_sweep.hpp"
#include "swiftlet/eval/camera/noise_fit.hpp"
#include "swiftlet/eval/score/score.hpp"
#include "swiftlet/eval/score/score_job.hpp"
#include "swiftlet/eval/score/score_report.hpp"

/// Maps as pictures.
namespace swiftlet::render {}

/// Is a map right, and fast; what a camera is worth.
namespace swiftlet::eval {}
