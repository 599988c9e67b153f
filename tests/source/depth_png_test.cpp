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

Image<std::uint16_t> noise(test::Rng& rng, int width, int height) {
  Image<std::uint16_t> image(width, height);
  for (auto& pixel : image.pixels()) pixel = test::uniform_integer<std::uint16_t>(rng, 0, 65535);
  return image;
}

class DepthPng : public ::testing::Test {
 protected:
  test::TempFolder folder_;
  std::filesystem::path file_ = folder_ / "depth.png";
  test::Rng rng_{1};

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
    test::for_each_seed(20, [&](test::Rng& rng) {
      const auto image =
          noise(rng, test::uniform_integer(rng, 1, 40), test::uniform_integer(rng, 1, 40));
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

}  // namespace
}  // namespace swiftlet
