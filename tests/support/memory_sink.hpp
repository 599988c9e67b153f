// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "swiftlet/bag/byte_sink.hpp"

namespace swiftlet::test {

/// Keeps what is written where a test can see it; refuses from a size on, as a full disk does.
class MemorySink final : public ByteSink {
 public:
  explicit MemorySink(std::shared_ptr<std::string> out, std::size_t room = ~std::size_t{0})
      : out_(std::move(out)), room_(room) {}
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override {
    if (out_->size() + bytes.size() > room_) return fail(ErrorCode::kIo, "memory", "it is full");
    out_->append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return Done{};
  }

 private:
  std::shared_ptr<std::string> out_;
  std::size_t room_;
};

}  // namespace swiftlet::test
