// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/path_search_private.hpp"

#if SWIFTLET_HAS_OMPL

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include <exception>
#include <memory>
#include <mutex>

#include "swiftlet/plan/ompl_adapters_private.hpp"

namespace swiftlet {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using namespace ompl_adapters;

constexpr double kLongestLeg_m = 3.0;  // of the trees

/// OMPL tells the terminal how it gets on, unless it is asked not to, which holds for the process:
/// its level comes back when the last of ours has ended.
class QuietOmpl {
 public:
  QuietOmpl() {
    const std::lock_guard lock(mutex());
    if (count()++ == 0) level() = ompl::msg::getLogLevel();
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  }
  ~QuietOmpl() {
    const std::lock_guard lock(mutex());
    if (--count() == 0) ompl::msg::setLogLevel(level());
  }
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static int& count() {
    static int of_searches = 0;
    return of_searches;
  }
  static ompl::msg::LogLevel& level() {
    static ompl::msg::LogLevel of_user = ompl::msg::LOG_DEBUG;
    return of_user;
  }
};

std::shared_ptr<ob::RealVectorStateSpace> space_of(const PathQuestion& question) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    bounds.setLow(axis, question.bounds.low[axis]);
    bounds.setHigh(axis, question.bounds.high[axis]);
  }
  space->setBounds(bounds);
  space->setStateSamplerAllocator([&question](const ob::StateSpace* of) {
    return std::make_shared<SeededSampler>(of, question.options.seed, question.guide);
  });
  // How finely the clearance objective looks at a leg.
  space->setLongestValidSegmentFraction(question.check.map().voxel_m() / space->getMaximumExtent());
  return space;
}

ob::PlannerPtr planner_of(const PathQuestion& question, const ob::SpaceInformationPtr& space) {
  // Neighbours are looked for one by one: OMPL's tree of them draws from the process's seed.
  if (question.options.search == PathSearch::kFirst) {
    auto planner = std::make_shared<Seeded<og::RRTConnect>>(space, question.options.seed);
    planner->setRange(kLongestLeg_m);
    planner->setNearestNeighbors<ompl::NearestNeighborsLinear>();
    return planner;
  }
  auto planner = std::make_shared<Seeded<og::RRTstar>>(space, question.options.seed);
  planner->setRange(kLongestLeg_m);
  planner->setNearestNeighbors<ompl::NearestNeighborsLinear>();
  return planner;
}

std::vector<Eigen::Vector3d> run(const PathQuestion& question) {
  const auto states = space_of(question);
  const auto space = std::make_shared<ob::SpaceInformation>(states);
  space->setStateValidityChecker(std::make_shared<StateValidity>(space, question.check));
  space->setMotionValidator(std::make_shared<MotionValidity>(space, question.check));
  space->setup();
  const auto problem = std::make_shared<ob::ProblemDefinition>(space);
  ob::ScopedState<ob::RealVectorStateSpace> from(states), to(states);
  for (unsigned axis = 0; axis < 3; ++axis) {
    from[axis] = question.from[axis];
    to[axis] = question.to[axis];
  }
  problem->setStartAndGoalStates(from, to);
  problem->setOptimizationObjective(std::make_shared<ClearanceObjective>(
      space, question.check, std::max(question.options.comfort_m, 1e-6)));
  const ob::PlannerPtr planner = planner_of(question, space);
  planner->setProblemDefinition(problem);
  planner->setup();
  ob::IterationTerminationCondition enough(
      static_cast<unsigned>(std::max(1, question.options.max_iterations)));
  std::vector<Eigen::Vector3d> corners;
  if (planner->solve(enough) != ob::PlannerStatus::EXACT_SOLUTION) return corners;
  auto* found = problem->getSolutionPath()->as<og::PathGeometric>();
  for (const ob::State* state : found->getStates()) corners.push_back(place_of(state));
  return corners;
}

}  // namespace

Expected<std::vector<Eigen::Vector3d>> search_path(const PathQuestion& question) {
  const QuietOmpl quiet;
  try {
    return run(question);
  } catch (const std::exception& refused) {
    return fail(ErrorCode::kUnsupported, "OMPL", refused.what());
  }
}

}  // namespace swiftlet

#else

namespace swiftlet {

Expected<std::vector<Eigen::Vector3d>> search_path(const PathQuestion& /*question*/) {
  return fail(ErrorCode::kUnsupported, "plan", "this build has no planner, as OMPL was not found",
              "install libompl-dev and configure with -DSWIFTLET_WITH_OMPL=ON");
}

}  // namespace swiftlet

#endif
