// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace swiftlet {

/// Is told how far long work has come: `done` of `total`, which is absent where only the end tells.
/// A piece of work begins with done = 0. Called by the thread that works, which it must not hold
/// up. An empty function tells nobody.
using ProgressFunction = std::function<void(std::size_t done, std::optional<std::size_t> total)>;

/// One piece of work, which tells how far it has come.
class ProgressTeller {
 public:
  ProgressTeller(const ProgressFunction& tell, std::optional<std::size_t> total)
      : tell_(tell), total_(total) {
    update(0);
  }
  void update(std::size_t done) const {
    if (tell_) tell_(done, total_);
  }

 private:
  const ProgressFunction& tell_;
  std::optional<std::size_t> total_;
};

}  // namespace swiftlet
