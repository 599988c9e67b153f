// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/frame/intrinsics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swiftlet {
namespace {

constexpr int kMaxSide = 16384;  // so that pixel coordinates fit 16 bits everywhere

}  // namespace

Expected<PinholeIntrinsics> PinholeIntrinsics::create(int width, int height, double fx_px,
                                                      double fy_px, double cx_px, double cy_px) {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    return fail(ErrorCode::kCorruptInput, "intrinsics",
                fmt::format("an image of {} x {} pixels cannot be used", width, height),
                fmt::format("each side must be 1 to {}", kMaxSide));
  }
  const bool finite =
      std::isfinite(fx_px) && std::isfinite(fy_px) && std::isfinite(cx_px) && std::isfinite(cy_px);
  if (!finite || fx_px <= 0.0 || fy_px <= 0.0) {
    return fail(ErrorCode::kCorruptInput, "intrinsics",
                fmt::format("singular or not finite: fx {}, fy {}, cx {}, cy {}", fx_px, fy_px,
                            cx_px, cy_px),
                "focal lengths must be positive pixels");
  }
  return PinholeIntrinsics(width, height, fx_px, fy_px, cx_px, cy_px);
}

Expected<PinholeIntrinsics> PinholeIntrinsics::from_field_of_view(int width, int height,
                                                                  double hfov_rad) {
  if (!(hfov_rad > 0.0 && hfov_rad < std::numbers::pi)) {
    return fail(ErrorCode::kCorruptInput, "intrinsics",
                "the field of view must lie between 0 and 180 degrees");
  }
  const double f = 0.5 * width / std::tan(0.5 * hfov_rad);
  return create(width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1));
}

}  // namespace swiftlet
