// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/ply_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace swiftlet::sim {
namespace {

constexpr const char* kHeaderEnd =
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty uchar "
    "red\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string ascii_square() {
  return std::string("ply\nformat ascii 1.0\ncomment a square\n") + kHeaderEnd +
         "0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0.5 255\n4 0 1 2 3\n";
}

template <class T>
void put(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof value);
  bytes.append(raw.data(), raw.size());
}

std::string binary_square() {
  std::string bytes = std::string("ply\nformat binary_little_endian 1.0\n") + kHeaderEnd;
  for (const auto& [x, y, z] :
       {std::array{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.5}}) {
    put(bytes, x);
    put(bytes, y);
    put(bytes, z);
    put(bytes, std::uint8_t{255});
  }
  put(bytes, std::uint8_t{4});
  for (std::int32_t corner = 0; corner < 4; ++corner) put(bytes, corner);
  return bytes;
}

Expected<TriangleMesh> read(const std::string& bytes) {
  std::istringstream in(bytes);
  return read_ply(in, "test.ply");
}

TEST(PlyReader, reads_text_and_binary_alike_and_splits_polygons) {
  for (const std::string& bytes : {ascii_square(), binary_square()}) {
    const auto mesh = read(bytes);
    ASSERT_TRUE(mesh) << mesh.error().text();
    ASSERT_EQ(mesh->vertices_m.size(), 4U);
    EXPECT_EQ(mesh->vertices_m[3], Eigen::Vector3f(0, 1, 0.5));
    const std::vector<std::array<std::uint32_t, 3>> expected{{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(mesh->triangles, expected);
  }
}

TEST(PlyReader, refuses_a_file_cut_at_any_byte) {
  const std::string whole = binary_square();
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(read(whole.substr(0, length))) << "cut to " << length;
}

TEST(PlyReader, refuses_counts_that_the_file_cannot_hold_at_once) {
  const auto with = [](std::string text, std::string_view from, std::string_view by) {
    const auto mesh = read(text.replace(text.find(from), from.size(), by));
    return mesh ? std::string("none") : mesh.error().text();
  };
  const std::string endless = "element foo 18446744073709551615\nelement vertex 4";
  EXPECT_NE(with(ascii_square(), "element vertex 4", endless).find("'foo' has no properties"),
            std::string::npos);
  for (const std::string& text : {ascii_square(), binary_square()}) {
    EXPECT_NE(with(text, "vertex 4", "vertex 4000000000").find("cannot do"), std::string::npos);
    EXPECT_NE(with(text, "face 1", "face 99999").find("cannot do"), std::string::npos);
  }
}

TEST(PlyReader, refuses_what_makes_no_sense) {
  const auto with = [](std::string_view from, std::string_view by) {
    std::string text = ascii_square();
    return read(text.replace(text.find(from), from.size(), by));
  };
  EXPECT_FALSE(with("4 0 1 2 3", "4 0 1 2 4")) << "no such corner";
  EXPECT_FALSE(with("4 0 1 2 3", "4 0 1 2 -1"));
  EXPECT_FALSE(with("1 1 0 255", "1 nan 0 255"));
  EXPECT_FALSE(with("property double y", "property double w"));
  EXPECT_FALSE(with("property double y", "property quad y"));
  EXPECT_FALSE(with("element vertex 4", "element vertex many"));
  EXPECT_EQ(with("ascii", "binary_big_endian").error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace swiftlet::sim
