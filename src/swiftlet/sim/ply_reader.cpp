// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/ply_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <locale>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "swiftlet/base/number_text.hpp"
#include "swiftlet/file/file_content.hpp"

namespace swiftlet::sim {
namespace {

static_assert(std::endian::native == std::endian::little);

/// One scalar type of the format, under both of its names.
struct ScalarType {
  std::string_view name, other_name;
  std::size_t bytes;
  char kind;  // i signed, u unsigned, f floating
};
constexpr std::array<ScalarType, 8> kScalarTypes{{{"char", "int8", 1, 'i'},
                                                  {"uchar", "uint8", 1, 'u'},
                                                  {"short", "int16", 2, 'i'},
                                                  {"ushort", "uint16", 2, 'u'},
                                                  {"int", "int32", 4, 'i'},
                                                  {"uint", "uint32", 4, 'u'},
                                                  {"float", "float32", 4, 'f'},
                                                  {"double", "float64", 8, 'f'}}};

struct Property {
  std::string name;
  const ScalarType* type = nullptr;
  const ScalarType* count_type = nullptr;  // of a list; null for a scalar
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};
struct Header {
  bool is_binary = false;
  std::vector<Element> elements;
};

const ScalarType* find_type(std::string_view name) {
  const auto* found = std::ranges::find_if(
      kScalarTypes, [&](const ScalarType& t) { return t.name == name || t.other_name == name; });
  return found == kScalarTypes.end() ? nullptr : found;
}

constexpr int kLongestNumber = 400;  // DBL_MAX written out has 309 digits

/// Reads header and values; after a fault every further value is refused.
class PlyFile {
 public:
  PlyFile(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  [[nodiscard]] tl::unexpected<Error> fault(ErrorCode code, std::string what) const {
    return fail(code, name_, std::move(what));
  }

  Expected<Header> header() {
    std::string line;
    if (!next_line(line) || line != "ply") return fault(ErrorCode::kCorruptInput, "not a PLY file");
    Header header;
    while (next_line(line)) {
      if (line == "end_header") {
        is_binary_ = header.is_binary;
        return header;
      }
      if (auto status = header_line(line, header); !status) return forward_error(std::move(status));
    }
    return fault(ErrorCode::kCorruptInput, "the header has no end");
  }

  std::optional<double> value(const ScalarType& type) {
    if (!is_binary_) {
      std::string word;
      return in_ >> std::setw(kLongestNumber) >> word ? number_from<double>(word) : std::nullopt;
    }
    std::array<char, 8> raw{};
    if (!in_.read(raw.data(), static_cast<std::streamsize>(type.bytes))) return std::nullopt;
    return decode(raw, type);
  }

 private:
  bool next_line(std::string& line) {
    if (!std::getline(in_, line)) return false;
    if (line.ends_with('\r')) line.pop_back();
    return true;
  }

  Status header_line(const std::string& line, Header& header) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());  // the caller's may group digits
    std::string key;
    words >> key;
    if (key == "format") {
      std::string format;
      words >> format;
      header.is_binary = format == "binary_little_endian";
      if (!header.is_binary && format != "ascii")
        return fault(ErrorCode::kUnsupported, fmt::format("the format '{}' is not read", format));
    } else if (key == "element") {
      Element element;
      if (!(words >> element.name >> element.count))
        return fault(ErrorCode::kCorruptInput, fmt::format("bad header line '{}'", line));
      header.elements.push_back(std::move(element));
    } else if (key == "property") {
      return property_line(words, line, header);
    }
    return Done{};  // comments, obj_info
  }

  Status property_line(std::istringstream& words, const std::string& line, Header& header) const {
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count_type;
      words >> count_type >> type;
      property.count_type = find_type(count_type);
      if (property.count_type == nullptr)
        return fault(ErrorCode::kCorruptInput, fmt::format("bad header line '{}'", line));
    }
    property.type = find_type(type);
    if (!(words >> property.name) || property.type == nullptr || header.elements.empty())
      return fault(ErrorCode::kCorruptInput, fmt::format("bad header line '{}'", line));
    header.elements.back().properties.push_back(std::move(property));
    return Done{};
  }

  static double decode(const std::array<char, 8>& raw, const ScalarType& type) {
    if (type.kind == 'f') {
      return type.bytes == 4 ? static_cast<double>(as<float>(raw)) : as<double>(raw);
    }
    const auto bits = as<std::uint32_t>(raw);
    if (type.kind == 'u') return bits;
    const unsigned unused_bits = 32U - 8U * static_cast<unsigned>(type.bytes);
    return static_cast<std::int32_t>(bits << unused_bits) >> unused_bits;
  }
  template <class T>
  static T as(const std::array<char, 8>& raw) {
    T number;
    std::memcpy(&number, raw.data(), sizeof number);
    return number;
  }

  std::istream& in_;
  std::string name_;
  bool is_binary_ = false;
};

/// The least that one row of an element takes: in text, a digit and a blank a value.
std::uint64_t least_bytes(const Element& element, bool is_binary) {
  std::uint64_t bytes = 0;
  for (const Property& property : element.properties) {
    const ScalarType& first = property.count_type ? *property.count_type : *property.type;
    bytes += is_binary ? first.bytes : 2;
  }
  return is_binary ? bytes : bytes - std::min<std::uint64_t>(bytes, 1);
}

/// Bytes behind the place where a stream stands; nullopt if it cannot tell.
std::optional<std::uint64_t> bytes_left(std::istream& in) {
  const auto here = in.tellg();
  if (here < 0 || !in.seekg(0, std::ios::end)) return std::nullopt;
  const auto end = in.tellg();
  in.seekg(here);
  return static_cast<std::uint64_t>(end - here);
}

/// Counts are claims: what follows the header must be able to hold them, or nobody would know when
/// to stop.
std::optional<std::string> fault_of_counts(const Header& header, std::istream& in) {
  const auto left = bytes_left(in);
  for (const Element& element : header.elements) {
    if (element.count == 0) continue;
    const std::uint64_t least = least_bytes(element, header.is_binary);
    if (least == 0) return fmt::format("the element '{}' has no properties", element.name);
    if (left && element.count > *left / least + 1) {
      return fmt::format("the header tells of {} '{}', for which the {} bytes behind it cannot do",
                         element.count, element.name, *left);
    }
  }
  return std::nullopt;
}

/// The values of one element; a list yields its entries. False at the end of the file.
bool read_row(PlyFile& file, const Element& element, std::vector<std::vector<double>>& row) {
  constexpr double kMostCorners = 1024;
  row.assign(element.properties.size(), {});
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Property& property = element.properties[i];
    const auto count = property.count_type ? file.value(*property.count_type) : 1.0;
    if (!count || !(*count >= 0.0 && *count <= kMostCorners)) return false;
    for (double k = 0; k < *count; ++k) {
      const auto value = file.value(*property.type);
      if (!value) return false;
      row[i].push_back(*value);
    }
  }
  return true;
}

std::optional<std::size_t> index_of(const Element& element, std::string_view name) {
  const auto found = std::ranges::find(element.properties, name, &Property::name);
  if (found == element.properties.end()) return std::nullopt;
  return static_cast<std::size_t>(found - element.properties.begin());
}

bool append_vertex(const Element& element, const std::vector<std::vector<double>>& row,
                   TriangleMesh& mesh) {
  Eigen::Vector3f p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto column =
        index_of(element, std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1));
    if (!column || row[*column].size() != 1) return false;
    p[axis] = static_cast<float>(row[*column].front());
  }
  mesh.vertices_m.push_back(p);
  return p.allFinite();
}

bool append_face(const Element& element, const std::vector<std::vector<double>>& row,
                 TriangleMesh& mesh) {
  auto column = index_of(element, "vertex_indices");
  if (!column) column = index_of(element, "vertex_index");
  if (!column) return false;
  const std::vector<double>& corners = row[*column];
  const auto vertices = static_cast<double>(mesh.vertices_m.size());
  for (double c : corners)
    if (!(c >= 0.0 && c < vertices && c == std::floor(c))) return false;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                              static_cast<std::uint32_t>(corners[k - 1]),
                              static_cast<std::uint32_t>(corners[k])});
    mesh.materials.push_back(0);
  }
  return true;
}

}  // namespace

Expected<TriangleMesh> read_ply(std::istream& in, const std::string& name) {
  PlyFile file(in, name);
  auto header = file.header();
  if (!header) return forward_error(std::move(header));

  if (auto claim = fault_of_counts(*header, in))
    return file.fault(ErrorCode::kCorruptInput, std::move(*claim));
  TriangleMesh mesh;
  std::vector<std::vector<double>> row;
  for (const Element& element : header->elements) {
    for (std::size_t i = 0; i < element.count; ++i) {
      bool is_good = read_row(file, element, row);
      if (is_good && element.name == "vertex") is_good = append_vertex(element, row, mesh);
      if (is_good && element.name == "face") is_good = append_face(element, row, mesh);
      if (!is_good) {
        return file.fault(ErrorCode::kCorruptInput,
                          fmt::format("{} {} of {} is missing or makes no sense", element.name, i,
                                      element.count));
      }
    }
  }
  if (mesh.triangles.empty()) return file.fault(ErrorCode::kCorruptInput, "no triangles");
  return mesh;
}

Expected<TriangleMesh> read_ply(const std::string& path) {
  if (auto usable = check_regular_file(path); !usable) return forward_error(std::move(usable));
  std::ifstream in(path, std::ios::binary);
  if (!in) return fail(ErrorCode::kNotFound, path, "the mesh cannot be read");
  return read_ply(in, path);
}

}  // namespace swiftlet::sim
