// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

Transform<World, Camera> camera_in_world(const Transform<World, Body>& T_world_body,
                                         const Transform<Body, Camera>& T_body_camera) {
#if defined(COMPOSES_FRAMES_THAT_DO_NOT_MEET)
  return T_world_body * T_world_body;
#elif defined(COMPOSES_IN_THE_WRONG_ORDER)
  return T_body_camera * T_world_body;
#elif defined(TAKES_A_BODY_FOR_A_CAMERA)
  return T_world_body;
#elif defined(FORGETS_TO_INVERT)
  return (T_world_body * T_body_camera).inverse();
#else
  return T_world_body * T_body_camera;
#endif
}

}  // namespace swiftlet
