// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <istream>
#include <string>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/sim/triangle_mesh.hpp"

namespace swiftlet::sim {

/// Reads the triangles of a PLY file (ascii or binary_little_endian; polygons become fans; colours,
/// normals and other properties are skipped). Coordinates are taken as metres; materials are 0.
/// Errors: kNotFound, kUnsupported, kCorruptInput with the file and what is wrong.
[[nodiscard]] Expected<TriangleMesh> read_ply(const std::string& path);
[[nodiscard]] Expected<TriangleMesh> read_ply(std::istream& in, const std::string& name);

}  // namespace swiftlet::sim
