// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "swiftlet/mavlink/wire/message_layout.hpp"

// What a companion asks of an autopilot. Source of names, numbers and order: the public dialect
// common.xml.

namespace swiftlet::mavlink {

/// A parameter's name, without a zero at its end if it fills the field.
using ParameterName = std::array<char, 16>;

struct ParamRequestRead {
  static constexpr std::string_view kName = "PARAM_REQUEST_READ";
  static constexpr std::uint32_t kId = 20;
  std::int16_t param_index = -1;  ///< -1: by name
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  ParameterName param_id{};
  [[nodiscard]] static constexpr auto fields() {
    using M = ParamRequestRead;
    return std::tuple(
        base("param_index", &M::param_index), base("target_system", &M::target_system),
        base("target_component", &M::target_component), base("param_id", &M::param_id));
  }
};

struct ParamValue {
  static constexpr std::string_view kName = "PARAM_VALUE";
  static constexpr std::uint32_t kId = 22;
  float param_value = 0;  ///< PX4 sends the bits of an integer, ArduPilot its value
  std::uint16_t param_count = 0;
  std::uint16_t param_index = 0;
  ParameterName param_id{};
  std::uint8_t param_type = 0;  ///< MAV_PARAM_TYPE
  [[nodiscard]] static constexpr auto fields() {
    using M = ParamValue;
    return std::tuple(base("param_value", &M::param_value), base("param_count", &M::param_count),
                      base("param_index", &M::param_index), base("param_id", &M::param_id),
                      base("param_type", &M::param_type));
  }
};

struct CommandLong {
  static constexpr std::string_view kName = "COMMAND_LONG";
  static constexpr std::uint32_t kId = 76;
  float param1 = 0, param2 = 0, param3 = 0, param4 = 0, param5 = 0, param6 = 0, param7 = 0;
  std::uint16_t command = 0;  ///< MAV_CMD
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t confirmation = 0;
  [[nodiscard]] static constexpr auto fields() {
    using M = CommandLong;
    return std::tuple(
        base("param1", &M::param1), base("param2", &M::param2), base("param3", &M::param3),
        base("param4", &M::param4), base("param5", &M::param5), base("param6", &M::param6),
        base("param7", &M::param7), base("command", &M::command),
        base("target_system", &M::target_system), base("target_component", &M::target_component),
        base("confirmation", &M::confirmation));
  }
};

struct CommandAck {
  static constexpr std::string_view kName = "COMMAND_ACK";
  static constexpr std::uint32_t kId = 77;
  std::uint16_t command = 0;  ///< MAV_CMD
  std::uint8_t result = 0;    ///< MAV_RESULT
  std::uint8_t progress = 0;
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  [[nodiscard]] static constexpr auto fields() {
    using M = CommandAck;
    return std::tuple(base("command", &M::command), base("result", &M::result),
                      extension("progress", &M::progress),
                      extension("result_param2", &M::result_param2),
                      extension("target_system", &M::target_system),
                      extension("target_component", &M::target_component));
  }
};

}  // namespace swiftlet::mavlink
