// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>

#include "swiftlet/integrate/integrator.hpp"

// An integrator is one file, which ends in make_<name>(), and one line here.
#define SWIFTLET_INTEGRATORS(X)                                              \
  X(rays, "traces every reading through the grid with integrate.ray_method") \
  X(projective, "looks up the readings in the image of every voxel; the same sum, much faster")

namespace swiftlet {

#define SWIFTLET_DECLARE(name, summary) \
  Expected<std::unique_ptr<Integrator>> make_##name(const IntegrateOptions& options);
SWIFTLET_INTEGRATORS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<MakeIntegrator>> integrators() {
#define SWIFTLET_LINE(name, summary) Registered<MakeIntegrator>{#name, summary, make_##name},
  static constexpr std::array kIntegrators{SWIFTLET_INTEGRATORS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kIntegrators;
}

Expected<std::unique_ptr<Integrator>> make_integrator(const IntegrateOptions& options) {
  auto found = find_registered(integrators(), options.integrator, "integrator");
  if (!found) return forward_error(std::move(found));
  return found->make(options);
}

}  // namespace swiftlet
