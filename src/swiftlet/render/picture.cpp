// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/render/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::render {
namespace {

/// Nine equidistant samples of viridis.
constexpr std::array kViridis{Colour{68, 1, 84},    Colour{71, 44, 122},  Colour{59, 81, 139},
                              Colour{44, 113, 142}, Colour{33, 144, 141}, Colour{39, 173, 129},
                              Colour{92, 200, 99},  Colour{170, 220, 50}, Colour{253, 231, 37}};

std::uint8_t byte(double v) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0)));
}

/// The part [begin, end] of a pixel row that lies inside a convex polygon; empty if begin > end.
struct Chord {
  double begin = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();
};

Chord chord_at(std::span<const Eigen::Vector2d> corners, double y) {
  Chord chord;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    chord.begin = std::min(chord.begin, x);
    chord.end = std::max(chord.end, x);
  }
  return chord;
}

/// The first pixel whose centre is at or behind a coordinate, inside [0, size].
int first_pixel(double coordinate, int size) {
  return static_cast<int>(std::clamp(std::ceil(coordinate - 0.5), 0.0, static_cast<double>(size)));
}

}  // namespace

Colour shaded(Colour c, double brightness) {
  return {byte(c.r * brightness), byte(c.g * brightness), byte(c.b * brightness)};
}

Colour height_colour(double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * (kViridis.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double share = place - static_cast<double>(lower);
  const Colour a = kViridis[lower];
  const Colour b = kViridis[lower + 1];
  const auto mix = [share](std::uint8_t from, std::uint8_t to) {
    return byte(from + share * (to - from));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

void fill_rectangle(Picture& picture, int x0, int y0, int x1, int y1, Colour colour) {
  const int left = std::clamp(x0, 0, picture.width());
  const int right = std::clamp(x1, left, picture.width());
  for (int y = std::max(y0, 0); y < std::min(y1, picture.height()); ++y) {
    std::ranges::fill(picture.row(y).subspan(static_cast<std::size_t>(left),
                                             static_cast<std::size_t>(right - left)),
                      colour);
  }
}

void fill_polygon(Picture& picture, std::span<const Eigen::Vector2d> corners, Colour colour) {
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (const Eigen::Vector2d& corner : corners) {
    top = std::min(top, corner.y());
    bottom = std::max(bottom, corner.y());
  }
  for (int y = first_pixel(top, picture.height()); y < first_pixel(bottom, picture.height()); ++y) {
    const Chord chord = chord_at(corners, y + 0.5);
    if (chord.begin > chord.end) continue;
    fill_rectangle(picture, first_pixel(chord.begin, picture.width()), y,
                   first_pixel(chord.end, picture.width()), y + 1, colour);
  }
}

Picture reduced(const Picture& picture, int ratio) {
  SWIFTLET_REQUIRE(ratio >= 1, "a picture is reduced by whole numbers");
  Picture small(picture.width() / ratio, picture.height() / ratio);
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int dy = 0; dy < ratio; ++dy) {
        for (int dx = 0; dx < ratio; ++dx) {
          const Colour c = picture.at(x * ratio + dx, y * ratio + dy);
          sum += Eigen::Vector3d(c.r, c.g, c.b);
        }
      }
      sum /= ratio * ratio;
      small.at(x, y) = {byte(sum.x()), byte(sum.y()), byte(sum.z())};
    }
  }
  return small;
}

}  // namespace swiftlet::render
