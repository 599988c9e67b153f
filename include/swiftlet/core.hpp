// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

/// @file
/// What swiftlet::core offers: the mapper and what a planner asks of its map; no I/O. These
/// headers, and what they include, are installed; all others are the library's own business and may
/// change with any version.

// The words: errors as values, frames, times, voxels.
#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/faults.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/image.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/base/voxel_box.hpp"
#include "swiftlet/base/voxel_index.hpp"

// Depth frames with poses in, occupancy map out.
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/frame/pose_track.hpp"
#include "swiftlet/pipeline/frame_verdict.hpp"
#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"
#include "swiftlet/pipeline/new_world_rule.hpp"

// The maps there are.
#include "swiftlet/map/block_archive.hpp"
#include "swiftlet/map/block_map.hpp"
#include "swiftlet/map/frame_mark.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/log_odds_scale.hpp"
#include "swiftlet/map/map_header.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/map/map_window.hpp"
#include "swiftlet/map/memory_archive.hpp"
#include "swiftlet/map/occupancy_map.hpp"
#include "swiftlet/map/rolling_map.hpp"

// What can be asked of any of them.
#include "swiftlet/query/box_query.hpp"
#include "swiftlet/query/known_voxels.hpp"
#include "swiftlet/query/map_summary.hpp"
#include "swiftlet/query/occupancy_query.hpp"
#include "swiftlet/query/ray_query.hpp"
#include "swiftlet/query/voxel_counts.hpp"

// What a planner asks of a snapshot.
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/distance/distance_field_thread.hpp"
#include "swiftlet/query/explore/frontier_clusters.hpp"
#include "swiftlet/query/explore/frontier_map.hpp"
#include "swiftlet/query/explore/room_middle.hpp"
#include "swiftlet/query/explore/view_camera.hpp"
#include "swiftlet/query/explore/view_gain.hpp"
#include "swiftlet/query/explore/view_pose.hpp"
#include "swiftlet/query/region_query.hpp"
#include "swiftlet/query/sweep/body_shape.hpp"
#include "swiftlet/query/sweep/speed_limit.hpp"
#include "swiftlet/query/sweep/sweep.hpp"
#include "swiftlet/query/sweep/sweep_path.hpp"

/// Real-time 3-D occupancy mapping. All lengths are in metres, all times in nanoseconds of a named
/// clock; `T_world_camera` maps points of the camera to the world.
namespace swiftlet {}
