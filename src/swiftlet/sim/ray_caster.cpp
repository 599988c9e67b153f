// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/ray_caster.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/sim/ray_caster_private.hpp"

namespace swiftlet::sim {
namespace {

constexpr std::size_t kLanes = 8;
constexpr float kSurfaceMargin = 1e-3F;  // see RayCaster::look()

// The two calls that changed between Embree 3 and 4.
#if RTC_VERSION_MAJOR >= 4
void intersect(const int* is_active, RTCScene scene, RTCRayHit8& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(is_active, scene, &rays, &arguments);
}
void occlude(const int* is_active, RTCScene scene, RTCRay8& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded8(is_active, scene, &rays, &arguments);
}
#else
RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}
void intersect(const int* is_active, RTCScene scene, RTCRayHit8& rays) {
  RTCIntersectContext context = coherent_context();
  rtcIntersect8(is_active, scene, &context, &rays);
}
void occlude(const int* is_active, RTCScene scene, RTCRay8& rays) {
  RTCIntersectContext context = coherent_context();
  rtcOccluded8(is_active, scene, &context, &rays);
}
#endif

/// One ray per lane, from a common origin; lanes beyond `count` sleep.
struct Active {
  alignas(32) std::array<int, kLanes> lanes;
  explicit Active(std::size_t count) {
    for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = i < count ? -1 : 0;
  }
};

void set_ray(RTCRay8& rays, std::size_t lane, const Eigen::Vector3f& origin,
             const Eigen::Vector3f& direction, float far) {
  rays.org_x[lane] = origin.x();
  rays.org_y[lane] = origin.y();
  rays.org_z[lane] = origin.z();
  rays.dir_x[lane] = direction.x();
  rays.dir_y[lane] = direction.y();
  rays.dir_z[lane] = direction.z();
  rays.tnear[lane] = 0.0F;
  rays.tfar[lane] = far;
  rays.time[lane] = 0.0F;
  rays.mask[lane] = ~0U;
  rays.id[lane] = 0;
  rays.flags[lane] = 0;
}

}  // namespace

namespace {

Status check_size(const Scene& scene) {
  std::size_t triangles = 0;
  const auto add = [&](const std::vector<Object>& objects) {
    for (const Object& object : objects) triangles += triangle_count(object);
  };
  add(scene.objects);
  for (const Mover& mover : scene.movers) add(mover.objects);
  if (triangles <= kMaxTriangles) return Done{};
  return fail(ErrorCode::kInvalidConfig, "ray caster", too_many_triangles(), kFewerTriangles);
}

}  // namespace

Expected<unsigned> RayCaster::Embree::attach(const TriangleMesh& mesh, bool moves) {
  if (!is_within_reach(mesh.vertices_m)) {
    return fail(ErrorCode::kInvalidConfig, "ray caster",
                "an object has corners that are no number or more than 2000 km away",
                "bring it nearer: rays are cast in floats");
  }
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           3 * sizeof(float), mesh.vertices_m.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), mesh.triangles.size());
  if (vertices == nullptr || triangles == nullptr) {
    rtcReleaseGeometry(geometry);
    return fail(ErrorCode::kOutOfMemory, "ray caster",
                fmt::format("no memory for {} triangles", mesh.triangles.size()));
  }
  std::ranges::copy(mesh.vertices_m, static_cast<Eigen::Vector3f*>(vertices));
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(std::uint32_t));
  rtcSetGeometryBuildQuality(geometry, moves ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  const unsigned id = rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  corners.push_back(
      {static_cast<const float*>(vertices), static_cast<const std::uint32_t*>(triangles)});
  texture_of.emplace_back();
  for (std::uint16_t material : mesh.materials)
    texture_of.back().push_back(texture_of_material[material]);
  return id;
}

RayCaster::RayCaster(std::unique_ptr<Embree> embree) : embree_(std::move(embree)) {}
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;
RayCaster::~RayCaster() = default;

Expected<RayCaster> RayCaster::create(const Scene& scene) {
  auto embree = std::make_unique<Embree>();
  // One builder thread: the scenes are small, and the mapper wants the other cores.
  embree->device.reset(rtcNewDevice("threads=1"));
  if (!embree->device)
    return fail(ErrorCode::kUnsupported, "ray caster", "Embree cannot start on this processor");
  embree->scene.reset(rtcNewScene(embree->device.get()));
  // Robust: no ray slips through the edge that two triangles share.
  const auto dynamic = scene.movers.empty() ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_DYNAMIC;
  rtcSetSceneFlags(embree->scene.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | dynamic));
  for (const Material& material : scene.materials)
    embree->texture_of_material.push_back(static_cast<float>(material.texture));

  if (auto sane = check_size(scene); !sane) return forward_error(std::move(sane));
  TriangleMesh still;
  for (const Object& object : scene.objects) append_triangles(object, still);
  if (auto id = embree->attach(still, false); !id) return forward_error(std::move(id));
  for (const Mover& mover : scene.movers) {
    TriangleMesh mesh;
    for (const Object& object : mover.objects) append_triangles(object, mesh);
    auto id = embree->attach(mesh, true);
    if (!id) return forward_error(std::move(id));
    RTCGeometry geometry = rtcGetGeometry(embree->scene.get(), *id);
    auto* vertices =
        static_cast<float*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
    embree->movers.push_back({mover.path, std::move(mesh), geometry, vertices});
  }
  rtcCommitScene(embree->scene.get());
  RayCaster caster(std::move(embree));
  caster.move_to(Nanoseconds(0));
  return caster;
}

void RayCaster::move_to(Nanoseconds since_start) {
  if (embree_->movers.empty()) return;
  for (auto& mover : embree_->movers) {
    const auto T_world_mover = mover.path.at(since_start);
    float* out = mover.vertices;
    for (const Eigen::Vector3f& p_mover : mover.at_origin.vertices_m) {
      const Eigen::Vector3f p_world = (T_world_mover * p_mover.cast<double>()).cast<float>();
      out = std::copy_n(p_world.data(), 3, out);
    }
    rtcUpdateGeometryBuffer(mover.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(mover.geometry);
  }
  rtcCommitScene(embree_->scene.get());
}

void RayCaster::cast(const Eigen::Vector3f& origin_m, std::span<const Eigen::Vector3f> directions,
                     std::span<Hit> hits) const {
  SWIFTLET_REQUIRE(hits.size() == directions.size(), "one hit per ray");
  if (!is_within_reach({&origin_m, 1})) {  // Embree's assertions would end the program
    std::ranges::fill(hits, Hit{});
    return;
  }
  for (std::size_t first = 0; first < directions.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, directions.size() - first);
    const Active active(count);
    RTCRayHit8 packet;
    for (std::size_t i = 0; i < kLanes; ++i) {
      set_ray(packet.ray, i, origin_m, directions[first + std::min(i, count - 1)],
              std::numeric_limits<float>::infinity());
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(active.lanes.data(), embree_->scene.get(), packet);
    for (std::size_t i = 0; i < count; ++i) {
      Hit& hit = hits[first + i];
      hit = Hit{};
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      const Eigen::Vector3f normal(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
      const Eigen::Vector3f& direction = directions[first + i];
      hit.distance = packet.ray.tfar[i];
      hit.cos_incidence = std::abs(normal.dot(direction)) /
                          std::sqrt(normal.squaredNorm() * direction.squaredNorm());
      hit.texture = embree_->texture_of[packet.hit.geomID[i]][packet.hit.primID[i]];
    }
  }
}

void RayCaster::look(const Eigen::Vector3f& eye_m, std::span<const Eigen::Vector3f> points_m,
                     std::span<std::uint8_t> is_seen) const {
  SWIFTLET_REQUIRE(is_seen.size() == points_m.size(), "one answer per point");
  if (!is_within_reach({&eye_m, 1})) {
    std::ranges::fill(is_seen, std::uint8_t{0});
    return;
  }
  for (std::size_t first = 0; first < points_m.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, points_m.size() - first);
    const Active active(count);
    RTCRay8 packet;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Eigen::Vector3f to_point = points_m[first + std::min(i, count - 1)] - eye_m;
      set_ray(packet, i, eye_m, to_point, 1.0F - kSurfaceMargin);
    }
    occlude(active.lanes.data(), embree_->scene.get(), packet);
    // Embree marks a blocked ray with tfar = -infinity.
    for (std::size_t i = 0; i < count; ++i) is_seen[first + i] = packet.tfar[i] >= 0.0F ? 1 : 0;
  }
}

}  // namespace swiftlet::sim
