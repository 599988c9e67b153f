// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <memory>

namespace swiftlet::station {

/// A fixed number of places, each taken for as long as what take() returns lives.
class Places {
 public:
  explicit Places(std::size_t count) : count_(count) {}
  /// Null if all are taken.
  [[nodiscard]] std::shared_ptr<void> take() const { return taken() < count_ ? users_ : nullptr; }
  [[nodiscard]] std::size_t taken() const {
    return static_cast<std::size_t>(users_.use_count()) - 1;
  }

 private:
  std::size_t count_;
  std::shared_ptr<void> users_ = std::make_shared<int>(0);  // its users are counted
};

}  // namespace swiftlet::station
