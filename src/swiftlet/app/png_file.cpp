// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "swiftlet/app/picture.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet::app {
namespace {

static_assert(sizeof(Colour) == 3, "a row of colours is a row of a PNG");

/// libpng's simplified interface reports errors as values: no setjmp.
Expected<std::vector<std::uint8_t>> encoded(const Picture& picture, const std::string& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = to<png_uint_32>(picture.width());
  header.height = to<png_uint_32>(picture.height());
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::uint8_t> png(bytes);
  if (png_image_write_to_memory(&header, png.data(), &bytes, 0, picture.pixels().data(), 0,
                                nullptr) == 0) {
    return fail(ErrorCode::kIo, path,
                std::string("the picture cannot be encoded: ") + header.message,
                "try a smaller --scale");
  }
  png.resize(bytes);
  return png;
}

}  // namespace

Status write_png(const Picture& picture, const std::string& path) {
  auto png = encoded(picture, path);
  if (!png) return forward_error(std::move(png));
  const std::string unfinished = path + ".part";
  const auto refused = [&]() -> Status {
    const std::string reason = std::strerror(errno);
    std::remove(unfinished.c_str());
    return fail(ErrorCode::kIo, path, "the picture cannot be written: " + reason,
                "choose another place with -o");
  };
  errno = 0;
  std::FILE* file = std::fopen(unfinished.c_str(), "wb");
  if (file == nullptr) return refused();
  const bool is_written = std::fwrite(png->data(), 1, png->size(), file) == png->size();
  const bool is_closed = std::fclose(file) == 0;  // a full disk may tell only now
  if (!is_written || !is_closed || std::rename(unfinished.c_str(), path.c_str()) != 0) {
    return refused();
  }
  return Done{};
}

}  // namespace swiftlet::app
