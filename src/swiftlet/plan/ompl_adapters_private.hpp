// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "swiftlet/plan/motion_check.hpp"

namespace swiftlet::ompl_adapters {

/// A place as OMPL holds it, in a RealVectorStateSpace of three dimensions. [m, world]
[[nodiscard]] inline Eigen::Vector3d place_of(const ompl::base::State* state) {
  return Eigen::Map<const Eigen::Vector3d>(
      state->as<ompl::base::RealVectorStateSpace::StateType>()->values);
}

/// May the body be there? The clearance is a lower bound.
class StateValidity final : public ompl::base::StateValidityChecker {
 public:
  StateValidity(const ompl::base::SpaceInformationPtr& space, const MotionCheck& check)
      : StateValidityChecker(space), check_(check) {
    specs_.clearanceComputationType = ompl::base::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE;
  }
  [[nodiscard]] bool isValid(const ompl::base::State* state) const override {
    return check_.is_clear(place_of(state));
  }
  [[nodiscard]] double clearance(const ompl::base::State* state) const override {
    return std::max(0.0, check_.room_m(place_of(state)));
  }

 private:
  const MotionCheck& check_;
};

/// May the body move there? Swept, not sampled: nothing thin lies between two samples.
class MotionValidity final : public ompl::base::MotionValidator {
 public:
  MotionValidity(const ompl::base::SpaceInformationPtr& space, const MotionCheck& check)
      : MotionValidator(space), check_(check) {}

  [[nodiscard]] bool checkMotion(const ompl::base::State* from,
                                 const ompl::base::State* to) const override {
    const bool is_clear = check_.is_clear(place_of(from), place_of(to));
    ++(is_clear ? valid_ : invalid_);
    return is_clear;
  }
  [[nodiscard]] bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                                 std::pair<ompl::base::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    last.second = 0.0;  // the start is clear for certain
    if (last.first != nullptr) si_->copyState(last.first, from);
    return false;
  }

 private:
  const MotionCheck& check_;
};

/// Length, and more where there is less room than is comfortable: up to five times at an obstacle.
class ClearanceObjective final : public ompl::base::StateCostIntegralObjective {
 public:
  ClearanceObjective(const ompl::base::SpaceInformationPtr& space, const MotionCheck& check,
                     double comfort_m)
      : StateCostIntegralObjective(space, true), check_(check), comfort_m_(comfort_m) {}

  [[nodiscard]] ompl::base::Cost stateCost(const ompl::base::State* state) const override {
    const double lack_m = comfort_m_ - check_.room_m(place_of(state));
    if (lack_m <= 0.0) return ompl::base::Cost(1.0);
    const double share = std::min(1.0, lack_m / comfort_m_);
    return ompl::base::Cost(1.0 + kMost * share * share);
  }
  [[nodiscard]] ompl::base::Cost motionCostHeuristic(const ompl::base::State* from,
                                                     const ompl::base::State* to) const override {
    return ompl::base::Cost((place_of(to) - place_of(from)).norm());
  }

 private:
  static constexpr double kMost = 4.0;
  const MotionCheck& check_;
  double comfort_m_;
};

/// Random places by a seed of its own, as OMPL's seed is one for the whole process: half of them
/// anywhere, half around a way that is known from a search on the grid, if there is one. Doors that
/// a sampler of the whole window misses are met so.
class SeededSampler final : public ompl::base::RealVectorStateSampler {
 public:
  /// Looks at `guide`, which must stay: places along the way [m, world].
  SeededSampler(const ompl::base::StateSpace* space, std::uint64_t seed,
                std::span<const Eigen::Vector3d> guide)
      : RealVectorStateSampler(space), guide_(guide) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed));
  }
  void sampleUniform(ompl::base::State* state) override {
    if (guide_.empty() || rng_.uniformBool()) return RealVectorStateSampler::sampleUniform(state);
    const auto last = static_cast<int>(guide_.size()) - 1;
    const Eigen::Vector3d& near = guide_[static_cast<std::size_t>(rng_.uniformInt(0, last))];
    auto* values = state->as<ompl::base::RealVectorStateSpace::StateType>()->values;
    for (int axis = 0; axis < 3; ++axis) values[axis] = rng_.gaussian(near[axis], kAround_m);
    space_->enforceBounds(state);
  }

 private:
  static constexpr double kAround_m = 0.05;
  std::span<const Eigen::Vector3d> guide_;
};

/// A planner of OMPL with a seed of its own.
template <class Planner>
class Seeded final : public Planner {
 public:
  Seeded(const ompl::base::SpaceInformationPtr& space, std::uint64_t seed) : Planner(space) {
    this->rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed));
  }
};

}  // namespace swiftlet::ompl_adapters
