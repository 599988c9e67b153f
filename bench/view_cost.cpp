// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// What looking on costs the mapper: swiftlet_view_cost [SOURCE [FRAMES [ROUNDS]]]
//
// Flies the same frames again and again at 30 Hz, in turn without a ground station and with one
// that 1, 4 and 16 clients are connected to over real sockets, one of which reads nothing. The
// turns go round, so that a slow moment of the machine hits all alike. Times are from the raw image
// to the map, with what the mapping thread does for the station.

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "swiftlet/app/report/bench_report.hpp"
#include "swiftlet/app/view/flight_watch.hpp"
#include "swiftlet/eval/bench/bench_workload.hpp"
#include "swiftlet/session/latency.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

using namespace swiftlet;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kFramePeriod = 33'333us;

/// A client on this machine that takes what it is sent, or nothing, and looks at none of it:
/// another machine's work is not measured here.
class Client {
 public:
  Client(std::uint16_t port, bool is_stalled) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const std::string request = fmt::format(
        "GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Protocol: swiftlet.v1\r\n\r\n",
        port);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&place), sizeof(place)) != 0 ||
        send(socket_, request.data(), request.size(), MSG_NOSIGNAL) < 0) {
      fmt::print(stderr, "a client cannot connect\n");
      std::exit(1);
    }
    if (is_stalled) return;
    reader_ = std::thread([this] {
      station::run_with_low_priority();
      std::vector<char> buffer(1 << 16);
      for (ssize_t n = 0; (n = recv(socket_, buffer.data(), buffer.size(), 0)) > 0;) bytes_ += n;
    });
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() {
    shutdown(socket_, SHUT_RDWR);
    if (reader_.joinable()) reader_.join();
    close(socket_);
  }
  std::size_t bytes() const { return bytes_; }

 private:
  int socket_;
  std::atomic<std::size_t> bytes_{0};
  std::thread reader_;
};

/// What others do on a busy machine does not count here.
Nanoseconds thread_cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + Nanoseconds(now.tv_nsec);
}

struct Setting {
  std::string name;
  std::size_t clients = 0;
  bool has_station = true;
  std::vector<Nanoseconds> times{};      // by the clock on the wall
  std::vector<Nanoseconds> cpu_times{};  // that the mapping thread itself ran
  std::size_t bytes = 0;                 // that the clients took, all together
  double elapsed_s = 0.0;
};

void fly(const app::Workload& workload, const MapperConfig& config, Setting& setting) {
  auto mapper = Mapper::create(config);
  const MapReader store = mapper->reader();  // `swiftlet map` always has the store's
  std::unique_ptr<app::FlightWatch> watch;
  std::vector<std::unique_ptr<Client>> clients;
  if (setting.has_station) {
    app::StationFlags flags;
    flags.listen = "127.0.0.1:0";
    watch = std::move(*app::FlightWatch::start(flags, workload.name, {}));
    watch->map_begun(*mapper);
    const std::uint16_t port = watch->station().address().port;
    for (std::size_t i = 0; i < setting.clients; ++i) {
      clients.push_back(std::make_unique<Client>(port, i == 0 && setting.clients > 1));
    }
  }
  const auto start = Clock::now();
  auto due = start;
  Frame arrived = workload.frames.front();
  for (std::size_t i = 0; i < workload.frames.size(); ++i) {
    std::this_thread::sleep_until(due);
    due += kFramePeriod;
    arrived = workload.frames[i];
    const auto begin = Clock::now();
    const Nanoseconds cpu_begin = thread_cpu_time();
    const MapUpdate update = mapper->integrate(arrived);
    if (watch) watch->frame_done(arrived, update, *mapper);
    if (i < workload.warm_up) continue;
    setting.cpu_times.push_back(thread_cpu_time() - cpu_begin);
    setting.times.push_back(Clock::now() - begin);
  }
  setting.elapsed_s += std::chrono::duration<double>(Clock::now() - start).count();
  for (const auto& client : clients) setting.bytes += client->bytes();
}

double milliseconds(Nanoseconds t) { return static_cast<double>(t.count()) * 1e-6; }

}  // namespace

int main(int argc, char** argv) {
  const std::string address = argc > 1 ? argv[1] : "sim:apartment";
  app::WorkloadOptions options;
  options.frames = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 120;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 6;
  auto source = open_source(address);
  if (!source) {
    fmt::print(stderr, "swiftlet_view_cost: {}\n", source.error().text());
    return 1;
  }
  const auto workload = app::read_workload(**source, options);
  if (!workload) {
    fmt::print(stderr, "swiftlet_view_cost: {}\n", workload.error().text());
    return 1;
  }
  MapperConfig config;
  config.map.voxel_m = 0.1;
  config.depth.max_range_m = workload->max_range_m;
  config.sensor.baseline_m = workload->baseline_m;
  std::vector<Setting> settings{{"no view", 0, false},
                                {"view, nobody looks", 0},
                                {"1 client", 1},
                                {"4 clients, 1 stalled", 4},
                                {"16 clients, 1 stalled", 16}};
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < settings.size(); ++k) {
      fly(*workload, config, settings[(k + round) % settings.size()]);
      fmt::print(stderr, "\rround {} of {}", round + 1, rounds);
    }
  }
  fmt::print(stderr, "\n");
  fmt::print("{}{}", app::machine_text(app::this_machine()), app::workload_text(*workload));
  fmt::print("\n{:<24} {:>7}", "setting", "frames");
  for (const char* clock : {"wall", "cpu"}) {
    fmt::print(" {:>11} {:>8} {:>8} {:>8}", fmt::format("{} median", clock), "vs none", "p99",
               "vs none");
  }
  fmt::print(" {:>10}\n", "kB/s sent");
  for (const Setting& s : settings) {
    fmt::print("{:<24} {:>7}", s.name, s.times.size());
    const Setting& none = settings.front();
    for (const auto& [times, base] :
         {std::pair{&s.times, &none.times}, {&s.cpu_times, &none.cpu_times}}) {
      for (const double share : {0.5, 0.99}) {
        const double ms = milliseconds(app::percentile(*times, share));
        const double base_ms = milliseconds(app::percentile(*base, share));
        fmt::print(" {:>{}.3f} {:>+7.1f}%", ms, share < 0.9 ? 11 : 8, 100.0 * (ms / base_ms - 1.0));
      }
    }
    fmt::print(" {:>10.1f}\n", 1e-3 * static_cast<double>(s.bytes) / s.elapsed_s);
  }
  return 0;
}
