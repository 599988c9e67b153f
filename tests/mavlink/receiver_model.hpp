// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "swiftlet/mavlink/wire/obstacle_messages.hpp"

namespace swiftlet::test {

/// What an autopilot believes of one direction, in its own bins. [cm]
struct Belief {
  enum class Kind { kObstacle, kFree, kUnknown } kind = Kind::kUnknown;
  double distance_cm = 0;
};

inline Belief belief_of(const mavlink::ObstacleDistance& message, std::uint16_t distance_cm) {
  if (distance_cm == 65'535) return {Belief::Kind::kUnknown};
  if (distance_cm > message.max_distance) return {Belief::Kind::kFree};
  return {Belief::Kind::kObstacle, static_cast<double>(distance_cm)};
}

/// How the receivers compute, as their public sources do; any index outside the message is a
/// failure, whatever is told. Angles are degrees clockwise from the nose.
class ReceiverModel {
 public:
  virtual ~ReceiverModel() = default;
  void take(const mavlink::ObstacleDistance& message) {
    EXPECT_EQ(reads_outside(message), 0) << "distances that the message does not have";
  }
  /// Takes it, and counts the reads past the end of its distances.
  [[nodiscard]] int reads_outside(const mavlink::ObstacleDistance& message) {
    message_ = message;
    read_.fill(false);
    outside_ = 0;
    decode();
    return outside_;
  }
  [[nodiscard]] virtual Belief at(double clockwise_deg) const = 0;
  [[nodiscard]] bool has_read(std::size_t sector) const { return read_[sector]; }

 protected:
  virtual void decode() = 0;
  [[nodiscard]] float increment() const {
    return message_.increment_f > 0 ? message_.increment_f : static_cast<float>(message_.increment);
  }
  [[nodiscard]] std::uint16_t distance(int index) {
    if (index < 0 || index >= 72) {
      ++outside_;
      return 65'535;
    }
    read_[static_cast<std::size_t>(index)] = true;
    return message_.distances[static_cast<std::size_t>(index)];
  }
  static double wrapped(double deg) { return deg - 360 * std::floor(deg / 360); }

  mavlink::ObstacleDistance message_;
  std::array<bool, 72> read_{};
  int outside_ = 0;
};

/// PX4 with 36 bins of 10 degrees: each takes one sector of the message.
class Px4With36Bins final : public ReceiverModel {
 public:
  [[nodiscard]] Belief at(double clockwise_deg) const override {
    const auto bin = static_cast<std::size_t>(std::floor(wrapped(clockwise_deg + 5) / 10));
    return belief_of(message_, bins_[bin % 36]);
  }

 private:
  void decode() override {
    EXPECT_EQ(message_.frame, 12);
    for (int bin = 0; bin < 36; ++bin) {
      const double offset = static_cast<double>(message_.angle_offset);
      const auto index = static_cast<int>(
          std::ceil(wrapped(bin * 10.0 - offset) / static_cast<double>(increment())));
      bins_[static_cast<std::size_t>(bin)] = distance(index);
    }
  }
  std::array<std::uint16_t, 36> bins_{};
};

/// PX4 with 72 bins of 5 degrees: each takes the last sector of the message that overlaps it.
class Px4With72Bins final : public ReceiverModel {
 public:
  [[nodiscard]] Belief at(double clockwise_deg) const override {
    const auto bin = static_cast<std::size_t>(std::floor(wrapped(clockwise_deg + 2.5) / 5));
    return belief_of(message_, bins_[bin % 72]);
  }

 private:
  void decode() override {
    EXPECT_EQ(message_.frame, 12);
    bins_.fill(65'535);
    const double width = static_cast<double>(increment());
    for (int index = 0; index < 360.0 / width; ++index) {
      const double centre = index * width + static_cast<double>(message_.angle_offset);
      for (int bin = 0; bin < 72; ++bin) {
        const double apart = std::abs(wrapped(centre - bin * 5.0 + 180) - 180);
        if (apart < (width + 5) / 2 - 1e-6) bins_[static_cast<std::size_t>(bin)] = distance(index);
      }
    }
  }
  std::array<std::uint16_t, 72> bins_{};
};

/// ArduPilot: 8 faces of 45 degrees take the nearest; what is too near, too far or not known is
/// skipped, so that a face without a distance is no obstacle.
class ArduPilotFaces final : public ReceiverModel {
 public:
  [[nodiscard]] Belief at(double clockwise_deg) const override {
    const auto& face = faces_[face_of(clockwise_deg)];
    return face ? Belief{Belief::Kind::kObstacle, static_cast<double>(*face)} : Belief{};
  }

 private:
  static std::size_t face_of(double deg) {
    return static_cast<std::size_t>(std::floor(wrapped(deg + 22.5) / 45)) % 8;
  }
  void decode() override {
    faces_.fill(std::nullopt);
    const double step = message_.increment_f != 0 ? static_cast<double>(message_.increment_f)
                                                  : static_cast<double>(message_.increment);
    const int count = std::min(static_cast<int>(std::lround(360 / std::abs(step))), 72);
    for (int index = 0; index < count; ++index) {
      const std::uint16_t cm = distance(index);
      if (cm == 0 || cm == 65'535 || cm < message_.min_distance || cm > message_.max_distance)
        continue;
      auto& face = faces_[face_of(static_cast<double>(message_.angle_offset) + index * step)];
      if (!face || cm < *face) face = cm;
    }
  }
  std::array<std::optional<std::uint16_t>, 8> faces_{};
};

}  // namespace swiftlet::test
