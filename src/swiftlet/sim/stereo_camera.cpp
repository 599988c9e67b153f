// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/stereo_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "swiftlet/sim/counter_random.hpp"

namespace swiftlet::sim {
namespace {

// Which of a pixel's random numbers is for what.
enum class Draw : std::uint64_t { kPatchOrPixel, kPixel, kPatch, kMixes, kMixture, kNoise };

std::uint64_t counter(Draw draw, int u, int v) {
  return (static_cast<std::uint64_t>(draw) << 32) | (static_cast<std::uint64_t>(v) << 16) |
         static_cast<std::uint64_t>(u);
}

/// How likely the matcher fails on a surface, from how blank it is and how steeply it is seen.
/// Below half texture the laser's dots carry the match less and less; beyond 80 degrees of
/// incidence the two imagers see too different patterns.
float drop_out_chance(const Hit& hit) {
  constexpr float kEnoughTexture = 0.5F;
  constexpr float kSteep = 0.17F;    // cos 80 deg
  constexpr float kGrazing = 0.05F;  // cos 87 deg
  const float blank = std::clamp(1.0F - hit.texture / kEnoughTexture, 0.0F, 1.0F);
  const float grazing = std::clamp((kSteep - hit.cos_incidence) / (kSteep - kGrazing), 0.0F, 1.0F);
  return 1.0F - (1.0F - blank * blank) * (1.0F - grazing);
}

/// Runs work(row, thread) for all rows on a few threads.
template <class Work>
void for_each_row(int rows, unsigned threads, const Work& work) {
  const auto run = [&](unsigned thread) {
    for (int v = static_cast<int>(thread); v < rows; v += static_cast<int>(threads))
      work(v, thread);
  };
  std::vector<std::jthread> others;
  for (unsigned thread = 1; thread < threads; ++thread) others.emplace_back(run, thread);
  run(0);
}

}  // namespace

/// Origins of the two imagers and the ray of pixel (u, v): z_camera = 1, so that hit distances are
/// depths.
struct StereoCamera::View {
  Eigen::Vector3f left_m, right_m;
  Eigen::Vector3d ray_at_origin, ray_per_u, ray_per_v;
  std::uint64_t frame_number;

  View(const Transform<World, Camera>& T_world_camera, const PinholeIntrinsics& k,
       double baseline_m, std::uint64_t frame)
      : frame_number(frame) {
    const Eigen::Matrix3d R = T_world_camera.rotation().toRotationMatrix();
    left_m = T_world_camera.translation().cast<float>();
    right_m = (T_world_camera * Eigen::Vector3d(baseline_m, 0, 0)).cast<float>();
    ray_at_origin = R * k.back_project(0, 0, 1.0);
    ray_per_u = R.col(0) / k.fx();
    ray_per_v = R.col(1) / k.fy();
  }
  [[nodiscard]] Eigen::Vector3f ray(int u, int v) const {
    return (ray_at_origin + u * ray_per_u + v * ray_per_v).cast<float>();
  }
};

Expected<StereoCamera> StereoCamera::create(const StereoOptions& options, std::uint64_t seed,
                                            unsigned threads) {
  auto intrinsics =
      PinholeIntrinsics::from_field_of_view(options.width, options.height, options.hfov_rad);
  if (!intrinsics) return forward_error(std::move(intrinsics));
  return StereoCamera(options, *intrinsics, seed, std::max(threads, 1U));
}

StereoCamera::StereoCamera(const StereoOptions& options, const PinholeIntrinsics& intrinsics,
                           std::uint64_t seed, unsigned threads)
    : options_(options),
      intrinsics_(intrinsics),
      seed_(seed),
      threads_(threads),
      disparity_px_(options.width, options.height),
      is_matched_(options.width, options.height),
      buffers_(threads) {
  const auto width = static_cast<std::size_t>(options.width);
  for (RowBuffers& row : buffers_) {
    row.rays.resize(width);
    row.points.resize(width);
    row.hits.resize(width);
    row.is_seen.resize(width);
  }
}

DepthImage StereoCamera::capture(const RayCaster& world,
                                 const Transform<World, Camera>& T_world_camera,
                                 std::uint64_t frame_number) {
  const View view(T_world_camera, intrinsics_, options_.baseline_m, frame_number);
  for_each_row(options_.height, threads_,
               [&](int v, unsigned thread) { see_row(world, view, v, buffers_[thread]); });
  DepthImage depth{Image<std::uint16_t>(options_.width, options_.height), 0.001F};
  // A second pass: mixed pixels need the rows above and below.
  for_each_row(options_.height, threads_,
               [&](int v, unsigned) { report_row(frame_number, v, depth); });
  return depth;
}

void StereoCamera::see_row(const RayCaster& world, const View& view, int v, RowBuffers& row) {
  const auto width = static_cast<std::size_t>(options_.width);
  for (std::size_t i = 0; i < width; ++i) row.rays[i] = view.ray(static_cast<int>(i), v);
  world.cast(view.left_m, row.rays, row.hits);
  for (std::size_t i = 0; i < width; ++i) {
    const float z_m = std::isfinite(row.hits[i].distance) ? row.hits[i].distance : 1.0F;
    row.points[i] = view.left_m + z_m * row.rays[i];
  }
  if (!options_.is_ideal) world.look(view.right_m, row.points, row.is_seen);

  const auto focal_baseline = static_cast<float>(intrinsics_.fx() * options_.baseline_m);
  for (std::size_t i = 0; i < width; ++i) {
    const auto u = static_cast<int>(i);
    const Hit& hit = row.hits[i];
    const bool is_surface = std::isfinite(hit.distance);
    disparity_px_.at(u, v) = is_surface ? focal_baseline / hit.distance : 0.0F;
    is_matched_.at(u, v) =
        is_surface &&
        (options_.is_ideal || (row.is_seen[i] != 0 && is_matched(hit, view.frame_number, u, v)));
  }
}

bool StereoCamera::is_matched(const Hit& hit, std::uint64_t frame_number, int u, int v) const {
  const float chance = drop_out_chance(hit);
  if (chance <= 0.0F) return true;
  // Matching fails in patches, as its windows overlap: most pixels share the fate of their patch.
  constexpr int kPatch_px = 8;
  constexpr float kPatchShare = 0.75F;
  const CounterRandom random(seed_, frame_number);
  const bool with_patch = random.uniform(counter(Draw::kPatchOrPixel, u, v)) < kPatchShare;
  const float draw = with_patch
                         ? random.uniform(counter(Draw::kPatch, u / kPatch_px, v / kPatch_px))
                         : random.uniform(counter(Draw::kPixel, u, v));
  return draw >= chance;
}

float StereoCamera::mixed_disparity(int u, int v, float draw, float share) const {
  // A surface, however steep, changes by less than this from pixel to pixel; an edge by more.
  constexpr float kEdge_px = 1.0F;
  const float here = disparity_px_.at(u, v);
  if (draw >= static_cast<float>(options_.mixed_pixel_chance)) return here;
  const auto mixed_with = [&](int nu, int nv) {
    const bool is_inside = nu >= 0 && nv >= 0 && nu < options_.width && nv < options_.height;
    const float there = is_inside ? disparity_px_.at(nu, nv) : 0.0F;
    return there > 0.0F && std::abs(there - here) > kEdge_px ? there : here;
  };
  for (const auto& [du, dv] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const float there = mixed_with(u + du, v + dv);
    if (there != here) return here + share * (there - here);
  }
  return here;
}

/// The error of disparity: StereoOptions::barrel, told for the middle of the left edge at 1.4 m.
float StereoCamera::bend_px(int u, int v) const {
  if (options_.barrel == 0.0) return 0.0F;
  constexpr double kToldAt_m = 1.4;
  const Eigen::Vector3d ray = intrinsics_.back_project(u, v, 1.0);
  const double edge = intrinsics_.back_project(0, intrinsics_.cy(), 1.0).x();
  const double disparity_px = intrinsics_.fx() * options_.baseline_m / kToldAt_m;
  const double at_edge_px = disparity_px * (1.0 - 1.0 / (1.0 + options_.barrel));
  return static_cast<float>(-at_edge_px * ray.head<2>().squaredNorm() / (edge * edge));
}

std::uint16_t StereoCamera::reading_mm(float disparity_px) const {
  if (disparity_px <= 0.0F) return 0;
  const double z_m = intrinsics_.fx() * options_.baseline_m / static_cast<double>(disparity_px);
  if (!(z_m >= options_.min_range_m && z_m <= options_.max_range_m)) return 0;
  return static_cast<std::uint16_t>(std::lround(z_m * 1000.0));
}

void StereoCamera::report_row(std::uint64_t frame_number, int v, DepthImage& depth) const {
  const CounterRandom random(seed_, frame_number);
  const auto noise_px = static_cast<float>(options_.disparity_noise_px);
  const auto step_px = static_cast<float>(options_.disparity_step_px);
  for (int u = 0; u < options_.width; ++u) {
    if (is_matched_.at(u, v) == 0) continue;
    if (options_.is_ideal) {
      depth.raw.at(u, v) = reading_mm(disparity_px_.at(u, v) + bend_px(u, v));
      continue;
    }
    const float disparity_px = mixed_disparity(u, v, random.uniform(counter(Draw::kMixes, u, v)),
                                               random.uniform(counter(Draw::kMixture, u, v))) +
                               noise_px * random.gaussian(counter(Draw::kNoise, u, v)) +
                               bend_px(u, v);
    depth.raw.at(u, v) = reading_mm(std::round(disparity_px / step_px) * step_px);
  }
}

}  // namespace swiftlet::sim
