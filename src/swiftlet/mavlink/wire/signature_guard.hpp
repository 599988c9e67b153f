// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "swiftlet/mavlink/wire/signer.hpp"

namespace swiftlet::mavlink {

/// Why a frame with a sound checksum is refused.
enum class SignatureFault : std::uint8_t {
  kMissing,   ///< it is not signed
  kForged,    ///< by another key
  kReplayed,  ///< it is not later than one that came, or from a new sender and a minute old
};

/// Lets pass what the owner of a key has signed, once. Each sender (system, component, link id)
/// counts for itself, as frames of several arrive in any order; the first frame of a new one may be
/// up to a minute older than the newest of all. Source: MAVLink 2, "Message Signing", "Accepting
/// Signed Packets".
/// Memory: kMostSenders; further ones are refused as replayed. Thread safety: none, one owner.
class SignatureGuard {
 public:
  static constexpr std::size_t kMostSenders = 64;

  explicit SignatureGuard(const SigningKey& key) : key_(key) {}

  /// `frame`: all of it, the signature too if it has one. `now`: Unix time. Nullopt if it may pass.
  [[nodiscard]] std::optional<SignatureFault> judge(std::span<const std::uint8_t> frame, Stamp now);

 private:
  struct Sender {
    Address from;
    std::uint8_t link;
    std::uint64_t last;  // signing_time() of its newest frame
  };
  [[nodiscard]] bool admit(const Sender& claim);

  SigningKey key_;
  std::uint64_t newest_ = 0;  // of all senders and of this computer's clock
  std::vector<Sender> senders_;
};

}  // namespace swiftlet::mavlink
