// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "swiftlet/mavlink/wire/crc.hpp"

namespace swiftlet::mavlink {

/// The longest payload that a frame has room for [bytes].
inline constexpr std::size_t kMaxPayload = 255;
/// A payload with the zeros that the sender has cut off.
using Payload = std::array<std::uint8_t, kMaxPayload>;

/// Whether a field was in the first version of its message. Those that were added later (extension
/// fields) stand behind the others and may be missing.
enum class FieldAge : std::uint8_t { kBase, kExtension };

/// One field of a message: its name in the dialect and the member that holds it, a number or an
/// array of them.
template <class Message, class Value>
struct Field {
  std::string_view name;
  Value Message::*member;
  FieldAge age;
};
template <class Message, class Value>
[[nodiscard]] constexpr Field<Message, Value> base(std::string_view name, Value Message::*member) {
  return {name, member, FieldAge::kBase};
}
template <class Message, class Value>
[[nodiscard]] constexpr Field<Message, Value> extension(std::string_view name,
                                                        Value Message::*member) {
  return {name, member, FieldAge::kExtension};
}

/// A struct that tells its name, its number and its fields in the order of the wire: by falling
/// size of their elements, then as the dialect lists them; extensions last, as listed. All that the
/// functions below need to know of it.
template <class Message>
concept MessageType = requires {
  { Message::kName } -> std::convertible_to<std::string_view>;
  { Message::kId } -> std::convertible_to<std::uint32_t>;
  std::tuple_size<decltype(Message::fields())>::value;
};

namespace layout {

template <class Value>
struct ElementOf {
  using Type = Value;
  static constexpr std::size_t kCount = 0;  // no array
};
template <class Value, std::size_t Count>
struct ElementOf<std::array<Value, Count>> {
  using Type = Value;
  static constexpr std::size_t kCount = Count;
};

template <class Element>
[[nodiscard]] constexpr std::string_view type_name() {
  if constexpr (std::same_as<Element, char>) return "char";
  if constexpr (std::same_as<Element, float>) return "float";
  if constexpr (std::same_as<Element, std::uint8_t>) return "uint8_t";
  if constexpr (std::same_as<Element, std::int8_t>) return "int8_t";
  if constexpr (std::same_as<Element, std::uint16_t>) return "uint16_t";
  if constexpr (std::same_as<Element, std::int16_t>) return "int16_t";
  if constexpr (std::same_as<Element, std::uint32_t>) return "uint32_t";
  if constexpr (std::same_as<Element, std::int32_t>) return "int32_t";
  if constexpr (std::same_as<Element, std::uint64_t>) return "uint64_t";
  if constexpr (std::same_as<Element, std::int64_t>) return "int64_t";
}

template <class Element>
using Bits = std::conditional_t<
    sizeof(Element) == 1, std::uint8_t,
    std::conditional_t<sizeof(Element) == 2, std::uint16_t,
                       std::conditional_t<sizeof(Element) == 4, std::uint32_t, std::uint64_t>>>;

/// Little endian, whatever the machine; float fields of extensions are not aligned.
template <class Element>
constexpr void store(Element value, std::uint8_t* to) {
  const auto bits = std::bit_cast<Bits<Element>>(value);
  for (std::size_t i = 0; i < sizeof(Element); ++i)
    to[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(bits) >> (8 * i));
}
template <class Element>
[[nodiscard]] constexpr Element load(const std::uint8_t* from) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(Element); ++i)
    bits |= static_cast<std::uint64_t>(from[i]) << (8 * i);
  return std::bit_cast<Element>(static_cast<Bits<Element>>(bits));
}

/// Calls visit(element) for each number of a value.
template <class Value, class Visit>
constexpr void for_each_element(Value& value, Visit&& visit) {
  if constexpr (ElementOf<std::remove_const_t<Value>>::kCount == 0) {
    visit(value);
  } else {
    for (auto& element : value) visit(element);
  }
}

template <class Message, class Value>
[[nodiscard]] constexpr std::size_t size_of(const Field<Message, Value>&) {
  using Element = ElementOf<Value>;
  return sizeof(typename Element::Type) * (Element::kCount == 0 ? 1 : Element::kCount);
}

}  // namespace layout

/// Calls visit(field) for the fields of a message in the order of the wire.
template <MessageType Message, class Visit>
constexpr void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Message::fields());
}

/// The payload's length [bytes]: with the extensions, and without.
template <MessageType Message>
[[nodiscard]] constexpr std::size_t length_of() {
  std::size_t length = 0;
  for_each_field<Message>([&](const auto& field) { length += layout::size_of(field); });
  return length;
}
template <MessageType Message>
[[nodiscard]] constexpr std::size_t base_length_of() {
  std::size_t length = 0;
  for_each_field<Message>([&](const auto& field) {
    if (field.age == FieldAge::kBase) length += layout::size_of(field);
  });
  return length;
}

/// The byte that ends the checksum of every frame of this message, so that sender and receiver
/// agree on its name and fields: a checksum of these. Source: MAVLink 2, "CRC_EXTRA Calculation".
template <MessageType Message>
[[nodiscard]] constexpr std::uint8_t crc_extra_of() {
  std::uint16_t crc = kCrcStart;
  const auto add = [&](std::string_view text) {
    for (const char c : text) crc = crc_with(crc, static_cast<std::uint8_t>(c));
    crc = crc_with(crc, std::uint8_t{' '});
  };
  add(Message::kName);
  for_each_field<Message>([&]<class Value>(const Field<Message, Value>& field) {
    using Element = layout::ElementOf<Value>;
    if (field.age == FieldAge::kExtension) return;
    add(layout::type_name<typename Element::Type>());
    add(field.name);
    if constexpr (Element::kCount != 0)
      crc = crc_with(crc, static_cast<std::uint8_t>(Element::kCount));
  });
  return static_cast<std::uint8_t>((crc & 0xFFU) ^ (crc >> 8U));
}

/// Writes all fields of a message, extensions included. Returns the length that a sender sends:
/// without the zeros at the end, but at least 1.
template <MessageType Message>
constexpr std::size_t pack(const Message& message, Payload& payload) {
  static_assert(length_of<Message>() <= kMaxPayload);
  std::uint8_t* at = payload.data();
  for_each_field<Message>([&](const auto& field) {
    layout::for_each_element(message.*field.member, [&](const auto& element) {
      layout::store(element, at);
      at += sizeof element;
    });
  });
  std::size_t length = length_of<Message>();
  while (length > 1 && payload[length - 1] == 0) --length;
  return length;
}

/// Reads all fields of a message. What the sender has cut off is zero in the payload.
template <MessageType Message>
[[nodiscard]] constexpr Message unpack(const Payload& payload) {
  Message message{};
  const std::uint8_t* at = payload.data();
  for_each_field<Message>([&](const auto& field) {
    layout::for_each_element(message.*field.member, [&]<class Element>(Element& element) {
      element = layout::load<Element>(at);
      at += sizeof element;
    });
  });
  return message;
}

}  // namespace swiftlet::mavlink
