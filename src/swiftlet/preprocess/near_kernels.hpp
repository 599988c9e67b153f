// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>

namespace swiftlet {

// The nearest reading of each column of a band of rows, on the widest vectors of this machine.
// Arrays are as long as the row.

/// Adds row `number` of the band: to the smallest reading less 1 of each column (one less than 0,
/// no reading, is the largest number there is), to the first row that holds it, and to the number
/// of readings.
void add_row_of_readings(std::span<const std::uint16_t> raw, std::uint16_t number,
                         std::uint16_t* nearest_less_1, std::uint16_t* row, std::uint16_t* valid);

/// Adds to the number of readings that are no farther than a limit of each column.
void add_row_of_support(std::span<const std::uint16_t> raw, const std::uint16_t* limit,
                        std::uint16_t* support);

}  // namespace swiftlet
