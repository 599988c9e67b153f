// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// What a distance field costs in flight: swiftlet_distance_bench [SOURCE [FRAMES]]
//
// Maps a source in voxels of 10 and 5 cm, in the default window, moves included, and after every
// frame brings up to date a field for each kind of obstacles; beside it, now and then, one from
// scratch, and, where it is installed, dynamicEDT3D (Lau et al. 2013) on the same frames. That one
// has no moving window: it keeps the box where the window was first, and what leaves the window
// stays as it is. Times are of the processor and of one thread, so that what others do on a busy
// machine counts little.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#if SWIFTLET_HAS_EDT3D
#include <dynamicEDT3D/dynamicEDT3D.h>  // its own header lacks <cstdint>
#endif

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

using namespace swiftlet;

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <class Work>
void time(std::vector<double>& times_ms, Work&& work) {
  const double begin = cpu_ms();
  work();
  times_ms.push_back(cpu_ms() - begin);
}

double quantile(std::vector<double> times_ms, double q) {
  if (times_ms.empty()) return 0.0;
  std::ranges::sort(times_ms);
  return times_ms[static_cast<std::size_t>(q * static_cast<double>(times_ms.size() - 1))];
}

struct Setting {
  double voxel_m, reach_m;
};

#if SWIFTLET_HAS_EDT3D
/// dynamicEDT3D on a box that does not move.
class Peer {
 public:
  Peer(const BlockWindow& box, int reach_voxels, Obstacles obstacles)
      : obstacles_(obstacles),
        box_(box),
        edt_(reach_voxels * reach_voxels),
        versions_(box.block_count(), 0),
        is_obstacle_(box.block_count() * kBlockVoxels, obstacles == Obstacles::kNotFree ? 1 : 0) {
    const VoxelBox v = voxel_box(box);
    edt_.initializeEmpty(v.last.x - v.first.x + 1, v.last.y - v.first.y + 1,
                         v.last.z - v.first.z + 1);
    if (obstacles == Obstacles::kOccupied) return;
    for_each_block(box, [&](const BlockIndex& b) {
      for (int i = 0; i < kBlockVoxels; ++i) set(voxel_at(b, i), true);
    });
    edt_.update();
  }

  void update(const MapSnapshot& map, const OccupancyThresholds& thresholds) {
    changes_.clear();
    std::size_t place = 0;
    for_each_block(box_, [&](const BlockIndex& b) {
      const std::size_t at = place++;
      if (!map.window().contains(b) || map.version(b) == versions_[at]) return;
      versions_[at] = map.version(b);
      for (int i = 0; i < kBlockVoxels; ++i) {
        const VoxelIndex v = voxel_at(b, i);
        const Occupancy state = thresholds.classify(map.log_odds(v));
        const bool is_obstacle = obstacles_ == Obstacles::kOccupied ? state == Occupancy::kOccupied
                                                                    : state != Occupancy::kFree;
        std::uint8_t& was = is_obstacle_[at * kBlockVoxels + static_cast<std::size_t>(i)];
        if ((was != 0) == is_obstacle) continue;
        was = is_obstacle ? 1 : 0;
        changes_.push_back({v, is_obstacle});
      }
    });
    time(times_ms, [&] {
      for (const Change& change : changes_) set(change.voxel, change.is_obstacle);
      edt_.update();
    });
  }

  [[nodiscard]] const BlockWindow& box() const { return box_; }
  [[nodiscard]] int squared(const VoxelIndex& v) const {
    const VoxelIndex first = first_voxel(box_.first);
    return edt_.getSQCellDistance(v.x - first.x, v.y - first.y, v.z - first.z);
  }

  std::vector<double> times_ms;

 private:
  struct Change {
    VoxelIndex voxel;
    bool is_obstacle;
  };
  void set(const VoxelIndex& v, bool is_obstacle) {
    const VoxelIndex first = first_voxel(box_.first);
    const int x = v.x - first.x, y = v.y - first.y, z = v.z - first.z;
    is_obstacle ? edt_.occupyCell(x, y, z) : edt_.clearCell(x, y, z);
  }

  Obstacles obstacles_;
  BlockWindow box_;
  DynamicEDT3D edt_;
  std::vector<std::uint64_t> versions_;
  std::vector<std::uint8_t> is_obstacle_;
  std::vector<Change> changes_;
};
#endif

/// One kind of obstacles in one setting.
struct Contest {
  Contest(Obstacles kind, const Setting& setting, const RollingMap& map)
      : obstacles(kind),
        options{.max_distance_m = setting.reach_m,
                .occupied = kind == Obstacles::kOccupied,
                .not_free = kind == Obstacles::kNotFree},
        field(make(map)) {}
  [[nodiscard]] DistanceField make(const RollingMap& map) const {
    return *DistanceField::create(map.voxel_m(), map.window().size, options);
  }

  void follow(const MapSnapshot& map, const RollingMap& rolling, bool is_also_from_scratch) {
    time(times_ms, [&] { field.update(map); });
    if (is_also_from_scratch) {
      DistanceField fresh = make(rolling);
      time(scratch_ms, [&] { fresh.update(map); });
    }
#if SWIFTLET_HAS_EDT3D
    if (!peer) {
      const double reach = options.max_distance_m / map.voxel_m();
      peer = std::make_unique<Peer>(map.window(), static_cast<int>(reach + 0.5), obstacles);
    }
    peer->update(map, options.thresholds);
#endif
  }

  void print(const Setting& setting) const {
    fmt::print("{:.2f} m, reach {:g} m, {:<9} {:7.3f} {:7.3f} {:7.3f}   {:8.2f}", setting.voxel_m,
               setting.reach_m, obstacles == Obstacles::kOccupied ? "occupied" : "not free",
               quantile(times_ms, 0.5), quantile(times_ms, 0.99), quantile(times_ms, 1.0),
               quantile(scratch_ms, 0.5));
#if SWIFTLET_HAS_EDT3D
    const double median = quantile(peer->times_ms, 0.5), most = quantile(peer->times_ms, 1.0);
    fmt::print("   {:8.2f} {:8.2f} {:8.2f}   {:6.1f} {:6.1f}", median,
               quantile(peer->times_ms, 0.99), most, median / quantile(times_ms, 0.5),
               most / quantile(times_ms, 1.0));
    fmt::print("   {} of {} voxels differ", differing(), kCompared);
#endif
    fmt::print("\n");
  }

#if SWIFTLET_HAS_EDT3D
  static constexpr int kCompared = 2000;
  /// Voxels in which the two disagree, of those that are within reach of no face of either box.
  [[nodiscard]] int differing() const {
    std::mt19937 random(1);
    const VoxelBox ours = voxel_box(field.box()), theirs = voxel_box(peer->box());
    const int reach = static_cast<int>(options.max_distance_m / field.voxel_m() + 0.5) + 1;
    const auto any = [&](int a_first, int b_first, int a_last, int b_last) {
      const int low = std::max(a_first, b_first) + reach, high = std::min(a_last, b_last) - reach;
      return std::uniform_int_distribution<int>(std::min(low, high), high)(random);
    };
    int count = 0;
    for (int i = 0; i < kCompared; ++i) {
      const VoxelIndex v{any(ours.first.x, theirs.first.x, ours.last.x, theirs.last.x),
                         any(ours.first.y, theirs.first.y, ours.last.y, theirs.last.y),
                         any(ours.first.z, theirs.first.z, ours.last.z, theirs.last.z)};
      const int at_most = (reach - 1) * (reach - 1), of_peer = peer->squared(v);
      const int of_ours = field.squared_voxels(v, obstacles).value_or(at_most);
      count += std::min(of_peer, at_most) == of_ours ? 0 : 1;
    }
    return count;
  }
  std::unique_ptr<Peer> peer;
#endif

  Obstacles obstacles;
  DistanceFieldOptions options;
  DistanceField field;
  std::vector<double> times_ms{}, scratch_ms{};
};

int run(const std::string& address, int frames, const Setting& setting) {
  auto source = open_source(address);
  MapperConfig config;
  config.map.voxel_m = setting.voxel_m;
  auto mapper = Mapper::create(config);
  if (!source || !mapper) {
    fmt::print(stderr, "{}\n", (source ? mapper.error() : source.error()).text());
    return 2;
  }
  std::vector<std::unique_ptr<Contest>> contests;
  for (const Obstacles kind : {Obstacles::kNotFree, Obstacles::kOccupied})
    contests.push_back(std::make_unique<Contest>(kind, setting, mapper->map()));
  int moves = 0, flown = 0;
  for (; flown < frames; ++flown) {
    const auto frame = (*source)->next();
    if (!frame || !*frame) break;
    moves += mapper->integrate(**frame).shift.moved ? 1 : 0;
    const auto map = mapper->snapshot();
    for (const auto& contest : contests) contest->follow(*map, mapper->map(), flown % 100 == 50);
  }
  fmt::print("\n{} frames, {} moves of the window\n", flown, moves);
  for (const auto& contest : contests) contest->print(setting);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string source = argc > 1 ? argv[1] : "sim:apartment";
  const int frames = argc > 2 ? std::atoi(argv[2]) : 700;
  fmt::print("milliseconds a frame        ours: median, p99, most   scratch   {}\n",
             SWIFTLET_HAS_EDT3D ? "dynamicEDT3D: median, p99, most   times slower: median, most"
                                : "(dynamicEDT3D is not installed)");
  for (const Setting& setting : {Setting{0.1, 2.0}, Setting{0.05, 1.0}})
    if (const int code = run(source, frames, setting); code != 0) return code;
  return 0;
}
