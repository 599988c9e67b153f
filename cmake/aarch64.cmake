# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# Toolchain: builds for a 64-bit ARM with Debian's g++-aarch64-linux-gnu and runs what it has built in qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
