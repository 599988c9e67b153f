// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/folders/matrix_file.hpp"

#include <fmt/format.h>

#include "swiftlet/file/file_content.hpp"
#include "swiftlet/source/text_file.hpp"

namespace swiftlet {
namespace {

template <int N>
Expected<Eigen::Matrix<double, N, N>> read_square_matrix(const std::filesystem::path& path) {
  auto text = read_text_file(path, kMostMatrixBytes);
  if (!text) return forward_error(std::move(text));

  const auto words = words_of(*text);
  if (words.size() != std::size_t{N} * std::size_t{N}) {
    return fail(ErrorCode::kCorruptInput, path.string(),
                fmt::format("it should hold {0} x {0} numbers, but has {1}", N, words.size()),
                "write the matrix row by row");
  }
  Eigen::Matrix<double, N, N> matrix;
  for (int i = 0; i < N * N; ++i) {
    const std::string_view word = words[static_cast<std::size_t>(i)];
    const auto number = parse_number(word);
    if (!number)
      return fail(
          ErrorCode::kCorruptInput, path.string(),
          fmt::format("'{}' (row {}, column {}) is not a number", word, i / N + 1, i % N + 1));
    matrix(i / N, i % N) = *number;
  }
  return matrix;
}

}  // namespace

Expected<Eigen::Matrix3d> read_matrix3(const std::filesystem::path& path) {
  return read_square_matrix<3>(path);
}

Expected<Eigen::Matrix4d> read_matrix4(const std::filesystem::path& path) {
  return read_square_matrix<4>(path);
}

}  // namespace swiftlet
