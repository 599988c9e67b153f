// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/file_content.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/temp_folder.hpp"
#include "swiftlet/file/text_encoding.hpp"

namespace swiftlet {
namespace {

using test::write_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

class FileContent : public ::testing::Test {
 protected:
  [[nodiscard]] std::string error_of(const std::filesystem::path& path,
                                     std::size_t most_bytes = 1 << 20) const {
    const auto content = read_text_file(path, most_bytes);
    return content ? "no error" : content.error().text();
  }
  test::TempFolder folder_;
};

TEST_F(FileContent, is_given_back_byte_for_byte) {
  const std::string bytes("\xEF\xBB\xBF\0\r\n\xFF", 7);
  write_file(folder_ / "any", bytes);
  EXPECT_EQ(read_file(folder_ / "any", 7), bytes);
  write_file(folder_ / "empty", "");
  EXPECT_EQ(read_file(folder_ / "empty", 0), "");
}

TEST_F(FileContent, of_a_text_comes_without_the_byte_order_mark_of_any_editor) {
  using namespace std::string_literals;
  const std::pair<std::string, std::string> texts[] = {
      {"fx: 1\n", "fx: 1\n"},
      {"\xEF\xBB\xBF"
       "fx: 1\n",
       "fx: 1\n"},
      {"\xEF\xBB\xBF", ""},
      {"\xFF\xFE"
       "a\0\xE9\0\xAC\x20\x3D\xD8\x00\xDE"s,
       "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80"},
      {"\xFE\xFF"
       "\0a\0\xE9\x20\xAC\xD8\x3D\xDE\x00"s,
       "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80"},
      {"\xFF\xFE"
       "\x3D\xD8"
       "a\0b"s,
       "\xEF\xBF\xBD"
       "a"},
  };
  for (const auto& [bytes, text] : texts) {
    write_file(folder_ / "text", bytes);
    EXPECT_EQ(read_text_file(folder_ / "text", 100), text) << ::testing::PrintToString(bytes);
  }
}

TEST_F(FileContent, longer_than_its_kind_may_be_is_refused_by_its_limit) {
  write_file(folder_ / "long", std::string(2049, 'x'));
  EXPECT_TRUE(read_file(folder_ / "long", 2049));
  EXPECT_THAT(error_of(folder_ / "long", 2048), AllOf(HasSubstr("long: "), HasSubstr("2 KiB")));
  std::filesystem::resize_file(folder_ / "long", std::uintmax_t{1} << 40);  // on no disk
  EXPECT_THAT(error_of(folder_ / "long", kMostListBytes), HasSubstr("longer than 256 MiB"));
}

TEST_F(FileContent, whose_size_the_system_does_not_tell_is_read_to_its_end) {
  const auto status = read_file("/proc/self/status", 1 << 20);
  ASSERT_TRUE(status) << status.error().text();
  EXPECT_THAT(*status, HasSubstr("Pid:"));
  EXPECT_FALSE(read_file("/proc/self/status", 10));
}

TEST_F(FileContent, of_a_pipe_or_a_device_is_refused_at_once) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(error_of(folder_ / "pipe"), HasSubstr("it is a pipe, not a file; write its content"));
  EXPECT_THAT(error_of("/dev/zero"), HasSubstr("it is a device, not a file"));
  EXPECT_THAT(error_of(folder_.path()), HasSubstr("it is a folder, not a file"));
  EXPECT_THAT(error_of(folder_ / "none"), HasSubstr("there is no such file"));
  EXPECT_THAT(error_of(folder_ / "pipe" / "x"), HasSubstr("cannot be read: Not a directory"));
}

}  // namespace
}  // namespace swiftlet
