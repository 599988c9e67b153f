// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/depth_png.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/png_writer.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet {
namespace {

using test::PngKind;
using ::testing::HasSubstr;

Image<std::uint16_t> noise(test::Random& random, int width, int height) {
  Image<std::uint16_t> image(width, height);
  for (auto& pixel : image.pixels()) pixel = random.integer<std::uint16_t>(0, 65535);
  return image;
}

class DepthPng : public ::testing::Test {
 protected:
  test::TempFolder folder_;
  std::filesystem::path file_ = folder_ / "depth.png";
  test::Random rng_{1};

  [[nodiscard]] Error error_of_reading() const {
    const auto depth = read_depth_png(file_, {});
    EXPECT_FALSE(depth);
    const Error error = depth ? Error{} : depth.error();
    EXPECT_THAT(error.where, HasSubstr("depth.png"));
    return error;
  }
};

TEST_F(DepthPng, gives_back_every_value_of_every_size) {
  for (const PngKind kind :
       {PngKind::kGrey16, PngKind::kGrey16Interlaced, PngKind::kGrey16WithGamma}) {
    test::for_each_seed(20, [&](test::Random& random) {
      const auto image = noise(random, random.integer(1, 40), random.integer(1, 40));
      test::write_png(file_, image, kind);
      const auto depth = read_depth_png(file_, {.unit_m = 0.0002F});
      ASSERT_TRUE(depth) << depth.error().text();
      EXPECT_EQ(depth->raw.width(), image.width());
      EXPECT_EQ(depth->raw.height(), image.height());
      EXPECT_TRUE(std::ranges::equal(depth->raw.pixels(), image.pixels()));
      EXPECT_EQ(depth->unit_m, 0.0002F);
    });
  }
}

TEST_F(DepthPng, turns_full_scale_into_no_reading_only_if_told_so) {
  Image<std::uint16_t> image(2, 1, 65535);
  image.at(1, 0) = 65534;
  test::write_png(file_, image);
  const auto kept = read_depth_png(file_, {.is_full_scale_invalid = false});
  const auto dropped = read_depth_png(file_, {.is_full_scale_invalid = true});
  EXPECT_THAT(kept->raw.pixels(), ::testing::ElementsAre(65535, 65534));
  EXPECT_THAT(dropped->raw.pixels(), ::testing::ElementsAre(0, 65534));
}

TEST_F(DepthPng, refuses_every_other_kind_of_png_by_name) {
  const std::pair<PngKind, const char*> kinds[] = {
      {PngKind::kGrey8, "8-bit greyscale PNG"},
      {PngKind::kGreyAlpha16, "16-bit greyscale with alpha PNG"},
      {PngKind::kRgb8, "8-bit RGB PNG"},
      {PngKind::kRgb16, "16-bit RGB PNG"},
      {PngKind::kPalette8, "8-bit palette PNG"},
  };
  for (const auto& [kind, name] : kinds) {
    test::write_png(file_, noise(rng_, 8, 8), kind);
    const Error error = error_of_reading();
    EXPECT_EQ(error.code, ErrorCode::kUnsupported) << name;
    EXPECT_THAT(error.what, HasSubstr(name));
    EXPECT_THAT(error.remedy, HasSubstr("16-bit greyscale"));
  }
}

TEST_F(DepthPng, cut_short_anywhere_is_an_error) {
  test::write_png(file_, noise(rng_, 9, 7));
  const std::string whole = test::content_of(file_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::write_file(file_, std::string_view(whole).substr(0, size));
    EXPECT_EQ(error_of_reading().code, ErrorCode::kCorruptInput) << size << " of " << whole.size();
  }
}

TEST_F(DepthPng, cut_short_at_every_sixteenth_of_a_full_sized_image_is_an_error) {
  for (const PngKind kind : {PngKind::kGrey16, PngKind::kGrey16Interlaced}) {
    test::write_png(file_, noise(rng_, 640, 480), kind);
    const std::string whole = test::content_of(file_);
    for (std::size_t part = 0; part < 16; ++part) {
      test::write_file(file_, std::string_view(whole).substr(0, whole.size() * part / 16));
      EXPECT_EQ(error_of_reading().code, ErrorCode::kCorruptInput) << part << "/16";
    }
  }
}

TEST_F(DepthPng, with_a_flipped_bit_in_its_image_data_is_an_error) {
  test::write_png(file_, noise(rng_, 9, 7));
  const std::string whole = test::content_of(file_);
  const std::size_t data = whole.find("IDAT");
  const std::size_t end = whole.find("IEND") - 4;
  for (std::size_t byte = data; byte < end; ++byte) {
    std::string flipped = whole;
    flipped[byte] = static_cast<char>(flipped[byte] ^ 0x10);
    test::write_file(file_, flipped);
    EXPECT_EQ(error_of_reading().code, ErrorCode::kCorruptInput) << "byte " << byte;
  }
}

TEST_F(DepthPng, of_impossible_size_is_refused_before_its_pixels_are_allocated) {
  test::write_png(file_, noise(rng_, 8, 8));
  const std::string good = test::content_of(file_);
  const std::pair<std::uint32_t, std::uint32_t> sizes[] = {
      {0, 8},          {8, 0},        {16385, 8}, {8, 16385}, {0x7FFFFFFF, 0x7FFFFFFF},
      {0xFFFFFFFF, 1}, {16384, 16384}};
  for (const auto& [width, height] : sizes) {
    test::write_file(file_, good);
    test::declare_png_size(file_, width, height);
    EXPECT_EQ(error_of_reading().code, ErrorCode::kCorruptInput) << width << " x " << height;
  }
  // That the patched header is otherwise sound: its true size is still accepted.
  test::declare_png_size(file_, 8, 8);
  EXPECT_TRUE(read_depth_png(file_, {}));
}

TEST_F(DepthPng, that_is_missing_empty_a_folder_or_no_png_says_which) {
  EXPECT_EQ(error_of_reading().code, ErrorCode::kNotFound);
  test::write_file(file_, "");
  EXPECT_THAT(error_of_reading().what, HasSubstr("empty"));
  test::write_file(file_, "P5 640 480 65535 and so on");
  EXPECT_THAT(error_of_reading().what, HasSubstr("Not a PNG file"));
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  EXPECT_THAT(error_of_reading().what, HasSubstr("folder"));
}

/// A chunk with its right check sum.
std::string png_chunk(const std::string& name, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : name + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  const auto word = [](std::uint32_t value) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(value >> shift));
    return bytes;
  };
  return word(static_cast<std::uint32_t>(data.size())) + name + data + word(~crc);
}

TEST_F(DepthPng, passes_over_texts_and_profiles_whatever_they_hold) {
  const auto image = noise(rng_, 8, 8);
  test::write_png(file_, image);
  std::string bytes = test::content_of(file_);
  // Broken deflate in each: reading them would warn or fail, inflating them could take gigabytes.
  std::string texts;
  for (int i = 0; i < 2000; ++i) texts += png_chunk("zTXt", std::string("k\0\0x", 4));
  for (const char* name : {"iCCP", "iTXt", "tEXt", "sPLT", "eXIf", "tRNS", "prVt"})
    texts += png_chunk(name, std::string("k\0\0\0\0no deflate", 15));
  bytes.insert(33, texts);  // behind the header
  bytes.insert(bytes.find("IEND") - 4, texts);
  test::write_file(file_, bytes);
  const auto depth = read_depth_png(file_, {});
  ASSERT_TRUE(depth) << depth.error().text();
  EXPECT_TRUE(std::ranges::equal(depth->raw.pixels(), image.pixels()));
}

TEST_F(DepthPng, that_holds_far_more_bytes_than_its_pixels_take_is_refused) {
  test::write_png(file_, noise(rng_, 8, 8));
  std::string bytes = test::content_of(file_);
  bytes.insert(33, png_chunk("tEXt", std::string(std::size_t{5} << 20, 'x')));
  test::write_file(file_, bytes);
  EXPECT_THAT(error_of_reading().what, HasSubstr("too many for 8 x 8 pixels"));
}

TEST_F(DepthPng, of_more_pixels_than_any_depth_camera_has_is_refused_by_its_size) {
  test::write_png(file_, noise(rng_, 8, 8));
  test::declare_png_size(file_, 16384, 16384);
  std::string bytes = test::content_of(file_);
  bytes.insert(33, png_chunk("tEXt", std::string(1 << 20, 'x')));  // enough to hold as many
  test::write_file(file_, bytes);
  const Error error = error_of_reading();
  EXPECT_EQ(error.code, ErrorCode::kUnsupported);
  EXPECT_THAT(error.what, HasSubstr("16384 x 16384 pixels are more than"));
}

TEST_F(DepthPng, with_another_chunk_before_its_header_is_refused) {
  test::write_png(file_, noise(rng_, 8, 8));
  std::string bytes = test::content_of(file_);
  bytes.insert(8, png_chunk("prVt", "its size stands elsewhere"));
  test::write_file(file_, bytes);
  EXPECT_EQ(error_of_reading().code, ErrorCode::kCorruptInput);
}

}  // namespace
}  // namespace swiftlet
