// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/wire/signature_guard.hpp"

#include <openssl/crypto.h>

#include <algorithm>

namespace swiftlet::mavlink {
namespace {

constexpr std::uint64_t kMostLate = 60 * 100'000;  // a minute of 10 us

}  // namespace

std::optional<SignatureFault> SignatureGuard::judge(std::span<const std::uint8_t> frame,
                                                    Stamp now) {
  if ((frame[wire::kMustUnderstand] & wire::kIsSigned) == 0) return SignatureFault::kMissing;
  const auto body = frame.first(frame.size() - wire::kSignatureBytes);
  const auto claimed = frame.last(wire::kSignatureBytes);
  const std::uint8_t link = claimed[0];
  std::uint64_t time = 0;
  for (std::size_t i = 6; i > 0; --i) time = time << 8U | claimed[i];
  const Signature right = sign_frame(key_, body, link, time);
  if (CRYPTO_memcmp(right.data(), claimed.data(), right.size()) != 0)
    return SignatureFault::kForged;
  newest_ = std::max(newest_, signing_time(now));
  const Address from{frame[wire::kSystem], frame[wire::kComponent]};
  if (!admit({from, link, time})) return SignatureFault::kReplayed;
  newest_ = std::max(newest_, time);
  return std::nullopt;
}

bool SignatureGuard::admit(const Sender& claim) {
  const auto known = std::ranges::find_if(senders_, [&](const Sender& sender) {
    return sender.from == claim.from && sender.link == claim.link;
  });
  if (known != senders_.end()) {
    if (claim.last <= known->last) return false;
    known->last = claim.last;
    return true;
  }
  if (claim.last + kMostLate < newest_ || senders_.size() == kMostSenders) return false;
  senders_.push_back(claim);
  return true;
}

}  // namespace swiftlet::mavlink
