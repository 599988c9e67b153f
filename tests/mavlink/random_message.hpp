// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/seeds.hpp"
#include "swiftlet/mavlink/wire/messages.hpp"

namespace swiftlet::test {

/// Any number but NaN, whose bits JavaScript does not keep; texts of letters, as zeros end them.
template <class Element>
Element random_element(Random& random) {
  if constexpr (std::same_as<Element, char>) {
    return static_cast<char>(random.integer<int>('a', 'z'));
  } else {
    const auto bits = static_cast<mavlink::layout::Bits<Element>>(random.engine()());
    const auto value = std::bit_cast<Element>(bits);
    if constexpr (std::same_as<Element, float>) return std::isnan(value) ? -0.0F : value;
    return value;
  }
}

/// A message with random fields, of which the last ones may be zero, as wires see them.
template <mavlink::MessageType Message>
Message random_message(Random& random) {
  Message message{};
  double zeros_from = random.chance(0.5) ? random.real(0, 1) : 2;
  const double step = 1.0 / static_cast<double>(std::tuple_size_v<decltype(Message::fields())>);
  mavlink::for_each_field<Message>([&](const auto& field) {
    zeros_from -= step;
    mavlink::layout::for_each_element(message.*field.member, [&]<class Element>(Element& element) {
      element = zeros_from < 0 ? Element{} : random_element<Element>(random);
    });
  });
  return message;
}

/// "NAME field=1,2,3 field=4": integers as they are, floats as the bits of them.
template <mavlink::MessageType Message>
std::string text_of_message(const Message& message) {
  std::string text(Message::kName);
  mavlink::for_each_field<Message>([&](const auto& field) {
    text += ' ' + std::string(field.name) + '=';
    bool is_first = true;
    mavlink::layout::for_each_element(message.*field.member, [&]<class Element>(Element element) {
      if (!is_first) text += ',';
      is_first = false;
      if constexpr (std::same_as<Element, float>) {
        text += std::to_string(std::bit_cast<std::uint32_t>(element));
      } else {
        text += std::to_string(element);
      }
    });
  });
  return text;
}

/// The bytes of hexadecimal digits.
inline std::vector<std::uint8_t> bytes_of_hex(std::string_view hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoul(std::string(hex.substr(i, 2)), nullptr, 16)));
  return bytes;
}

}  // namespace swiftlet::test
