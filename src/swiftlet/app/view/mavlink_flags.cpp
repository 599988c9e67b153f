// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/mavlink_flags.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

namespace swiftlet::app {
namespace {

constexpr std::array<std::string_view, 3> kPoses{"none", "odometry", "vision"};  // as PoseTelling

/// The level cylinder about the body's origin that the box fits into.
void take_body(const BodyBox& box, mavlink::RingOptions& ring) {
  const Eigen::Vector3d reach = box.from_m.cwiseAbs().cwiseMax(box.to_m.cwiseAbs());
  ring.body_radius_m = reach.head<2>().norm();
  ring.body_height_m = 2 * reach.z();
}

mavlink::RingOptions ring_options(const MapperConfig& config, const RigOptions* rig) {
  mavlink::RingOptions ring;
  ring.max_m = 0.5 * std::min(config.map.size_m.x(), config.map.size_m.y());
  if (rig != nullptr && rig->body_box) take_body(*rig->body_box, ring);
  return ring;
}

}  // namespace

void declare_mavlink_flags(CLI::App& parser, MavlinkFlags& flags) {
  constexpr const char* kGroup = "Autopilot";
  parser
      .add_option("--mavlink", flags.links,
                  "tell it what is in the way: udp:HOST:PORT, udpin:HOST:PORT, tcp:HOST:PORT or "
                  "serial:DEVICE?baud=921600; several may be given")
      ->type_name("LINK")
      ->allow_extra_args(false)
      ->group(kGroup);
  parser.add_option("--mavlink-key", flags.key_file, "sign, and hear only what is signed with it")
      ->type_name("FILE")
      ->group(kGroup);
  parser
      .add_option("--mavlink-poses", flags.poses,
                  "also tell it the poses: none, odometry or vision (VISION_POSITION_ESTIMATE)")
      ->check(CLI::IsMember(std::vector<std::string>(kPoses.begin(), kPoses.end())).description(""))
      ->type_name("HOW")
      ->capture_default_str()
      ->group(kGroup);
}

Expected<mavlink::AutopilotOptions> autopilot_options(const MavlinkFlags& flags,
                                                      const MapperConfig& config,
                                                      const RigOptions* rig) {
  mavlink::AutopilotOptions options;
  for (const std::string& text : flags.links) {
    auto link = mavlink::parse_link_address(text);
    if (!link) return forward_error(std::move(link));
    options.links.links.push_back(std::move(*link));
  }
  if (!flags.key_file.empty()) {
    auto key = mavlink::load_signing_key(flags.key_file);
    if (!key) return forward_error(std::move(key));
    options.links.key = *key;
  }
  const auto* const how = std::ranges::find(kPoses, flags.poses);
  options.companion.poses = static_cast<mavlink::PoseTelling>(how - kPoses.begin());
  options.companion.ring = ring_options(config, rig);
  return options;
}

}  // namespace swiftlet::app
