// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/image.hpp"

namespace swiftlet::render {

/// Red, green and blue, 0 to 255.
struct Colour {
  std::uint8_t r = 255;  ///< red
  std::uint8_t g = 255;  ///< green
  std::uint8_t b = 255;  ///< blue
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// The colour multiplied by a brightness in 0 .. 1.
[[nodiscard]] Colour shaded(Colour colour, double brightness);

/// Dark violet (0) over green to yellow (1): matplotlib's viridis, which also reads well in grey
/// and by the colour blind.
[[nodiscard]] Colour height_colour(double fraction);

/// A picture; (0, 0) is the upper left pixel. Whatever is drawn outside is cut off.
using Picture = Image<Colour>;

/// Fills the pixels [x0, x1) x [y0, y1).
void fill_rectangle(Picture& picture, int x0, int y0, int x1, int y1, Colour colour);

/// Fills the pixels whose centres lie in a convex polygon [px], its corners in order.
void fill_polygon(Picture& picture, std::span<const Eigen::Vector2d> corners, Colour colour);

/// The picture at 1 / ratio of its size; every pixel is the mean of ratio x ratio (smooth edges).
[[nodiscard]] Picture reduced(const Picture& picture, int ratio);

/// Writes a PNG, all of it or nothing: an old file of that name stays until the new one is
/// complete. Errors: kIo with the system's reason.
[[nodiscard]] Status write_png(const Picture& picture, const std::string& path);

}  // namespace swiftlet::render
