// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <span>
#include <string_view>
#include <type_traits>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// A file under construction: it carries a temporary name beside `path` until commit(), and is
/// removed if that never comes. The temporary name cannot be guessed and is made anew, never
/// followed: what stands in the folder, links among it, is left as it is.
class OutputFile {
 public:
  /// `inputs` are the files that the content comes from. Errors: kUsage if `path` is one of them,
  /// whatever it is called, or a Swiftlet map, or not a file; kIo.
  [[nodiscard]] static Expected<OutputFile> create(
      const std::filesystem::path& path, std::span<const std::filesystem::path> inputs = {});
  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  void write(std::string_view text) { stream() << text; }
  /// The bytes of a number, little endian.
  template <class T>
  void write_little_endian(T value) {
    static_assert(std::is_arithmetic_v<T>);
    unsigned char raw[sizeof(T)];
    pack(&value, raw, sizeof(T));
    stream().write(reinterpret_cast<const char*>(raw), sizeof(T));
  }
  [[nodiscard]] std::ostream& stream();

  /// Waits for the disk and gives the file its name. Errors: kIo if anything could not be written;
  /// then there is no file.
  [[nodiscard]] Status commit();

 private:
  class Sink;
  OutputFile(std::filesystem::path path, std::filesystem::path temporary, int descriptor);
  static void pack(const void* value, unsigned char* out, std::size_t size);

  std::filesystem::path path_;
  std::filesystem::path temporary_;  // empty once committed or moved from
  std::unique_ptr<Sink> sink_;
};

/// What create() asks, for whoever writes through another library: whether `path` may be written,
/// with these inputs. Errors: kUsage.
[[nodiscard]] Status check_output(const std::filesystem::path& path,
                                  std::span<const std::filesystem::path> inputs);

}  // namespace swiftlet
