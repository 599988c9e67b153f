// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/footprint_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

/// Samples along each side of a footprint; wider ones are sampled every k-th pixel.
constexpr int kSamplesAcross = 8;
constexpr int kSamplesAcrossNear = 24;

/// The part of a ray inside a cube.
struct Crossing {
  float z_in, z_out;
  [[nodiscard]] bool is_hit() const { return z_in <= z_out && z_out > 0.0F; }
};

Crossing cross(const Float3& centre, float half, const Float3& direction) {
  Crossing c{-1e30F, 1e30F};
  for (int i = 0; i < 3; ++i) {
    // A ray along a face crosses its slab at infinity, or always: 1e-12 keeps that a number.
    const float per = 1.0F / std::copysign(std::max(std::abs(direction[i]), 1e-12F), direction[i]);
    const float a = (centre[i] - half) * per, b = (centre[i] + half) * per;
    c.z_in = std::max(c.z_in, std::min(a, b));
    c.z_out = std::min(c.z_out, std::max(a, b));
  }
  return c;
}

int stride_of(int width, int height, int samples_across) {
  return std::max(1, (std::max(width, height) + samples_across - 1) / samples_across);
}

}  // namespace

FootprintEvidence::FootprintEvidence(const CubeView& view, const Image<std::uint16_t>& raw,
                                     const EvidenceTable& table, const StereoSensor& sensor,
                                     double logodds_per_step)
    : view_(view),
      raw_(raw),
      table_(table),
      half_voxel_m_(0.5F * view.voxel_m()),
      weight_per_z2_(static_cast<float>(sensor.weight(1.0))),
      steps_per_one_(static_cast<float>(kOneStep / logodds_per_step / EvidenceTable::kOne)),
      free_steps_(steps_per_one_ * static_cast<float>(table.free())) {}

FixedSteps FootprintEvidence::of_cell(const CubeInView& cell) const {
  const float z = cell.p_camera[2];
  if (z <= 0.0F) return 0;  // the camera's own cell, its centre behind the lens: as the rays do
  if (z < counting_m()) return counted(cell);

  const Footprint f = view_.footprint(cell);
  const PixelRect rect{static_cast<int>(std::ceil(f.u0)), static_cast<int>(std::ceil(f.v0)),
                       static_cast<int>(std::floor(f.u1)), static_cast<int>(std::floor(f.v1))};
  const int stride = stride_of(rect.u1 - rect.u0 + 1, rect.v1 - rect.v0 + 1, kSamplesAcross);
  const Samples samples = sample(cell, rect, stride);
  if (samples.rays == 0) return nearest(cell);
  if (samples.log_odds == 0) return 0;
  const float mean = static_cast<float>(samples.log_odds) / static_cast<float>(samples.rays);
  return static_cast<FixedSteps>(view_.observations(cell.p_world, z) * mean * steps_per_one_);
}

FixedSteps FootprintEvidence::counted(const CubeInView& cell) const {
  PixelRect rect{0, 0, view_.width() - 1, view_.height() - 1};
  if (cell.z_near() > 0.1F * view_.voxel_m()) {
    const Footprint f = view_.footprint(cell);
    if (!view_.meets_image(f)) return 0;
    rect = view_.pixels(f);
  }
  const int stride = stride_of(rect.u1 - rect.u0 + 1, rect.v1 - rect.v0 + 1, kSamplesAcrossNear);
  const Samples samples = sample(cell, rect, stride);
  const float z = cell.p_camera[2];
  const float rays_per_sample = static_cast<float>(stride) * static_cast<float>(stride);
  return static_cast<FixedSteps>(static_cast<float>(samples.log_odds) * rays_per_sample * z * z *
                                 weight_per_z2_ * steps_per_one_);
}

FixedSteps FootprintEvidence::nearest(const CubeInView& cell) const {
  const auto [u, v] = view_.project(cell.p_camera);
  const float nearest_u = std::floor(u + 0.5F), nearest_v = std::floor(v + 0.5F);
  Samples samples;
  const float z = cell.p_camera[2];
  add_reading(z, z - half_voxel_m_, static_cast<int>(nearest_u), static_cast<int>(nearest_v),
              samples);
  return static_cast<FixedSteps>(view_.observations(cell.p_world, z) *
                                 static_cast<float>(samples.log_odds) * steps_per_one_);
}

FootprintEvidence::Samples FootprintEvidence::sample(const CubeInView& cell, const PixelRect& rect,
                                                     int stride) const {
  Samples samples;
  const int u_first = rect.u0 + (rect.u1 - rect.u0) % stride / 2;
  const int v_first = rect.v0 + (rect.v1 - rect.v0) % stride / 2;
  for (int v = v_first; v <= rect.v1; v += stride) {
    for (int u = u_first; u <= rect.u1; u += stride) add_sample(cell, u, v, samples);
  }
  return samples;
}

void FootprintEvidence::add_sample(const CubeInView& cell, int u, int v, Samples& samples) const {
  const Crossing crossing = cross(cell.p_world, half_voxel_m_,
                                  view_.direction(static_cast<float>(u), static_cast<float>(v)));
  if (!crossing.is_hit()) return;
  ++samples.rays;
  add_reading(cell.p_camera[2], crossing.z_in, u, v, samples);
}

void FootprintEvidence::add_reading(float z, float z_in, int u, int v, Samples& samples) const {
  if (u < 0 || v < 0 || u >= view_.width() || v >= view_.height()) return;
  const std::uint16_t raw = raw_.at(u, v);
  if (raw == 0 || z_in > table_.reach_m(raw))
    return;  // no reading, or its ray ends before the cell
  const float offset = z - table_.depth_m(raw);
  const float gap = std::max(0.0F, std::abs(offset) - half_voxel_m_);
  samples.log_odds += table_.at(raw, std::copysign(gap, offset));
}

}  // namespace swiftlet
