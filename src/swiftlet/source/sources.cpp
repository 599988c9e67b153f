// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sources.hpp"

#include <array>
#include <string>

// A source is one file and one line here: ALWAYS or the build option SWIFTLET_WITH_... that it
// needs, the name the user types, the function at the end of its file, and a sentence for
// `swiftlet list`.
#define SWIFTLET_SOURCES(X)                                             \
  X(ALWAYS, "7scenes", open_seven_scenes_source,                        \
    "folder of depth images and poses by frame number")                 \
  X(ALWAYS, "tum", open_tum_source,                                     \
    "TUM RGB-D folder: depth.txt and groundtruth.txt, joined by time")  \
  X(ALWAYS, "bag", open_bag_source,                                     \
    "recording of RealSense, ROS 1 or ROS 2: bag:depth.bag,pose.bag")   \
  X(ALWAYS, "openloris", open_openloris_source,                         \
    "OpenLORIS-Scene folder: a D435i on a robot that a T265 rides too") \
  X(REALSENSE, "realsense", open_realsense_source,                      \
    "live RealSense D400 and T265: realsense: or realsense:SERIAL")     \
  X(EMBREE, "sim", open_sim_source, "simulated D435 and T265 in a built-in scene or a .yaml file")

namespace swiftlet {

#define SWIFTLET_DECLARE(option, name, opener, summary) \
  Expected<FrameSourcePtr> opener(std::string_view rest);
SWIFTLET_SOURCES(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

namespace {

#define SWIFTLET_ROW(option, name, opener, summary) \
  Registered<OpenSource>{name, summary, SWIFTLET_IF_BUILT(SWIFTLET_HAS_##option, opener), #option},
constexpr auto kSources = std::to_array({SWIFTLET_SOURCES(SWIFTLET_ROW)});
#undef SWIFTLET_ROW

tl::unexpected<Error> no_kind(std::string_view address) {
  const std::string place = address.empty() ? "PLACE" : std::string(address);
  std::string examples;
  for (const auto& source : kSources)
    examples += (examples.empty() ? "" : " or ") + std::string(source.name) + ":" + place;
  return fail(ErrorCode::kUsage, std::string(address), "it does not say what kind of source it is",
              "write KIND:PLACE, as in " + examples);
}

}  // namespace

std::span<const Registered<OpenSource>> sources() { return kSources; }

Expected<FrameSourcePtr> open_source(std::string_view address) {
  const std::size_t colon = address.find(':');
  if (colon == std::string_view::npos) return no_kind(address);
  auto source = find_registered(sources(), address.substr(0, colon), "source");
  if (!source) return forward_error(std::move(source));
  if (source->make == nullptr) {
    return fail(ErrorCode::kUnsupported, std::string(source->name),
                "this build of Swiftlet has no such source",
                "install what it needs and configure again; `swiftlet list` tells what is missing");
  }
  return source->make(address.substr(colon + 1));
}

}  // namespace swiftlet
