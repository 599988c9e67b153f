#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# tools/build_minutes.sh [TARGET...]
# What a cold build costs: the processor minutes (user + sys) of the program, then of all tests, without a compiler
# cache, and the twelve compiler runs that cost most. Packages must be there (script/install test).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export runs=$work/runs
cat >"$work/compiler" <<'END'
#!/usr/bin/env bash
# Runs the compiler and notes its processor seconds and what it compiled.
"$@"
outcome=$?
awk -v tick="$(getconf CLK_TCK)" -v what="${*: -1}" '{ printf "%7.1f s  %s\n", ($16 + $17) / tick, what }' "/proc/$$/stat" >>"$runs"
exit $outcome
END
chmod +x "$work/compiler"

cmake --preset release -B "$work/build" -DSWIFTLET_BUILD_TESTS=ON -DCMAKE_CXX_COMPILER_LAUNCHER="$work/compiler" \
  >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }

(($#)) || set -- swiftlet_program all
TIMEFORMAT='%U %S %R'
for target in "$@"; do
  { time cmake --build "$work/build" --target "$target" >"$work/build.log"; } 2>"$work/time" || { tail "$work/build.log"; exit 1; }
  awk -v target="$target" '{ printf "%-18s %5.1f processor minutes, %5.1f minutes\n", target, ($1 + $2) / 60, $3 / 60 }' "$work/time"
done
sort -rn "$runs" | head -n 12 | sed "s|$work/build/||; s|$PWD/||"
