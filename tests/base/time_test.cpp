// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/time.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

TEST(ParseStamp, gives_back_every_nanosecond_that_was_written) {
  test::for_each_seed(2000, [](test::Rng& rng) {
    const std::int64_t s = test::uniform_integer<std::int64_t>(rng, 0, 9'000'000'000);
    const std::int64_t ns = test::uniform_integer<std::int64_t>(rng, 0, 999'999'999);
    const auto stamp = parse_stamp(fmt::format("{}.{:09}", s, ns));
    ASSERT_TRUE(stamp) << stamp.error().text();
    EXPECT_EQ(stamp->ns, s * 1'000'000'000 + ns);
  });
}

TEST(ParseStamp, is_exact_where_a_double_is_not) {
  // 1305031102.175304 has no double; the nearest is off by tens of nanoseconds.
  EXPECT_EQ(parse_stamp("1305031102.175304").value().ns, 1305031102175304000);
  EXPECT_EQ(parse_stamp("1305031102.175304123").value().ns, 1305031102175304123);
}

TEST(ParseStamp, reads_short_and_long_fractions_and_negative_times) {
  EXPECT_EQ(parse_stamp("0").value().ns, 0);
  EXPECT_EQ(parse_stamp("12").value().ns, 12'000'000'000);
  EXPECT_EQ(parse_stamp("12.").value().ns, 12'000'000'000);
  EXPECT_EQ(parse_stamp("0.5").value().ns, 500'000'000);
  EXPECT_EQ(parse_stamp("0.0000000019").value().ns, 1) << "digits beyond nanoseconds are dropped";
  EXPECT_EQ(parse_stamp("-0.25").value().ns, -250'000'000);
}

TEST(ParseStamp, refuses_what_is_no_decimal_number_of_seconds) {
  for (const char* text :
       {"", "-", ".", ".5", "--1", "+1", "1e9", "1.2.3", "1,5", "nan", "inf", " 1", "1 ", "0x10",
        "1.-5", "9000000001", "99999999999999999999999999"}) {
    const auto stamp = parse_stamp(text);
    ASSERT_FALSE(stamp) << "'" << text << "'";
    EXPECT_EQ(stamp.error().code, ErrorCode::kCorruptInput);
  }
}

TEST(Stamp, differences_and_sums_are_inverse) {
  test::for_each_seed(200, [](test::Rng& rng) {
    const Stamp a{test::uniform_integer<std::int64_t>(rng, -1'000'000, 1'000'000)};
    const Stamp b{test::uniform_integer<std::int64_t>(rng, -1'000'000, 1'000'000)};
    EXPECT_EQ(a + (b - a), b);
    EXPECT_EQ(b - (b - a), a);
    EXPECT_EQ(a<b, (b - a).count()> 0);
  });
}

}  // namespace
}  // namespace swiftlet
