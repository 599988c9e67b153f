// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/command.hpp"

int main(int argc, char** argv) { return swiftlet::app::run_program(argc, argv); }
