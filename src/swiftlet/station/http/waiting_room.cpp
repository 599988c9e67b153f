// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/waiting_room.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace swiftlet::station {

std::shared_ptr<const WaitingRoom::Guest> WaitingRoom::enter(std::string address,
                                                             SendAway send_away) {
  std::erase_if(guests_, [](const auto& guest) { return guest.expired(); });
  auto guest = std::make_shared<const Guest>(Guest{std::move(address), std::move(send_away)});
  guests_.push_back(guest);
  if (guests_.size() > places_) send_one_away();
  return guest;
}

bool WaitingRoom::send_one_away() {
  std::erase_if(guests_, [](const auto& guest) { return guest.expired(); });
  if (guests_.empty()) return false;
  std::map<std::string, std::size_t> count;
  std::size_t most = 0;
  for (const auto& guest : guests_) most = std::max(most, ++count[guest.lock()->address]);
  const auto longest = std::ranges::find_if(
      guests_, [&](const auto& guest) { return count[guest.lock()->address] == most; });
  const auto gone = longest->lock();
  guests_.erase(longest);
  ++sent_away_;
  gone->send_away();
  return true;
}

std::size_t WaitingRoom::waiting() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(guests_, [](const auto& guest) { return !guest.expired(); }));
}

}  // namespace swiftlet::station
