// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/frame_tree.hpp"

#include <deque>
#include <utility>

namespace swiftlet {

Status FrameTree::add(const std::string& parent, const std::string& child,
                      const Eigen::Quaterniond& R, const Eigen::Vector3d& t_m) {
  auto T = Hop::from(R, t_m);
  if (!T) return forward_error(std::move(T));
  hops_[child].insert_or_assign(parent, *T);
  hops_[parent].insert_or_assign(child, T->inverse());
  return Done{};
}

std::vector<std::string> FrameTree::names() const {
  std::vector<std::string> names;
  for (const auto& [name, hops] : hops_) names.push_back(name);
  return names;
}

std::optional<Transform<Body, Camera>> FrameTree::mount(const std::string& body,
                                                        const std::string& camera) const {
  std::map<std::string, Hop> reached{{camera, Hop{}}};  // T_here_camera; breadth first
  for (std::deque<std::string> open{camera}; !open.empty(); open.pop_front()) {
    const Hop T_here_camera = reached.at(open.front());
    if (open.front() == body) {
      return Transform<Body, Camera>::trusted(T_here_camera.rotation(),
                                              T_here_camera.translation());
    }
    const auto here = hops_.find(open.front());
    if (here == hops_.end()) continue;
    for (const auto& [next, T_next_here] : here->second) {
      if (reached.emplace(next, T_next_here * T_here_camera).second) open.push_back(next);
    }
  }
  return std::nullopt;
}

}  // namespace swiftlet
