// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/mavlink/wire/packet.hpp"

namespace swiftlet::mavlink {

/// What the two ends of a link share so that neither believes anybody else.
using SigningKey = std::array<std::uint8_t, 32>;

/// Reads a key: 64 hexadecimal digits, which may be followed by blanks.
/// Errors: those of reading the file; kInvalidConfig for anything else, and for a file that every
/// user of this computer may read.
[[nodiscard]] Expected<SigningKey> load_signing_key(const std::filesystem::path& path);

/// What follows a signed frame: link id, time of signing (48 bits), and the first 48 bits of the
/// SHA-256 of key, frame, link id and time.
using Signature = std::array<std::uint8_t, wire::kSignatureBytes>;

/// The time as signatures tell it: 10 us since 2015, 48 bits. Before 2015 it is 0.
[[nodiscard]] std::uint64_t signing_time(Stamp unix_time);
/// REQUIRES: `signing_time` has no more than 48 bits.
[[nodiscard]] Signature sign_frame(const SigningKey& key, std::span<const std::uint8_t> frame,
                                   std::uint8_t link, std::uint64_t signing_time);

/// Signs frames, each later than the last even if the clock stands or is set back.
class Signer {
 public:
  explicit Signer(const SigningKey& key, std::uint8_t link = 0) : key_(key), link_(link) {}

  /// `frame`: all of it but the signature. `now`: Unix time.
  [[nodiscard]] Signature sign(std::span<const std::uint8_t> frame, Stamp now);

 private:
  SigningKey key_;
  std::uint8_t link_;
  std::uint64_t last_ = 0;  // signing_time() of the last signature
};

}  // namespace swiftlet::mavlink
