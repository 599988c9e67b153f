# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
# shellcheck shell=bash

# Sourced by the scripts beside: puts them into the project's folder.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

say() { printf '== %s\n' "$*"; }
die() {
  printf 'swiftlet: %s\n' "$*" >&2
  exit 1
}

# The exit code of a check that does not apply here, as in automake.
export skipped=77

# SWIFTLET_JOBS overrides how much runs at once.
export jobs=${SWIFTLET_JOBS:-$(nproc)}

# The project that a preset belongs to.
folder_of() { if [[ $1 == aarch64 ]]; then echo tests/aarch64; else echo .; fi; }

# configure_and_build PRESET [TARGET...]
configure_and_build() {
  local preset=$1
  shift
  # Set by script/test: the test must fail, and not be left out, where the SDK was built and is not found.
  local with_realsense=(${SWIFTLET_WITH_REALSENSE:+"-DSWIFTLET_WITH_REALSENSE=$SWIFTLET_WITH_REALSENSE"})
  if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}; fi
  cmake -S "$(folder_of "$preset")" --preset "$preset" "${with_realsense[@]}" >"$(log_of "configure-$preset")" || {
    cat "$(log_of "configure-$preset")"
    return 1
  }
  cmake --build "build/$preset" --parallel "$jobs" ${1:+--target "$@"}
}

log_of() {
  mkdir -p build/logs
  printf 'build/logs/%s.log' "$1"
}
