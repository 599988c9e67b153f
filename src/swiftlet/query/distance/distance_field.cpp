// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/distance/distance_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <new>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

constexpr std::uint64_t kNeverRead = ~std::uint64_t{0};
constexpr int kMostReach_voxels = 255;
constexpr int kMostThreads = 64;

std::size_t count_of(int v) { return static_cast<std::size_t>(v); }

tl::unexpected<Error> impossible(const char* what, std::string remedy) {
  return fail(ErrorCode::kInvalidConfig, "distance field", what, std::move(remedy));
}

/// The least square that is out of reach. A reach of whole voxels stays one if it was divided with
/// a rounding error.
double cap_of(double max_distance_m, double voxel_m) {
  const double reach = max_distance_m / voxel_m;
  return std::floor(reach * reach * (1.0 + 1e-9)) + 1.0;
}

Status validate(double voxel_m, const BlockIndex& window, const DistanceFieldOptions& options) {
  if (!(voxel_m > 0.0) || !std::isfinite(voxel_m) || std::min({window.x, window.y, window.z}) < 1)
    return impossible("the map has no voxels", "give the voxel and window of a RollingMap");
  if (!(options.max_distance_m >= voxel_m) || !std::isfinite(options.max_distance_m))
    return impossible("max_distance_m is less than a voxel", "give at least the map's voxel_m");
  if (cap_of(options.max_distance_m, voxel_m) > kMostReach_voxels * kMostReach_voxels)
    return impossible("max_distance_m is more than 254 voxels",
                      fmt::format("give at most {:.3g} m", 254 * voxel_m));
  if (!options.occupied && !options.not_free)
    return impossible("it has no obstacles", "set occupied, not_free or both");
  if (!(options.size_m.minCoeff() >= 0.0) || !options.size_m.allFinite())
    return impossible("size_m is negative or not a number", "give 0 for the whole window");
  if (options.threads < 1 || options.threads > kMostThreads)
    return impossible("threads is not within 1 and 64", "give 1 unless cores are idle");
  return Done{};
}

BlockIndex box_size_of(double voxel_m, const BlockIndex& window, const Eigen::Vector3d& size_m) {
  const auto blocks = [&](double length_m, std::int32_t most) {
    if (length_m == 0.0) return most;
    const double wanted = std::ceil(length_m / (voxel_m * kBlockEdge) - 1e-9);
    return static_cast<std::int32_t>(std::clamp<double>(wanted, 1.0, most));
  };
  return {blocks(size_m.x(), window.x), blocks(size_m.y(), window.y), blocks(size_m.z(), window.z)};
}

ObstacleClasses unknown_classes(const OccupancyThresholds& thresholds) {
  VoxelBlock block;
  block.clear();
  return classes_of(block, thresholds);
}

bool overlap(const BlockWindow& a, const BlockWindow& b) {
  const auto meet = [&](std::int32_t BlockIndex::*axis) {
    return a.first.*axis < b.end().*axis && b.first.*axis < a.end().*axis;
  };
  return meet(&BlockIndex::x) && meet(&BlockIndex::y) && meet(&BlockIndex::z);
}

bool is_same(const std::weak_ptr<const void>& a, const std::weak_ptr<const void>& b) {
  return !a.owner_before(b) && !b.owner_before(a);
}

}  // namespace

Expected<DistanceField> DistanceField::create(double voxel_m, const BlockIndex& window_size,
                                              const DistanceFieldOptions& options) {
  if (auto valid = validate(voxel_m, window_size, options); !valid)
    return forward_error(std::move(valid));
  const BlockIndex box = box_size_of(voxel_m, window_size, options.size_m);
  try {
    const auto cap = static_cast<int>(cap_of(options.max_distance_m, voxel_m));
    return DistanceField(voxel_m, box, cap, options);
  } catch (const std::bad_alloc&) {
    return fail(
        ErrorCode::kOutOfMemory, "distance field",
        fmt::format("there is no memory for a box of {} x {} x {} blocks", box.x, box.y, box.z),
        "give a smaller size_m, or ask for one kind of obstacles only");
  }
}

DistanceField::DistanceField(double voxel_m, const BlockIndex& box_size, int cap,
                             const DistanceFieldOptions& options)
    : voxel_m_(voxel_m),
      options_(options),
      cap_(static_cast<std::uint16_t>(cap)),
      metres_(count_of(cap) + 1),
      unknown_(unknown_classes(options.thresholds)),
      grid_(box_size, distance_reach(cap)),
      versions_(grid_.block_places(), kNeverRead),
      team_(std::make_unique<WorkerTeam>(options.threads)),
      scratch_(count_of(options.threads)) {
  for (int s = 0; s < cap; ++s)
    metres_[count_of(s)] = static_cast<float>(std::sqrt(static_cast<double>(s)) * voxel_m);
  metres_[count_of(cap)] = static_cast<float>(options.max_distance_m);
  const int reach = distance_reach(cap);
  for (DistanceScratch& scratch : scratch_) {
    scratch.column.resize(count_of(grid_.slices() * DistanceGrid::kLanes));
    scratch.line.resize(count_of((grid_.vectors() + 2) * DistanceGrid::kLanes + 2 * reach));
  }
  const auto make = [&](Kind& kind, const ObstacleBits& unknown, bool is_asked) {
    const bool is_outside_obstacle = (unknown.rows[0] & 1U) != 0;
    kind.bits.assign(grid_.block_places(), unknown);
    if (is_asked) kind.layer.emplace(grid_, cap, DistanceTarget{false, is_outside_obstacle});
    if (is_asked && options.is_signed)
      kind.inside.emplace(grid_, cap, DistanceTarget{true, !is_outside_obstacle});
  };
  make(kinds_[0], unknown_.occupied, options.occupied);
  make(kinds_[1], unknown_.not_free, options.not_free);
}

template <class Visit>
void DistanceField::for_each_layer(Visit&& visit) {
  for (Kind& kind : kinds_) {
    if (kind.layer) visit(kind, *kind.layer);
    if (kind.inside) visit(kind, *kind.inside);
  }
}

void DistanceField::update(const MapSnapshot& map) {
  const BlockWindow& window = map.window();
  const BlockIndex& size = box().size;
  follow(map, {window.first.x + (window.size.x - size.x) / 2,
               window.first.y + (window.size.y - size.y) / 2,
               window.first.z + (window.size.z - size.z) / 2});
}

void DistanceField::update(const MapSnapshot& map, const Eigen::Vector3d& around_world) {
  SWIFTLET_REQUIRE(around_world.allFinite(), "a box is around a finite place");
  const BlockWindow& window = map.window();
  const auto first = [&](double around_m, std::int32_t BlockIndex::*axis) {
    const double wanted = around_m / (voxel_m_ * kBlockEdge) - 0.5 * (box().size.*axis);
    const std::int32_t last = std::max(window.first.*axis, window.end().*axis - box().size.*axis);
    const bool stays = has_map_ && std::abs(wanted - box().first.*axis) <= 0.75;
    const double next = stays ? box().first.*axis : std::round(wanted);
    return static_cast<std::int32_t>(std::clamp<double>(next, window.first.*axis, last));
  };
  follow(map, {first(around_world.x(), &BlockIndex::x), first(around_world.y(), &BlockIndex::y),
               first(around_world.z(), &BlockIndex::z)});
}

void DistanceField::follow(const MapSnapshot& map, const BlockIndex& first) {
  SWIFTLET_REQUIRE(map.voxel_m() == voxel_m_, "a distance field has the voxels of its map");
  const bool is_of_this_map = has_map_ && is_same(map_, map.map_identity());
  if (is_of_this_map && overlap(box(), {first, box().size})) {
    move_to(first);
  } else {
    forget(first);
    map_ = map.map_identity();
  }
  for (BlockIndex b = box().first; b.z < box().end().z; ++b.z) {
    for (b.y = box().first.y; b.y < box().end().y; ++b.y) {
      for (b.x = box().first.x; b.x < box().end().x; ++b.x)
        read_block(map, b, grid_.block_place(grid_.place_of(first_voxel(b))));
    }
  }
  for_each_layer(
      [&](Kind& kind, DistanceLayer& layer) { layer.update(grid_, kind.bits, *team_, scratch_); });
  has_map_ = true;
  frame_count_ = map.frame_count();
}

// Versions are of one map; and a box that has left its old place has nothing to keep.
void DistanceField::forget(const BlockIndex& first) {
  grid_.move_to(first);
  std::ranges::fill(versions_, kNeverRead);
  std::ranges::fill(kinds_[0].bits, unknown_.occupied);
  std::ranges::fill(kinds_[1].bits, unknown_.not_free);
  for_each_layer([&](Kind&, DistanceLayer& layer) { layer.clear(grid_); });
}

void DistanceField::move_to(const BlockIndex& first) {
  const BlockWindow before = box();
  if (before.first == first) return;
  for_each_block_outside(before, {first, before.size}, [&](const BlockIndex& leaving) {
    const std::size_t place = grid_.block_place(grid_.place_of(first_voxel(leaving)));
    versions_[place] = kNeverRead;
    kinds_[0].bits[place] = unknown_.occupied;
    kinds_[1].bits[place] = unknown_.not_free;
  });
  grid_.move_to(first);
  for_each_layer([&](Kind&, DistanceLayer& layer) { layer.move(before, grid_); });
}

void DistanceField::read_block(const MapSnapshot& map, const BlockIndex& index, std::size_t place) {
  const std::uint64_t version = map.version(index);
  if (versions_[place] == version) return;
  versions_[place] = version;
  const VoxelBlock* block = map.find(index);
  const ObstacleClasses classes =
      block == nullptr ? unknown_ : classes_of(*block, options_.thresholds);
  replace_bits(kinds_[0], place, classes.occupied, index);
  replace_bits(kinds_[1], place, classes.not_free, index);
}

void DistanceField::replace_bits(Kind& kind, std::size_t place, const ObstacleBits& bits,
                                 const BlockIndex& index) {
  // Eight slices of a word each, a byte a row.
  using Slices = std::array<std::uint64_t, kBlockEdge>;
  const auto before = std::bit_cast<Slices>(kind.bits[place]), now = std::bit_cast<Slices>(bits);
  std::uint64_t changed = 0;
  for (std::size_t z = 0; z < before.size(); ++z) changed |= before[z] ^ now[z];
  if (changed == 0) return;
  kind.bits[place] = bits;
  const auto rows = std::bit_cast<std::array<std::uint8_t, kBlockEdge>>(changed);
  const int vector = grid_.x_position(index.x) / DistanceGrid::kLanes;
  const int y = (index.y - box().first.y) * kBlockEdge;
  for (int i = 0; i < kBlockEdge; ++i) {
    if (rows[count_of(i)] == 0) continue;
    if (kind.layer) kind.layer->touch(vector, y + i);
    if (kind.inside) kind.inside->touch(vector, y + i);
  }
}

std::size_t DistanceField::memory_bytes() const {
  std::size_t bytes = versions_.size() * sizeof(std::uint64_t) + metres_.size() * sizeof(float);
  for (const Kind& kind : kinds_) {
    bytes += kind.bits.size() * sizeof(ObstacleBits);
    if (kind.layer) bytes += kind.layer->memory_bytes();
    if (kind.inside) bytes += kind.inside->memory_bytes();
  }
  return bytes;
}

}  // namespace swiftlet
