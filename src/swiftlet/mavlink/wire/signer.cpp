// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/wire/signer.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <vector>

#include "swiftlet/file/file_content.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr std::int64_t kYear2015_ns = 1'420'070'400'000'000'000;
constexpr std::int64_t kTick_ns = 10'000;
constexpr std::size_t kTimeBytes = 6, kHashBytes = 6;
constexpr std::uint64_t kMostTime = (std::uint64_t{1} << (8 * kTimeBytes)) - 1;
constexpr std::size_t kMostFileBytes = 4096;

Expected<SigningKey> key_from(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  SigningKey key{};
  bool is_key = text.size() == 2 * key.size();
  for (std::size_t i = 0; is_key && i < key.size(); ++i) {
    const char* const digits = text.data() + 2 * i;
    const auto [stop, error] = std::from_chars(digits, digits + 2, key[i], 16);
    is_key = error == std::errc{} && stop == digits + 2;
  }
  if (!is_key) {
    return fail(ErrorCode::kInvalidConfig, {}, "the key is not 64 hexadecimal digits",
                "make one with `openssl rand -hex 32`");
  }
  return key;
}

}  // namespace

Expected<SigningKey> load_signing_key(const std::filesystem::path& path) {
  auto text = read_file(path, kMostFileBytes);
  if (!text) return forward_error(std::move(text));
  std::error_code unknown;
  const auto may = std::filesystem::status(path, unknown).permissions();
  if ((may & std::filesystem::perms::others_read) != std::filesystem::perms::none) {
    return fail(ErrorCode::kInvalidConfig, path.string(),
                "every user of this computer may read the key", "chmod 600 it");
  }
  auto key = key_from(*text);
  if (!key) key.error().where = path.string();
  return key;
}

std::uint64_t signing_time(Stamp unix_time) {
  const std::int64_t since = std::max<std::int64_t>(unix_time.ns - kYear2015_ns, 0);
  return std::min(static_cast<std::uint64_t>(since / kTick_ns), kMostTime);
}

Signature sign_frame(const SigningKey& key, std::span<const std::uint8_t> frame, std::uint8_t link,
                     std::uint64_t signing_time) {
  Signature signature{link};
  for (std::size_t i = 0; i < kTimeBytes; ++i)
    signature[1 + i] = static_cast<std::uint8_t>(signing_time >> (8 * i));
  std::vector<std::uint8_t> hashed(key.begin(), key.end());
  hashed.insert(hashed.end(), frame.begin(), frame.end());
  hashed.insert(hashed.end(), signature.begin(), signature.begin() + 1 + kTimeBytes);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  EVP_Digest(hashed.data(), hashed.size(), digest.data(), &size, EVP_sha256(), nullptr);
  std::copy_n(digest.begin(), kHashBytes, signature.begin() + 1 + kTimeBytes);
  return signature;
}

Signature Signer::sign(std::span<const std::uint8_t> frame, Stamp now) {
  last_ = std::min(std::max(signing_time(now), last_ + 1), kMostTime);
  return sign_frame(key_, frame, link_, last_);
}

}  // namespace swiftlet::mavlink
