// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/wire/messages.hpp"

#include <algorithm>
#include <array>

namespace swiftlet::mavlink {
namespace {

/// The wire orders fields by the size of their elements; one listed at a wrong place would be read
/// from a wrong one, without any checksum telling.
template <class Message>
constexpr bool is_in_wire_order() {
  std::size_t last = 8;
  bool is_sorted = true, is_base = true;
  for_each_field<Message>([&]<class Value>(const Field<Message, Value>& field) {
    const std::size_t size = sizeof(typename layout::ElementOf<Value>::Type);
    if (field.age == FieldAge::kExtension) {
      is_base = false;
    } else {
      is_sorted = is_sorted && is_base && size <= last;
      last = size;
    }
  });
  return is_sorted;
}

template <class... Message>
constexpr std::array<MessageKind, sizeof...(Message)> kinds_of(const std::tuple<Message...>*) {
  static_assert((is_in_wire_order<Message>() && ...));
  return {MessageKind{Message::kId, Message::kName, crc_extra_of<Message>()}...};
}

constexpr auto kKinds = kinds_of(static_cast<const Messages*>(nullptr));
static_assert(std::ranges::is_sorted(kKinds, {}, &MessageKind::id));

}  // namespace

const MessageKind* find_message(std::uint32_t id) {
  const auto* const found = std::ranges::lower_bound(kKinds, id, {}, &MessageKind::id);
  return found != kKinds.end() && found->id == id ? &*found : nullptr;
}

}  // namespace swiftlet::mavlink
