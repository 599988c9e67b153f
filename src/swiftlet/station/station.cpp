// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/station.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "swiftlet/station/http/reachable.hpp"
#include "swiftlet/station/http/server_private.hpp"

namespace swiftlet::station {
namespace {

Status check(const StationOptions& options) {
  if (!options.access.token.empty() && !is_good_token(options.access.token)) {
    return fail(ErrorCode::kUsage, "--token", "the token must be 8 to 128 letters, digits, - or _",
                "leave it out to be given one");
  }
  if (options.access.token.empty() && !options.listen.is_loopback()) {
    return fail(ErrorCode::kUsage, fmt::format("--listen {}", options.listen.text()),
                "others could reach this address, and there is no token",
                "add --token with one of your own");
  }
  return Done{};
}

#if SWIFTLET_HAS_VIEW
Expected<std::unique_ptr<Station>> start_checked(const StationOptions& options, MapModel&& model) {
  if (auto fine = check(options); !fine) return forward_error(std::move(fine));
  return start_server(options, std::move(model));
}
#else
Expected<std::unique_ptr<Station>> start_checked(const StationOptions& options, MapModel&&) {
  if (auto fine = check(options); !fine) return forward_error(std::move(fine));
  return fail(ErrorCode::kUnsupported, "ground station", "this build has none",
              "configure with -DSWIFTLET_WITH_VIEW=ON");
}
#endif

}  // namespace

Expected<std::unique_ptr<Station>> Station::start(const StationOptions& options, LiveFeed& feed) {
  return start_checked(options, MapModel(feed));
}

Expected<std::unique_ptr<Station>> Station::start(const StationOptions& options, SavedWorld saved) {
  return start_checked(options, MapModel(std::move(saved.info), std::move(saved.map)));
}

std::vector<std::string> Station::urls() const {
  const std::string query = token_.empty() ? "" : fmt::format("?token={}", token_);
  std::vector<std::string> urls;
  for (const ListenAddress& place : reachable_at(address(), own_addresses())) {
    urls.push_back(fmt::format("http://{}/{}", place.text(), query));
  }
  return urls;
}

void run_with_low_priority() {
  constexpr int kNice = 10;
  // On Linux this means the calling thread. Refused, the station is merely less modest.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice));
}

}  // namespace swiftlet::station
