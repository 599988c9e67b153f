// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/base/progress.hpp"
#include "swiftlet/eval/thesis/experiment.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet::eval {

/// The defaults, but for the thesis's measurement model.
[[nodiscard]] MapperConfig thesis_config();

/// Maps the first `frames` frames of a source. Errors: those of the source and of Mapper::create().
[[nodiscard]] Expected<Mapper> map_of(const std::string& address, const MapperConfig& config,
                                      std::size_t frames, const ProgressFunction& progress);

/// The voxels of a map in the layer of height z, between two corners, as a figure.
struct Layer {
  VoxelIndex first, last;
};
[[nodiscard]] Figure layer_figure(const Mapper& mapper, const Layer& layer, std::string name,
                                  std::string title);

}  // namespace swiftlet::eval
