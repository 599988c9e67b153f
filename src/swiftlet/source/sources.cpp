// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sources.hpp"

#include <array>

// A source is one file and one line here. Its opener is null where its part was not built.
#define SWIFTLET_SOURCES(X)

namespace swiftlet {
namespace {

constexpr std::array<Registered<OpenSource>, 0> kSources{};

}  // namespace

std::span<const Registered<OpenSource>> sources() { return kSources; }

}  // namespace swiftlet
