// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/mavlink/companion/flight_news.hpp"

namespace swiftlet::mavlink {

/// What the autopilot's side is told of a frame that the mapper has fused.
/// `T_body_camera`: the mount of its camera. A mount that does not turn at all is none that anybody
/// has measured, but says that the poses are the camera's own; then the vehicle's nose points where
/// the camera looks. `now` and `unix_now` are the same moment: a frame that is stamped by this
/// computer's clock within the last second was taken when it says; of others the arrival counts, as
/// far as it is known.
[[nodiscard]] MappedFrame mapped_frame(const Frame& frame,
                                       const Transform<Body, Camera>& T_body_camera, HostTime now,
                                       Stamp unix_now);

}  // namespace swiftlet::mavlink
