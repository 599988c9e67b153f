// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Depth out of messages that are no plain images: packed ones and clouds. Those that others have
// written: tests/peers.

#include "swiftlet/source/bag/depth_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "support/bag_writer.hpp"
#include "support/png_writer.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/source/bag/compressed_depth.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 24, kHeight = 16;
constexpr float kUnit_m = 0.001F;
constexpr Stamp kStamp{1'500'000'000'000'000'007};

/// As decode_depth() tells of a message of ROS 1.
tl::expected<DecodedDepth, std::string> decoded(const std::string& type, const std::string& bytes) {
  const BagConnection connection{.id = 0, .topic = "/d", .type = type};
  return decode_depth({&connection, Stamp{}, std::as_bytes(std::span(bytes)), 0}, kUnit_m);
}

std::string compressed(std::string_view format, const std::string& data) {
  return test::Bytes().header(0, kStamp, "optical").string(format).string(data).text();
}

Image<std::uint16_t> relief(test::Random& random) {
  Image<std::uint16_t> image(kWidth, kHeight);
  for (std::uint16_t& z : image.pixels())
    z = random.chance(0.3) ? std::uint16_t{0} : random.integer<std::uint16_t>(300, 9000);
  return image;
}

std::string png_of(const Image<std::uint16_t>& image, test::PngKind kind = test::PngKind::kGrey16) {
  const test::TempFolder folder;
  test::write_png(folder / "x.png", image, kind);
  return test::content_of(folder / "x.png");
}

/// What image_transport writes before the PNG or RVL.
std::string config(float a = 0.0F, float b = 0.0F) {
  return test::Bytes().add(std::int32_t{0}).add(a).add(b).text();
}

/// As the encoder of Wilson's paper, in steps as plain as they come.
std::string rvl_of(const Image<std::uint16_t>& image) {
  std::vector<std::uint32_t> groups;
  const auto put = [&](std::uint32_t value) {
    do {
      groups.push_back((value & 7U) | (value > 7U ? 8U : 0U));
      value >>= 3U;
    } while (value != 0);
  };
  const auto pixels = image.pixels();
  std::int32_t previous = 0;
  for (std::size_t at = 0; at < pixels.size();) {
    std::size_t zeros = 0, readings = 0;
    while (at + zeros < pixels.size() && pixels[at + zeros] == 0) ++zeros;
    at += zeros;
    while (at + readings < pixels.size() && pixels[at + readings] != 0) ++readings;
    put(static_cast<std::uint32_t>(zeros));
    put(static_cast<std::uint32_t>(readings));
    for (const std::size_t end = at + readings; at < end; ++at) {
      const std::int32_t delta = pixels[at] - previous;
      put(static_cast<std::uint32_t>(delta >= 0 ? 2 * delta : -2 * delta - 1));
      previous = pixels[at];
    }
  }
  while (groups.size() % 8 != 0) groups.push_back(0);
  test::Bytes bytes;
  bytes.add(static_cast<std::uint32_t>(image.width()));
  bytes.add(static_cast<std::uint32_t>(image.height()));
  for (std::size_t i = 0; i < groups.size(); i += 8) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 8; ++k) word = word << 4U | groups[i + k];
    bytes.add(word);
  }
  return bytes.text();
}

void expect_same(const Image<std::uint16_t>& a, const Image<std::uint16_t>& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  for (std::size_t i = 0; i < a.pixels().size(); ++i) ASSERT_EQ(a.pixels()[i], b.pixels()[i]) << i;
}

TEST(CompressedDepth, of_every_packing_gives_the_pixels_that_were_packed) {
  test::for_each_seed(20, [](test::Random& random) {
    const auto image = relief(random);
    for (const auto& [format, data] : std::vector<std::pair<std::string, std::string>>{
             {"16UC1; compressedDepth png", config() + png_of(image)},
             {"16UC1; compressedDepth", config() + png_of(image)},
             {"16UC1; compressedDepth rvl", config() + rvl_of(image)},
             {"16UC1; png compressed ", png_of(image)},
             {"png", png_of(image)}}) {
      const auto depth = decoded("sensor_msgs/CompressedImage", compressed(format, data));
      ASSERT_TRUE(depth) << format << ": " << depth.error();
      EXPECT_EQ(depth->stamp, kStamp);
      EXPECT_EQ(depth->depth.unit_m, kUnit_m);
      expect_same(depth->depth.raw, image);
    }
  });
}

TEST(CompressedDepth, in_metres_comes_out_as_near_as_its_quantisation_allows) {
  // image_transport's own: q = a / z + b with z0 = 100 and a farthest reading of 10 m.
  constexpr float kZ0 = 100.0F, kFarthest_m = 10.0F;
  const float a = kZ0 * (kZ0 + 1.0F), b = 1.0F - a / kFarthest_m;
  Image<std::uint16_t> quantised(kWidth, kHeight);
  std::vector<float> z_m(quantised.pixels().size());
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    z_m[i] = i % 5 == 0 ? 0.0F : 0.4F + 0.02F * static_cast<float>(i);
    quantised.pixels()[i] = static_cast<std::uint16_t>(z_m[i] == 0.0F ? 0.0F : a / z_m[i] + b);
  }
  const auto depth =
      decoded("sensor_msgs/CompressedImage",
              compressed("32FC1; compressedDepth png", config(a, b) + png_of(quantised)));
  ASSERT_TRUE(depth) << depth.error();
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    const float got_m = static_cast<float>(depth->depth.raw.pixels()[i]) * kUnit_m;
    ASSERT_NEAR(got_m, z_m[i], kUnit_m + z_m[i] * z_m[i] / a) << i;
  }
}

TEST(CompressedDepth, that_is_a_picture_is_no_depth) {
  const auto image = Image<std::uint16_t>(kWidth, kHeight, 2000);
  for (const auto& [format, data] : std::vector<std::pair<std::string, std::string>>{
           {"bgr8; jpeg compressed bgr8", "\xff\xd8\xff"},
           {"rgb8; png compressed bgr8", png_of(image, test::PngKind::kRgb8)},
           {"mono8; png compressed ", png_of(image, test::PngKind::kGrey8)}}) {
    EXPECT_THAT(decoded("sensor_msgs/CompressedImage", compressed(format, data)).error(),
                HasSubstr("is not depth"))
        << format;
  }
}

TEST(CompressedDepth, cut_anywhere_or_full_of_noise_does_no_harm) {
  test::Random random(7);
  const auto image = relief(random);
  for (const std::string& data : {config() + rvl_of(image), config() + png_of(image)}) {
    for (std::size_t bytes = 0; bytes + 4 < data.size(); ++bytes)
      EXPECT_FALSE(decoded("sensor_msgs/CompressedImage",
                           compressed("16UC1; compressedDepth", data.substr(0, bytes))))
          << bytes;
    test::for_each_seed(200, [&](test::Random& noise) {
      std::string noisy = data;
      for (int i = 0; i < 6; ++i)
        noisy[noise.integer<std::size_t>(0, noisy.size() - 1)] =
            static_cast<char>(noise.integer(0, 255));
      (void)decoded("sensor_msgs/CompressedImage", compressed("16UC1; compressedDepth", noisy));
    });
  }
}

TEST(Rvl, that_claims_more_pixels_than_it_can_hold_is_refused_at_once) {
  const auto refusal = [](std::uint32_t width, std::uint32_t height) {
    const std::string bytes = test::Bytes().add(width).add(height).zeros(64).text();
    return decode_rvl(std::as_bytes(std::span(bytes))).error();
  };
  EXPECT_THAT(refusal(16384, 16384), HasSubstr("too few"));
  EXPECT_THAT(refusal(~0U, 1), HasSubstr("cannot be"));
  EXPECT_THAT(refusal(0, 5), HasSubstr("cannot be"));
}

/// An organised cloud of a wall that leans, seen by a pinhole camera of focal length f.
std::string cloud_message(double f_px, bool is_big_endian = false, double shift_m = 0.0) {
  constexpr std::uint32_t kPointStep = 16;
  test::Bytes fields, points;
  for (const auto& [name, offset] :
       std::vector<std::pair<std::string, std::uint32_t>>{{"x", 0}, {"y", 4}, {"z", 8}})
    fields.string(name).add(offset).add(std::uint8_t{7}).add(std::uint32_t{1});
  const auto put = [&](double value) {
    auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    if (is_big_endian) bits = __builtin_bswap32(bits);
    points.add(bits);
  };
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const bool is_hole = u == 3;
      const double z = is_hole ? std::numeric_limits<double>::quiet_NaN() : 1.0 + 0.05 * (u + v);
      put((u - 11.5) / f_px * z + shift_m);
      put((v - 7.5) / f_px * z);
      put(z);
      put(0.0);
    }
  }
  return test::Bytes()
      .header(0, kStamp, "optical")
      .add(std::uint32_t{kHeight})
      .add(std::uint32_t{kWidth})
      .add(std::uint32_t{3})
      .raw(fields.text())
      .add(static_cast<std::uint8_t>(is_big_endian ? 1 : 0))
      .add(kPointStep)
      .add(kPointStep * kWidth)
      .string(points.text())
      .add(std::uint8_t{0})
      .text();
}

TEST(CloudDepth, gives_the_depth_of_its_points_and_the_camera_that_saw_them) {
  for (const bool is_big_endian : {false, true}) {
    const auto depth = decoded("sensor_msgs/PointCloud2", cloud_message(20.0, is_big_endian));
    ASSERT_TRUE(depth) << depth.error();
    EXPECT_EQ(depth->stamp, kStamp);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u)
        EXPECT_EQ(depth->depth.raw.at(u, v), u == 3 ? 0 : std::lround(1000 + 50 * (u + v)));
    }
    ASSERT_TRUE(depth->camera);
    EXPECT_NEAR(depth->camera->K[0], 20.0, 1e-3);
    EXPECT_NEAR(depth->camera->K[4], 20.0, 1e-3);
    EXPECT_NEAR(depth->camera->K[2], 11.5, 1e-3);
    EXPECT_NEAR(depth->camera->K[5], 7.5, 1e-3);
  }
}

TEST(CloudDepth, of_points_that_were_moved_into_another_frame_is_refused) {
  EXPECT_THAT(decoded("sensor_msgs/PointCloud2", cloud_message(20.0, false, 2.0)).error(),
              HasSubstr("optical frame"));
}

TEST(CloudDepth, cut_anywhere_or_full_of_noise_does_no_harm) {
  const std::string whole = cloud_message(20.0);
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += 7)
    EXPECT_FALSE(decoded("sensor_msgs/PointCloud2", whole.substr(0, bytes))) << bytes;
  test::for_each_seed(300, [&](test::Random& random) {
    std::string noisy = whole;
    for (int i = 0; i < 6; ++i)
      noisy[random.integer<std::size_t>(0, 120)] = static_cast<char>(random.integer(0, 255));
    (void)decoded("sensor_msgs/PointCloud2", noisy);
  });
}

TEST(DepthTopics, of_every_transport_lead_to_the_same_camera_info) {
  for (const char* way : {"", "/compressedDepth", "/compressed"})
    EXPECT_EQ(camera_info_beside(std::string("/cam/depth/image_raw") + way),
              "/cam/depth/camera_info");
}

}  // namespace
}  // namespace swiftlet
