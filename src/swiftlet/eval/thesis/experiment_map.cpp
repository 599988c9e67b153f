// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/thesis/experiment_map.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/base/progress.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::eval {

MapperConfig thesis_config() {
  MapperConfig config;
  config.integrate.model = kThesisModel;
  return config;
}

Expected<Mapper> map_of(const std::string& address, const MapperConfig& config, std::size_t frames,
                        const ProgressFunction& progress) {
  auto source = open_source(address);
  if (!source) return forward_error(std::move(source));
  auto mapper = Mapper::create(config);
  if (!mapper) return mapper;
  const ProgressTeller shown(progress,
                             std::min(frames, (*source)->info().frame_count.value_or(frames)));
  while (mapper->frame_count() < frames) {
    auto frame = (*source)->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    mapper->integrate(**frame);
    shown.update(static_cast<std::size_t>(mapper->frame_count()));
  }
  return mapper;
}

Figure layer_figure(const Mapper& mapper, const Layer& layer, std::string name, std::string title) {
  const double c = mapper.map().voxel_m();
  const Eigen::Vector3d first = centre_of(layer.first, c);
  Figure figure{std::move(name), std::move(title), "x [m]", "y [m]"};
  figure.x0 = first.x();
  figure.y0 = first.y();
  figure.voxel = c;
  for (std::int32_t y = layer.first.y; y <= layer.last.y; ++y) {
    std::vector<double>& row = figure.voxels.emplace_back();
    for (std::int32_t x = layer.first.x; x <= layer.last.x; ++x)
      row.push_back(mapper.map().log_odds({x, y, layer.first.z}));
  }
  return figure;
}

}  // namespace swiftlet::eval
