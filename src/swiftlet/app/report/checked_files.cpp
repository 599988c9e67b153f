// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/checked_files.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "swiftlet/app/config_warnings.hpp"
#include "swiftlet/app/report/bag_summary.hpp"
#include "swiftlet/bag/file_or_recording.hpp"
#include "swiftlet/config/config_file.hpp"
#include "swiftlet/file/file_content.hpp"
#include "swiftlet/file/yaml_document_private.hpp"
#include "swiftlet/source/rig/rig_file.hpp"
#include "swiftlet/store/export/octomap_import.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"
#if SWIFTLET_HAS_EMBREE
#include "swiftlet/sim/scene_file.hpp"
#endif

namespace swiftlet::app {
namespace {

template <class T>
Faults fault_if_any(Expected<T>&& result) {
  return result ? Faults{} : fault_of(std::move(result));
}

Faults faults_in_bag(const std::string& path) {
  auto bag = summarize_bag(path);
  if (!bag) return fault_of(std::move(bag));
  return bag->fault ? Faults{*bag->fault} : Faults{};
}

Faults faults_in_config(const std::string& text, const std::string& path) {
  auto config = parse_config(text, path);
  if (!config) return std::move(config).error();
  tell_warnings(*config);
  return {};
}

Faults faults_in_rig(const std::string& text, const std::string& path) {
  return fault_if_any(parse_rig(text, path));
}

Faults faults_in_scene([[maybe_unused]] const std::string& text, const std::string& path) {
#if SWIFTLET_HAS_EMBREE
  return fault_if_any(sim::parse_scene(text, path));
#else
  return {{ErrorCode::kUnsupported, path, "this build knows no scenes",
           "install Embree and configure with -DSWIFTLET_WITH_EMBREE=ON"}};
#endif
}

/// Files that are YAML, by the keys that stand in their first column.
struct YamlKind {
  std::span<const std::string_view> keys;
  Faults (*faults)(const std::string& text, const std::string& path);
};
constexpr std::array<std::string_view, 7> kConfigKeys{
    "map", "quality", "depth", "distortion", "sensor", "integrate", "occupancy"};
constexpr std::array<std::string_view, 3> kRigKeys{"cameras", "pose", "body_box"};
constexpr std::array<std::string_view, 12> kSceneKeys{"about",     "seed",   "materials", "boxes",
                                                      "cylinders", "planes", "meshes",    "movers",
                                                      "camera",    "mount",  "tracker",   "flight"};
constexpr std::array kYamlKinds{YamlKind{kConfigKeys, faults_in_config},
                                YamlKind{kRigKeys, faults_in_rig},
                                YamlKind{kSceneKeys, faults_in_scene}};

std::ptrdiff_t keys_known(const YAML::Node& root, const YamlKind& kind) {
  return std::count_if(root.begin(), root.end(), [&](const auto& entry) {
    return entry.first.IsScalar() &&
           std::ranges::find(kind.keys, entry.first.Scalar()) != kind.keys.end();
  });
}

Faults faults_in_yaml(const std::string& path) {
  auto text = read_text_file(path, kMostSettingsBytes);
  if (!text) return fault_of(std::move(text));
  auto root = parse_yaml(*text, path);
  if (!root) return fault_of(std::move(root));
  if (!root->IsMap()) return faults_in_config(*text, path);
  const auto* best = std::ranges::max_element(
      kYamlKinds, {}, [&](const YamlKind& kind) { return keys_known(*root, kind); });
  return best->faults(*text, path);
}

}  // namespace

Faults faults_in_file(const std::string& path) {
  auto facts = look_at_file_or_recording(path);
  if (!facts) return fault_of(std::move(facts));
  switch (facts->kind) {
    case FileKind::kMap:
      return check_map(path);
    case FileKind::kOctomap:
      return fault_if_any(read_octomap(path));
    case FileKind::kBag:
      return faults_in_bag(path);
    case FileKind::kText:
      return faults_in_yaml(path);
    case FileKind::kOther:
      break;
  }
  return {wrong_kind(path, *facts, "a map, a recording, a config, a rig or a scene")};
}

}  // namespace swiftlet::app
