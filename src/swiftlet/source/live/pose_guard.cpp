// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live/pose_guard.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <span>
#include <system_error>

#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/base/number_text.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kFewestKeyBytes = 16, kMostKeyBytes = 4096;
constexpr std::string_view kSent = "sent ", kHmac = "hmac ";
constexpr std::int64_t kMostApart_ns = 30'000'000'000;

std::string hmac_of(std::string_view text, std::string_view key) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
  HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), bytes, text.size(), digest.data(),
       &size);
  std::string hex;
  for (unsigned i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

std::string_view without_line_end(std::string_view text) {
  return text.substr(0, text.find_last_not_of("\r\n") + 1);
}

/// Takes the last line away if it begins with a word; what follows the word.
std::optional<std::string_view> take_last_line(std::string_view& text, std::string_view word) {
  const std::string_view whole = without_line_end(text);
  const std::size_t begin = whole.rfind('\n') + 1;  // 0 if there is none
  if (!whole.substr(begin).starts_with(word)) return std::nullopt;
  text = text.substr(0, begin);
  return whole.substr(begin + word.size());
}

}  // namespace

Expected<std::string> load_pose_key(const std::filesystem::path& path) {
  auto bytes = open_file_bytes(path);
  if (!bytes) return forward_error(std::move(bytes));
  const auto refused = [&](std::string what, std::string remedy) {
    return fail(ErrorCode::kInvalidConfig, path.string(), std::move(what), std::move(remedy));
  };
  std::error_code unknown;
  const auto may = std::filesystem::status(path, unknown).permissions();
  if ((may & std::filesystem::perms::others_read) != std::filesystem::perms::none)
    return refused("every user of this computer may read the key", "chmod 600 it");
  if ((*bytes)->size() > kMostKeyBytes) return refused("it is too long for a key", "32 bytes do");
  std::string key((*bytes)->size(), '\0');
  if (auto read = (*bytes)->read(0, std::as_writable_bytes(std::span(key))); !read)
    return forward_error(std::move(read));
  key.resize(key.find_last_not_of(" \t\r\n") + 1);
  if (key.size() < kFewestKeyBytes)
    return refused("a key of fewer than 16 bytes can be guessed",
                   "make one with `openssl rand -hex 32`");
  return key;
}

tl::expected<std::string_view, PoseDenial> PoseGuard::admit(std::string_view datagram, Stamp now) {
  std::string_view body = datagram;
  const auto claimed = take_last_line(body, kHmac);
  const std::string expected = hmac_of(body, key_);
  if (!claimed || claimed->size() != expected.size() ||
      CRYPTO_memcmp(claimed->data(), expected.data(), expected.size()) != 0)
    return tl::make_unexpected(PoseDenial::kForged);
  const auto sent = take_last_line(body, kSent);
  const auto sent_ns = sent ? number_from<std::int64_t>(*sent) : std::nullopt;
  if (!sent_ns || *sent_ns <= last_sent_ns_ || *sent_ns < now.ns - kMostApart_ns ||
      *sent_ns > now.ns + kMostApart_ns)
    return tl::make_unexpected(PoseDenial::kReplayed);
  last_sent_ns_ = *sent_ns;
  return body;
}

std::string signed_poses(std::string_view lines, std::string_view key, Stamp sent) {
  std::string text(lines);
  if (!text.empty() && text.back() != '\n') text += '\n';
  text += fmt::format("{}{}\n", kSent, sent.ns);
  return text + fmt::format("{}{}\n", kHmac, hmac_of(text, key));
}

}  // namespace swiftlet
