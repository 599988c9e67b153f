// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes come from a client of the ground station: as a request, as credentials, and as messages
// of every protocol that the server speaks, between which it is sent what it asked for.

#include <chrono>
#include <cstdint>
#include <string_view>

#include "swiftlet/station/http/door.hpp"
#include "swiftlet/station/http/http_answer.hpp"
#include "swiftlet/station/http/listen_address.hpp"
#include "swiftlet/station/http/server_private.hpp"
#include "swiftlet/station/page/client_message.hpp"

namespace {

using namespace swiftlet;
using namespace swiftlet::station;

const MapModel& small_map() {
  static const MapModel kModel = [] {
    MapMirror map;
    VoxelBlock block;
    block.clear();
    block.voxels[0] = 200;
    for (std::int32_t i = 0; i < 100; ++i) map.put({i * 700, 0, -i}, block, 1);
    return MapModel(MapInfo{}, std::move(map));
  }();
  return kModel;
}

/// The bytes up to the next newline.
std::string_view line_of(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

void ask(std::string_view text) {
  const AccessRules rules{"s3cret-token", {"https://map.example.org"}};
  const HttpQuestion question{
      line_of(text),
      {line_of(text), line_of(text), line_of(text), line_of(text), line_of(text)},
      line_of(text)};
  (void)answer(rules, question, {});
  (void)answer({}, question, {});
  const TellOperator nobody = [](const std::string&) {};
  Door door(rules, nobody, {});
  for (int i = 0; i < 20; ++i) (void)door.judge("guesser", "address", question.credentials, {});
  (void)parse_listen_address(text);
}

/// Length-prefixed messages, each with a bit that says whether it is a text.
void talk(const Subprotocol& language, const std::uint8_t* data, std::size_t size) {
  const auto protocol = language.make(small_map());
  ClientProtocol::Time now{};
  while (size > 1) {
    const std::size_t length = std::min<std::size_t>(data[0] & 0x7fU, size - 1);
    if (!protocol->received((data[0] & 0x80U) != 0, {data + 1, length}, now)) return;
    data += 1 + length;
    size -= 1 + length;
    now += std::chrono::milliseconds(50);
    for (int i = 0; i < 4; ++i) (void)protocol->next(now);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ask({reinterpret_cast<const char*>(data), size});
  (void)parse_client_message({data, size});
  for (const Subprotocol& language : subprotocols()) talk(language, data, size);
  return 0;
}
