// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

/// Rigid frames by name, as ROS's tf and calibration files tell them: where the child is in the
/// parent, one tie at a time.
class FrameTree {
 public:
  /// T_parent_child: p_parent = R p_child + t. Errors: kCorruptInput if it is no rigid transform.
  [[nodiscard]] Status add(const std::string& parent, const std::string& child,
                           const Eigen::Quaterniond& R, const Eigen::Vector3d& t_m);

  /// Where a camera is on a body; nullopt if no chain of ties leads from one to the other.
  [[nodiscard]] std::optional<Transform<Body, Camera>> mount(const std::string& body,
                                                             const std::string& camera) const;

  /// The names of all frames.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  struct Anywhere {};
  using Hop = Transform<Anywhere, Anywhere>;
  std::map<std::string, std::map<std::string, Hop>> hops_;  // T_to_from by from, then to
};

}  // namespace swiftlet
