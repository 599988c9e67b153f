// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/config/config_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "swiftlet/base/nearest_name.hpp"
#include "swiftlet/config/config_aliases.hpp"
#include "swiftlet/config/config_value_private.hpp"
#include "swiftlet/file/file_content.hpp"
#include "swiftlet/file/yaml_document_private.hpp"

namespace swiftlet {
namespace {

/// One parameter as the user wrote it.
struct Setting {
  std::string key;
  YAML::Node value;
  std::string place;  ///< "flight.yaml:3" or "--set"
  int layer = 0;      ///< files and --set in the order in which they win: later over earlier
};
using Settings = std::vector<Setting>;

std::vector<std::string> known_keys() {
  std::vector<std::string> keys;
  const MapperConfig defaults;
  visit_config(defaults,
               [&](const ConfigField& field, const auto&) { keys.emplace_back(field.key); });
  return keys;
}

Error invalid(std::string where, std::string what, std::string remedy) {
  return {ErrorCode::kInvalidConfig, std::move(where), std::move(what), std::move(remedy)};
}

/// Groups of keys become dotted keys: {map: {voxel_m: 0.1}} is map.voxel_m = 0.1.
void flatten(const YAML::Node& group, const std::string& prefix, const std::string& place,
             Settings& settings) {
  for (const auto& entry : group) {
    const std::string key = prefix + (entry.first.IsScalar() ? entry.first.Scalar() : "?");
    if (entry.second.IsMap()) {
      flatten(entry.second, key + ".", place, settings);
    } else if (!(entry.second.IsNull() && prefix.empty())) {  // "map:" with nothing below is fine
      const int line = entry.first.Mark().line + 1;
      settings.push_back({key, entry.second, fmt::format("{}:{}", place, line)});
    }
  }
}

tl::expected<Settings, Faults> settings_of(const std::string& yaml, const std::string& place) {
  Settings settings;
  auto root = parse_yaml(yaml, place);
  if (!root) return tl::make_unexpected(fault_of(std::move(root)));
  if (root->IsMap()) {
    flatten(*root, "", place, settings);
  } else if (root->IsDefined() && !root->IsNull()) {
    return tl::make_unexpected(Faults{
        invalid(place, "the file does not hold 'key: value' lines",
                "write groups of parameters; 'swiftlet list parameters' tells which there are")});
  }
  return settings;
}

/// "map.voxel_m=0.1" as given with --set.
tl::expected<Settings, Faults> settings_of_option(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    return tl::make_unexpected(
        Faults{invalid("--set " + text, "there is no '='", "write --set key=value")});
  }
  auto value = parse_yaml(text.substr(equals + 1), "--set " + text);
  if (!value) return tl::make_unexpected(fault_of(std::move(value)));
  return Settings{{text.substr(0, equals), *value, "--set"}};
}

Error unknown_key(const Setting& setting) {
  const auto meant = nearest_name(setting.key, known_keys());
  return invalid(setting.place, fmt::format("there is no parameter '{}'", setting.key),
                 meant ? fmt::format("did you mean {}", *meant)
                       : "'swiftlet list parameters' tells which there are");
}

/// The setting by the names of today.
Setting renamed(Setting setting, Faults& warnings) {
  const auto rename = [&](const std::string& before, std::string_view now) {
    if (before == now) return false;
    warnings.push_back(renamed_warning(setting.place, before, now));
    return true;
  };
  const std::string_view key = current_key(setting.key);
  if (rename(setting.key, key)) setting.key = key;
  if (!setting.value.IsScalar()) return setting;
  const std::string value = setting.value.Scalar();
  const std::string_view now = current_value(setting.key, value);
  if (rename(value, now)) setting.value = YAML::Node(std::string(now));
  return setting;
}

void apply(const Setting& setting, LoadedConfig& config, Faults& faults) {
  bool is_known = false;
  visit_config(config.mapper, [&](const ConfigField& field, auto& member) {
    if (field.key != setting.key) return;
    is_known = true;
    auto read = read_value(field.key, setting.value, member);
    if (read) return;
    Error fault = std::move(read).error();
    fault.where = fmt::format("{}: {}", setting.place, setting.key);
    faults.push_back(std::move(fault));
  });
  if (!is_known) faults.push_back(unknown_key(setting));
  config.places[setting.key] = setting.place;
}

/// A fault names its key; adds the line where the user wrote it.
void add_place(Error& fault, const LoadedConfig& config) {
  const auto found = config.places.find(fault.where);
  if (found == config.places.end()) return;
  fault.where = fmt::format("{}: {}", found->second, found->first);
}

tl::expected<LoadedConfig, Faults> checked(const Settings& settings) {
  LoadedConfig config;
  Faults faults;
  std::map<std::string, int> layers;  // that gave each key last
  for (const Setting& given : settings) {
    const Setting setting = renamed(given, config.warnings);
    const auto [earlier, is_first] = layers.try_emplace(setting.key, setting.layer);
    if (!is_first && earlier->second == setting.layer && setting.place != "--set") {
      faults.push_back(
          invalid(setting.place, fmt::format("'{}' stands here again", setting.key),
                  fmt::format("it was given at {}: keep one", config.places.at(setting.key))));
    }
    earlier->second = setting.layer;
    apply(setting, config, faults);
  }
  if (!faults.empty()) return tl::make_unexpected(std::move(faults));
  faults = config.mapper.faults();
  if (faults.empty()) return config;
  for (Error& fault : faults) add_place(fault, config);
  return tl::make_unexpected(std::move(faults));
}

}  // namespace

Error renamed_warning(const std::string& place, std::string_view before, std::string_view now) {
  return invalid(place, fmt::format("'{}' is called '{}' now", before, now),
                 fmt::format("write '{}': the next version does not know the old name", now));
}

tl::expected<LoadedConfig, Faults> load_config(const ConfigInput& input) {
  Settings settings;
  int layer = 0;
  const auto append = [&](Settings&& more) {
    for (Setting& setting : more) setting.layer = layer;
    ++layer;
    settings.insert(settings.end(), more.begin(), more.end());
  };
  for (const std::string& file : input.files) {
    auto text = read_text_file(file, kMostSettingsBytes);
    if (!text) return tl::make_unexpected(fault_of(std::move(text)));
    auto from_file = settings_of(*text, file);
    if (!from_file) return tl::make_unexpected(std::move(from_file).error());
    append(std::move(*from_file));
  }
  for (const std::string& option : input.settings) {
    auto from_option = settings_of_option(option);
    if (!from_option) return tl::make_unexpected(std::move(from_option).error());
    append(std::move(*from_option));
  }
  return checked(settings);
}

tl::expected<LoadedConfig, Faults> parse_config(const std::string& yaml, const std::string& place) {
  auto settings = settings_of(yaml, place);
  if (!settings) return tl::make_unexpected(std::move(settings).error());
  return checked(*settings);
}

void adopt_baseline(const std::optional<double>& baseline_m, LoadedConfig& config) {
  const bool is_given = config.places.contains("sensor.baseline_m");
  if (baseline_m && !is_given) config.mapper.sensor.baseline_m = *baseline_m;
}

std::string config_to_yaml(const MapperConfig& config) {
  std::string yaml;
  std::string group;
  visit_config(config, [&](const ConfigField& field, const auto& value) {
    const auto dot = field.key.find('.');
    if (field.key.substr(0, dot) != group) {
      group = field.key.substr(0, dot);
      yaml += group + ":\n";
    }
    yaml += fmt::format("  {}: {}\n", field.key.substr(dot + 1), value_text(value));
  });
  return yaml;
}

}  // namespace swiftlet
