// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <type_traits>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// A file under construction: it carries a temporary name beside `path` until commit(), and is
/// removed if that never comes.
class OutputFile {
 public:
  /// Errors: kIo.
  [[nodiscard]] static Expected<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&&) noexcept = default;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  void write(std::string_view text) { stream_ << text; }
  /// The bytes of a number, little endian.
  template <class T>
  void write_little_endian(T value) {
    static_assert(std::is_arithmetic_v<T>);
    unsigned char raw[sizeof(T)];
    pack(&value, raw, sizeof(T));
    stream_.write(reinterpret_cast<const char*>(raw), sizeof(T));
  }
  [[nodiscard]] std::ostream& stream() { return stream_; }

  /// Gives the file its name. Errors: kIo if anything could not be written; then there is no file.
  [[nodiscard]] Status commit();

 private:
  OutputFile(std::filesystem::path path, std::filesystem::path temporary);
  static void pack(const void* value, unsigned char* out, std::size_t size);

  std::filesystem::path path_;
  std::filesystem::path temporary_;  // empty once committed or moved from
  std::ofstream stream_;
};

}  // namespace swiftlet
