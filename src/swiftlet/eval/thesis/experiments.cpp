// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <array>

#include "swiftlet/eval/thesis/experiment.hpp"

// An experiment is one file, which ends in run_<name>(), and one line here.
#define SWIFTLET_EXPERIMENTS(X)                                                                 \
  X(large_box, "a box of 47 cm, 2 m ahead: two voxels wide, the wall behind hidden (fig. 4.6)") \
  X(small_box, "a box of 25 cm, 2 m ahead: two voxels wide, the wall partly seen (fig. 4.9)")   \
  X(aisle, "a narrow aisle with n = 1, 4, 8, 16: far voxels drop out as n grows")               \
  X(apartment, "a hand-held scan of a flat against its floor plan")                             \
  X(noise, "RMS error on a wall against distance: theory and test (figs. 3.5 to 3.9)")          \
  X(sensor_model, "the inverse sensor model at several distances (chapter 3)")                  \
  X(times, "function and mapping times on this machine (tables 4.2 and 4.3)")

namespace swiftlet::eval {

#define SWIFTLET_DECLARE(name, summary) \
  Expected<ExperimentResult> run_##name(const ProgressFunction& progress);
SWIFTLET_EXPERIMENTS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<RunExperiment>> experiments() {
#define SWIFTLET_LINE(name, summary) Registered<RunExperiment>{#name, summary, run_##name},
  static constexpr std::array kExperiments{SWIFTLET_EXPERIMENTS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kExperiments;
}

bool ExperimentResult::is_passed() const { return std::ranges::all_of(checks, &Check::is_passed); }

}  // namespace swiftlet::eval
