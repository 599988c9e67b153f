// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <png.h>

#include <string>
#include <vector>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/render/picture.hpp"

namespace swiftlet::render {
namespace {

static_assert(sizeof(Colour) == 3, "a row of colours is a row of a PNG");

/// libpng's simplified interface reports errors as values: no setjmp.
Expected<std::string> encoded(const Picture& picture, const std::string& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = to<png_uint_32>(picture.width());
  header.height = to<png_uint_32>(picture.height());
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string png(bytes, '\0');
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
  auto file = OutputFile::create(path);
  if (!file) return forward_error(std::move(file));
  file->write(*png);
  return file->commit();
}

}  // namespace swiftlet::render
