// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/scene_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "swiftlet/file/file_content.hpp"
#include "swiftlet/file/yaml_document_private.hpp"
#include "swiftlet/sim/built_in_scenes.hpp"
#include "swiftlet/sim/scene_sections_private.hpp"

namespace swiftlet::sim {
namespace {

std::vector<std::string_view> built_in_names() {
  std::vector<std::string_view> names;
  for (const auto& scene : built_in_scenes()) names.push_back(scene.name);
  return names;
}

Expected<std::string> read_text(const std::filesystem::path& path) {
  auto text = read_text_file(path, kMostSettingsBytes);
  if (!text && text.error().code == ErrorCode::kNotFound)
    text.error().remedy = fmt::format("built in are: {}", fmt::join(built_in_names(), ", "));
  return text;
}

Scene read_scene(const YAML::Node& root, YamlProblem& problem) {
  YamlSection section(root, "the scene", problem);
  Scene scene;
  scene.about = section.text("about", "");
  scene.seed = static_cast<std::uint64_t>(section.number("seed", {0.0, 9e15}, 1.0));
  read_camera(section, scene.camera);
  read_mount(section, scene.T_body_camera);
  read_tracker(section, scene.tracker);
  read_materials(section, scene.materials);
  ObjectReader objects{scene.materials, std::filesystem::path(problem.file).parent_path().string()};
  scene.objects = objects.read(section);
  for (YamlSection& mover : section.list("movers")) {
    Mover moving{mover.text("name", "mover"), objects.read(mover), read_flight(mover, "path")};
    scene.movers.push_back(std::move(moving));
    mover.finish();
  }
  scene.flight = read_flight(section, "flight");
  if (scene.objects.empty()) section.problem("the scene has no objects");
  section.finish();
  return scene;
}

}  // namespace

Expected<Scene> parse_scene(std::string_view yaml, std::string_view origin) {
  YamlProblem problem{std::string(origin), std::nullopt};
  auto root = parse_yaml(yaml, problem.file);
  if (!root) return forward_error(std::move(root));
  // yaml-cpp reports by exception; none passes this function.
  try {
    Scene scene = read_scene(*root, problem);
    scene.name = std::filesystem::path(origin).stem().string();
    if (!problem.first) return scene;
  } catch (const YAML::Exception& error) {
    problem.add(error.mark, fmt::format("not YAML: {}", error.msg));
  }
  return tl::make_unexpected(*problem.first);
}

Expected<Scene> load_scene(std::string_view name_or_path) {
  const bool is_path = name_or_path.find('/') != std::string_view::npos ||
                       name_or_path.ends_with(".yaml") || name_or_path.ends_with(".yml");
  if (is_path) {
    auto text = read_text(name_or_path);
    if (!text) return forward_error(std::move(text));
    return parse_scene(*text, name_or_path);
  }
  const auto scenes = built_in_scenes();
  const auto found = std::ranges::find(scenes, name_or_path, &BuiltInScene::name);
  if (found == scenes.end()) {
    return fail(ErrorCode::kNotFound, {},
                fmt::format("no built-in scene is called '{}'", name_or_path),
                fmt::format("there are: {}; or give the path of a .yaml file",
                            fmt::join(built_in_names(), ", ")));
  }
  return parse_scene(found->yaml, fmt::format("{}.yaml", found->name));
}

}  // namespace swiftlet::sim
