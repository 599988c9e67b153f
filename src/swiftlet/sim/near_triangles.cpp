// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/sim/ray_caster_private.hpp"

namespace swiftlet::sim {
namespace {

/// What a query carries through Embree.
struct Search {
  const std::vector<CornerBuffers>* corners;
  const RayCaster::LookAt* look;
};

bool visit(RTCPointQueryFunctionArguments* args) {
  const auto& search = *static_cast<const Search*>(args->userPtr);
  const CornerBuffers& geometry = (*search.corners)[args->geomID];
  Triangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = geometry.triangles[std::size_t{3} * args->primID + i];
    triangle[i] = Eigen::Map<const Eigen::Vector3f>(geometry.vertices + std::size_t{3} * vertex);
  }
  const float radius_m = (*search.look)(triangle);
  if (!(radius_m < args->query->radius)) return false;
  args->query->radius = std::max(radius_m, 0.0F);
  return true;
}

}  // namespace

void RayCaster::search_near(const Eigen::Vector3f& point_m, float radius_m,
                            const LookAt& look) const {
  if (!is_within_reach({&point_m, 1})) return;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{};
  query.x = point_m.x();
  query.y = point_m.y();
  query.z = point_m.z();
  query.radius = radius_m;
  Search search{&embree_->corners, &look};
  rtcPointQuery(embree_->scene.get(), &query, &context, &visit, &search);
}

}  // namespace swiftlet::sim
