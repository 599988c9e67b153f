// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// Reads the shared key of whoever sends poses: the bytes of a file, without blanks at its end.
/// Errors: those of reading it; kInvalidConfig for fewer than 16 bytes or more than 4096, and for a
/// file that every user of this computer may read.
[[nodiscard]] Expected<std::string> load_pose_key(const std::filesystem::path& path);

/// Why a datagram is refused.
enum class PoseDenial : std::uint8_t {
  kForged,    ///< its HMAC is missing or wrong
  kReplayed,  ///< it was sent before one that came, or more than 30 s from now
};

/// Lets pass what the owner of a key has sent, once. A datagram ends in two lines (docs/rig.md):
///
///     sent NANOSECONDS
///     hmac HEX
///
/// the Unix time of sending, later in each, and the HMAC-SHA256 of all bytes before this line.
/// Source: RFC 2104, FIPS 180-4; libcrypto of OpenSSL computes and compares.
class PoseGuard {
 public:
  explicit PoseGuard(std::string key) : key_(std::move(key)) {}

  /// The lines before those two. `now` is Unix time.
  [[nodiscard]] tl::expected<std::string_view, PoseDenial> admit(std::string_view datagram,
                                                                 Stamp now);

 private:
  const std::string key_;
  std::int64_t last_sent_ns_ = 0;
};

/// The two lines, for senders and tests.
[[nodiscard]] std::string signed_poses(std::string_view lines, std::string_view key, Stamp sent);

}  // namespace swiftlet
