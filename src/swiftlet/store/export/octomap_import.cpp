// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/export/octomap_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>
#include <utility>

#include "swiftlet/file/file_content.hpp"

namespace swiftlet {
namespace {

constexpr int kDepth = 16;  // levels of an OctoMap tree, hence 65536 voxels along each axis
constexpr std::int32_t kEdge = 1 << kDepth;
constexpr std::size_t kColourBytes = 3;  // what a node of a ColorOcTree has besides its log-odds
constexpr std::string_view kBinaryLine = "# Octomap OcTree binary file";
constexpr std::string_view kFullLine = "# Octomap OcTree file";

struct Header {
  bool is_binary = false;  // .bt: two bits a child; .ot: a float a node
  std::string kind;
  std::uint64_t nodes = 0;
  double voxel_m = 0.0;
};

Expected<Header> read_header(std::istream& in, const std::string& where) {
  Header header;
  std::string line;
  std::getline(in, line);
  header.is_binary = line.starts_with(kBinaryLine);
  if (!header.is_binary && !line.starts_with(kFullLine)) {
    return fail(ErrorCode::kCorruptInput, where, "this is not an OctoMap file");
  }
  while (std::getline(in, line) && line != "data") {
    std::istringstream words(line);
    words.imbue(std::locale::classic());  // the caller's may have a decimal comma
    std::string key;
    words >> key;
    if (key == "id") words >> header.kind;
    if (key == "size") words >> header.nodes;
    if (key == "res") words >> header.voxel_m;
  }
  const bool has_colour = header.kind == "ColorOcTree" && !header.is_binary;
  if (header.kind != "OcTree" && !has_colour) {
    return fail(ErrorCode::kUnsupported, where,
                fmt::format("trees of kind '{}' are not read", header.kind));
  }
  if (!in || !std::isfinite(header.voxel_m) || header.voxel_m <= 0.0) {
    return fail(ErrorCode::kCorruptInput, where, "the header of the OctoMap file is incomplete");
  }
  return header;
}

class TreeReader {
 public:
  TreeReader(std::istream& in, const Header& header, const VisitLeaf& visit)
      : in_(in), header_(header), visit_(visit) {
    summary_.kind = header.kind;
    summary_.voxel_m = header.voxel_m;
  }

  /// False if the data end early, go too deep or hold more nodes than the header says.
  [[nodiscard]] bool read() {
    if (header_.nodes == 0) return true;
    const OctomapLeaf root{{-kEdge / 2, -kEdge / 2, -kEdge / 2}, kEdge, false, 0.0F};
    const bool is_whole = header_.is_binary ? read_binary(root) : read_full(root);
    return is_whole && summary_.nodes == header_.nodes;
  }
  [[nodiscard]] OctomapSummary take_summary() { return std::move(summary_); }

 private:
  [[nodiscard]] bool read_byte(unsigned& byte) {
    const int c = in_.get();
    byte = static_cast<unsigned>(c);
    return c != std::istream::traits_type::eof();
  }

  [[nodiscard]] static OctomapLeaf child_of(const OctomapLeaf& parent, int i) {
    const std::int32_t half = parent.edge / 2;
    const auto shift = [&](int bit) { return (i >> bit & 1) * half; };
    const VoxelIndex& f = parent.first;
    return {{f.x + shift(0), f.y + shift(1), f.z + shift(2)}, half, false, 0.0F};
  }

  void emit(const OctomapLeaf& leaf) {
    ++summary_.leaves;
    (leaf.is_occupied ? summary_.occupied_voxels : summary_.free_voxels) += leaf.voxels();
    const std::int32_t last = leaf.edge - 1;
    const VoxelIndex& f = leaf.first;
    if (!summary_.bounds) summary_.bounds = VoxelBox{f, f};
    auto& [low, high] = *summary_.bounds;
    low = {std::min(low.x, f.x), std::min(low.y, f.y), std::min(low.z, f.z)};
    high = {std::max(high.x, f.x + last), std::max(high.y, f.y + last),
            std::max(high.z, f.z + last)};
    if (visit_) visit_(leaf);
  }

  /// .bt: an inner node is two bytes, two bits a child: 1 free, 2 occupied, 3 inner, 0 unknown; its
  /// inner children follow. Recursion ends at the depth of the tree.
  [[nodiscard]] bool read_binary(const OctomapLeaf& node) {
    unsigned low = 0;
    unsigned high = 0;
    if (node.edge < 2 || ++summary_.nodes > header_.nodes) return false;
    if (!read_byte(low) || !read_byte(high)) return false;
    const unsigned bits = low | high << 8;
    const auto state = [&](int i) { return bits >> (2 * i) & 3U; };
    for (int i = 0; i < 8; ++i) {
      if (state(i) != 1U && state(i) != 2U) continue;
      OctomapLeaf leaf = child_of(node, i);
      leaf.is_occupied = state(i) == 2U;
      ++summary_.nodes;
      emit(leaf);
    }
    for (int i = 0; i < 8; ++i) {
      if (state(i) == 3U && !read_binary(child_of(node, i))) return false;
    }
    return true;
  }

  /// .ot: a node is its log-odds (float, little endian), colour if it has one, and a byte with one
  /// bit a child; its children follow.
  [[nodiscard]] bool read_full(OctomapLeaf node) {
    unsigned raw = 0;
    if (node.edge < 1 || ++summary_.nodes > header_.nodes) return false;
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (!read_byte(raw)) return false;
      word |= raw << (8 * i);
    }
    node.log_odds = std::bit_cast<float>(word);
    node.is_occupied = node.log_odds >= 0.0F;
    const std::size_t colour = header_.kind == "ColorOcTree" ? kColourBytes : 0;
    for (std::size_t i = 0; i < colour; ++i) {
      if (!read_byte(raw)) return false;
    }
    unsigned children = 0;
    if (!read_byte(children)) return false;
    if (children == 0) emit(node);
    for (int i = 0; i < 8; ++i) {
      if ((children >> i & 1U) != 0 && !read_full(child_of(node, i))) return false;
    }
    return true;
  }

  std::istream& in_;
  const Header& header_;
  const VisitLeaf& visit_;
  OctomapSummary summary_;
};

}  // namespace

Expected<OctomapSummary> read_octomap(const std::filesystem::path& path, const VisitLeaf& visit) {
  if (auto usable = check_regular_file(path); !usable) return forward_error(std::move(usable));
  std::ifstream in(path, std::ios::binary);
  if (!in) return fail(ErrorCode::kNotFound, path.string(), "the file cannot be opened");
  auto header = read_header(in, path.string());
  if (!header) return forward_error(std::move(header));
  TreeReader reader(in, *header, visit);
  if (!reader.read()) {
    return fail(ErrorCode::kCorruptInput, path.string(),
                "the tree is damaged or cut off: it is not of the size that the header says");
  }
  return reader.take_summary();
}

}  // namespace swiftlet
