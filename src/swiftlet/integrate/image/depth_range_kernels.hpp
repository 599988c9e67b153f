// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "swiftlet/base/image.hpp"
#include "swiftlet/integrate/image/depth_range_pyramid.hpp"

namespace swiftlet {

/// Fills one row of the finest tiles of a depth pyramid; returns the number of readings in it. Runs
/// on the widest vectors of this machine.
std::size_t find_tile_row_ranges(const Image<std::uint16_t>& raw, int tile_row,
                                 std::int32_t* tiles);

}  // namespace swiftlet
