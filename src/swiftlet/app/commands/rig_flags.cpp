// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/commands/rig_flags.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <string_view>
#include <utility>

#include "swiftlet/source/address_options.hpp"

namespace swiftlet::app {
namespace {

struct RigFlag {
  std::string_view option;  ///< of the address; the flag is the same with '-' for '_'
  std::string RigFlags::*value;
  const char* meaning;
  const char* type_name;
};
constexpr std::array kFlags{
    RigFlag{"rig", &RigFlags::rig, "cameras, mounts and gates, as a YAML file (docs/rig.md)",
            "FILE"},
    RigFlag{"pairing", &RigFlags::pairing, "pose of an image: interpolate (default) or nearest",
            "HOW"},
    RigFlag{"on_jump", &RigFlags::on_jump,
            "when the tracker corrects itself: keep (default) or clear the map", "WHAT"},
    RigFlag{"depth_topic", &RigFlags::depth_topic, "of a ROS bag, see 'swiftlet info FILE.bag'",
            "TOPIC"},
    RigFlag{"info_topic", &RigFlags::info_topic,
            "CameraInfo; default: camera_info beside the images", "TOPIC"},
    RigFlag{"pose_topic", &RigFlags::pose_topic, "Odometry, PoseStamped, TransformStamped or tf",
            "TOPIC"},
    RigFlag{"body_frame", &RigFlags::body_frame,
            "frame of tf that is the vehicle; default: what carries the camera", "FRAME"},
    RigFlag{"world_frame", &RigFlags::world_frame,
            "frame of tf that is the world; default: its root", "FRAME"},
};

std::string spelled(std::string_view option) {
  std::string flag = "--";
  for (const char c : option) flag += c == '_' ? '-' : c;
  return flag;
}

}  // namespace

std::string RigFlags::added_to(std::string address) const {
  for (const RigFlag& flag : kFlags) {
    const std::string& value = this->*flag.value;
    if (!value.empty()) address = with_option(std::move(address), flag.option, value);
  }
  return address;
}

void declare_rig_flags(CLI::App& parser, RigFlags& flags) {
  for (const RigFlag& flag : kFlags) {
    parser.add_option(spelled(flag.option), flags.*flag.value, flag.meaning)
        ->group("Rig")
        ->type_name(flag.type_name);
  }
}

}  // namespace swiftlet::app
