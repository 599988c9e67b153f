// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/mapper_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/integrate/rays/ray_method.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {
namespace {

bool is_within(const ConfigField& field, double value) {
  return value >= field.min && value <= field.max;  // false for NaN, too
}

void refuse(std::vector<Error>& faults, const ConfigField& field, const std::string& value) {
  faults.push_back({ErrorCode::kInvalidConfig, std::string(field.key), value + " cannot be used",
                    fmt::format("choose a value from {} to {}", field.min, field.max)});
}

void check(std::vector<Error>& faults, const ConfigField& field, double value) {
  if (!is_within(field, value)) refuse(faults, field, fmt::format("{}", value));
}

void check(std::vector<Error>& faults, const ConfigField& field, const Eigen::Vector3d& value) {
  if (is_within(field, value.x()) && is_within(field, value.y()) && is_within(field, value.z()))
    return;
  refuse(faults, field, fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z()));
}

void check(std::vector<Error>& faults, const ConfigField& field, NewWorldRule value) {
  if (static_cast<std::size_t>(value) < kNewWorldRuleNames.size()) return;
  faults.push_back(
      {ErrorCode::kInvalidConfig, std::string(field.key), "is no rule", "choose a NewWorldRule"});
}

void check(std::vector<Error>&, const ConfigField&, const std::string&) {}
void check(std::vector<Error>&, const ConfigField&, const std::vector<std::string>&) {}

template <class T>
void keep_fault(std::vector<Error>& faults, std::string_view key, Expected<T>&& result) {
  if (result) return;
  faults.push_back(std::move(result).error());
  if (faults.back().where.empty()) faults.back().where = key;
  faults.back().code = ErrorCode::kInvalidConfig;
}

}  // namespace

PreprocessOptions MapperConfig::preprocessing() const {
  PreprocessOptions options = depth;
  const auto model = find_measurement_model(integrate.model);
  if (!model || model->depth_step.empty()) return options;
  const auto gate = std::ranges::find(options.steps, "range_gate");
  const auto behind = gate == options.steps.end() ? options.steps.begin() : gate + 1;
  options.steps.insert(behind, std::string(model->depth_step));
  return options;
}

std::vector<Error> MapperConfig::faults() const {
  std::vector<Error> faults;
  visit_config(*this,
               [&](const ConfigField& field, const auto& value) { check(faults, field, value); });
  if (depth.min_range_m >= depth.max_range_m) {  // NaN is told above
    faults.push_back(
        {ErrorCode::kInvalidConfig, "depth.min_range_m", "is not below depth.max_range_m", {}});
  }
  keep_fault(faults, "depth.steps", Preprocessor::create(depth));
  keep_fault(faults, "integrate.integrator",
             find_registered(integrators(), integrate.integrator, "integrator"));
  keep_fault(faults, "integrate.model", find_measurement_model(integrate.model));
  keep_fault(faults, "integrate.ray_method", find_ray_method(integrate.ray_method));
  const bool is_straightened = std::ranges::find(depth.steps, "distortion") != depth.steps.end();
  if (faults.empty() && !depth.distortion.is_none() && !is_straightened) {
    faults.push_back({ErrorCode::kInvalidConfig, "depth.steps",
                      "the step 'distortion' is missing, so the numbers of distortion do nothing",
                      "put it first, or leave depth.steps out"});
  }
  if (faults.empty()) keep_fault(faults, "map", RollingMap::create(map));
  if (faults.empty() && (2.0 * map.trigger_m.array() > map.size_m.array()).any()) {
    faults.push_back({ErrorCode::kInvalidConfig, "map.trigger_m",
                      "the region in which the window rests is larger than the window: the vehicle "
                      "would leave it",
                      "choose at most half of map.size_m along each axis"});
  }
  return faults;
}

}  // namespace swiftlet
