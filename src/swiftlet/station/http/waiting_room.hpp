// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <string>

namespace swiftlet::station {

/// Connections that have not shown yet that they may look, a bounded number of them. One more than
/// there is room for sends another away: of the address that has most of them here the one that
/// has waited longest. So whoever opens many connections and says nothing keeps out himself.
/// Thread safety: the station's thread alone.
class WaitingRoom {
 public:
  /// Called when somebody has to go; must not come back to the room.
  using SendAway = std::function<void()>;
  struct Guest {
    std::string address;
    SendAway send_away;
  };

  explicit WaitingRoom(std::size_t places) : places_(places) {}

  /// Somebody waits for as long as the ticket lives, or until he is sent away.
  [[nodiscard]] std::shared_ptr<const Guest> enter(std::string address, SendAway send_away);
  /// As if one more had come: where something else than places has run out. False if nobody waits.
  bool send_one_away();

  [[nodiscard]] std::size_t waiting() const;
  [[nodiscard]] std::size_t sent_away() const { return sent_away_; }  ///< so far

 private:
  std::size_t places_;
  std::size_t sent_away_ = 0;
  std::deque<std::weak_ptr<const Guest>> guests_;  // who has waited longest is first
};

}  // namespace swiftlet::station
