// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/frame_quality.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <span>

namespace swiftlet {
namespace {

constexpr std::uint16_t kEndOfScale = std::numeric_limits<std::uint16_t>::max();

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Depth edges along lines of pixels.
struct EdgeCount {
  static constexpr std::ptrdiff_t kReach = 24;  // pixels before, along and behind an edge
  static constexpr std::ptrdiff_t kLength = 3 * kReach;
  std::size_t edges = 0, ramps = 0;

  /// Asks the pixels p[0], p[step] .. p[kLength * step].
  void add(const std::uint16_t* p, std::ptrdiff_t step) {
    const std::uint16_t* from = p + kReach * step;
    const int a = from[0], b = from[kReach * step];
    const int jump = std::abs(b - a);
    if (a == 0 || b == 0 || 4 * jump < std::min(a, b)) return;
    const int before = p[0], behind = p[kLength * step];
    if (before == 0 || behind == 0) return;
    if (4 * std::abs(a - before) > jump || 4 * std::abs(behind - b) > jump) return;
    ++edges;
    int steepest = 0;
    for (std::ptrdiff_t k = 0; k < kReach; ++k) {
      const int z = from[k * step], next = from[(k + 1) * step];
      if (next == 0) return;  // a shadow: the edge is sharp
      steepest = std::max(steepest, std::abs(next - z));
    }
    ramps += 4 * steepest < jump ? 1 : 0;
  }
};

}  // namespace

ReadingShares shares_of_readings(const DepthImage& depth) {
  std::size_t holes = 0, ends = 0;
  for (int v = 0; v < depth.raw.height(); ++v) {
    // As wide as the pixels, so that the compiler puts as many into a vector; a row has 16384 at
    // most.
    std::uint16_t holes_of_row = 0, ends_of_row = 0;
    for (const std::uint16_t d : depth.raw.row(v)) {
      holes_of_row = static_cast<std::uint16_t>(holes_of_row + (d == 0 ? 1 : 0));
      ends_of_row = static_cast<std::uint16_t>(ends_of_row + (d == kEndOfScale ? 1 : 0));
    }
    holes += holes_of_row;
    ends += ends_of_row;
  }
  const std::size_t pixels = depth.raw.pixels().size();
  return {share_of(pixels - holes, pixels), share_of(ends, pixels - holes)};
}

double share_at_one_value(const DepthImage& depth) {
  constexpr std::size_t kMost = 4096;
  std::array<std::uint16_t, kMost> sample;
  const auto pixels = depth.raw.pixels();
  const std::size_t every = (pixels.size() + kMost - 1) / kMost;
  std::size_t readings = 0;
  for (std::size_t i = 0; i < pixels.size(); i += every) {
    if (pixels[i] != 0) sample[readings++] = pixels[i];
  }
  const std::span known = std::span(sample).first(readings);
  std::ranges::sort(known);
  std::size_t most = 0;
  for (auto run = known.begin(); run != known.end();) {
    const auto end = std::upper_bound(run, known.end(), *run);
    most = std::max(most, static_cast<std::size_t>(end - run));
    run = end;
  }
  return share_of(most, readings);
}

double share_of_smeared_edges(const DepthImage& depth) {
  constexpr int kEvery = 16;
  constexpr std::size_t kFewest = 600;  // about four edges as high as the image
  const int width = depth.raw.width(), height = depth.raw.height();
  EdgeCount rows, columns;
  for (int v = kEvery / 2; v < height; v += kEvery) {
    const std::uint16_t* row = depth.raw.row(v).data();
    for (std::ptrdiff_t u = 0; u + EdgeCount::kLength < width; ++u) rows.add(row + u, 1);
  }
  // Row by row, for the cache.
  for (int v = 0; v + EdgeCount::kLength < height; ++v) {
    const std::uint16_t* row = depth.raw.row(v).data();
    for (int u = kEvery / 2; u < width; u += kEvery) columns.add(row + u, width);
  }
  const auto share = [](const EdgeCount& count) {
    return count.edges < kFewest ? 0.0 : share_of(count.ramps, count.edges);
  };
  return std::max(share(rows), share(columns));
}

double share_of_rough_pairs(const DepthImage& depth) {
  constexpr int kEvery = 16;
  constexpr std::size_t kFewest = 500;
  std::size_t pairs = 0, rough = 0;
  for (int v = kEvery / 2; v < depth.raw.height(); v += kEvery) {
    const auto row = depth.raw.row(v);
    for (std::size_t u = 1; u < row.size(); ++u) {
      const int a = row[u - 1], b = row[u];
      const bool is_pair = a != 0 && b != 0;
      pairs += is_pair ? 1 : 0;
      rough += is_pair && 4 * std::abs(a - b) > std::min(a, b) ? 1 : 0;
    }
  }
  return pairs < kFewest ? 0.0 : share_of(rough, pairs);
}

FrameQuality measure_quality(const DepthImage& depth) {
  const ReadingShares shares = shares_of_readings(depth);
  return {shares.valid, shares.saturated, share_at_one_value(depth), share_of_smeared_edges(depth),
          share_of_rough_pairs(depth)};
}

}  // namespace swiftlet
