# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""Plants faults in small projects and asks tools/check_layers.py to find each, and nothing else."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]

TABLE = """# Architecture
## Layers
| layer | kind | may include |
|---|---|---|
| `base` | core | |
| `map` | core | `base` |
| `store` | edge | `base` `map` |
| `app` | edge | `base` `map` `store` |
"""

CLEAN = {
    "base/time.hpp": "#include <cstdint>\n#include <Eigen/Core>\n#include <fmt/core.h>\n",
    "base/time.cpp": '#include "swiftlet/base/time.hpp"\n',
    "map/map.hpp": '#include "swiftlet/base/time.hpp"\n',
    "store/store.hpp": '#include <filesystem>\n#include "swiftlet/map/map.hpp"\n',
    "store/store.cpp": '#include <fstream>\n#include <sqlite3.h>\n#include "swiftlet/store/store.hpp"\n',
    "app/main.cpp": '#include <CLI/CLI.hpp>\n#include "swiftlet/store/store.hpp"\n',
}

# Rooms within a layer: `b` may see `a`, and not the other way round.
ROOMS_TABLE = TABLE + """| `map/a` | core | |
| `map/b` | core | `map/a` |
"""
ROOMS = {
    "map/kinds.hpp": "#include <cstdint>\n",
    "map/a/one.hpp": '#include "swiftlet/base/time.hpp"\n#include "swiftlet/map/kinds.hpp"\n',
    "map/b/two.hpp": '#include "swiftlet/map/a/one.hpp"\n',
    "map/kinds.cpp": '#include "swiftlet/map/b/two.hpp"\n#include "swiftlet/map/kinds.hpp"\n',
    "store/rooms.cpp": '#include "swiftlet/map/b/two.hpp"\n',
}


def check(files=None, table=TABLE):
    """Runs the tool on the clean project with some files replaced; gives exit code and output lines."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "ARCHITECTURE.md").write_text(table)
        for name, text in {**CLEAN, **(files or {})}.items():
            path = root / "src" / "swiftlet" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        tool = [sys.executable, PROJECT / "tools" / "check_layers.py", root]
        run = subprocess.run(tool, capture_output=True, text=True, check=False)
    return run.returncode, (run.stdout + run.stderr).splitlines()


class CheckLayers(unittest.TestCase):
    def assert_only_fault(self, expected, files=None, table=TABLE, code=1):
        result, lines = check(files, table)
        self.assertEqual((result, len(lines)), (code, 1), lines)
        self.assertIn(expected, lines[0])

    def test_accepts_a_clean_project(self):
        self.assertEqual(check(), (0, []))

    def test_accepts_this_project(self):
        tool = [sys.executable, PROJECT / "tools" / "check_layers.py", PROJECT]
        run = subprocess.run(tool, capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stdout + run.stderr), (0, ""))

    def test_finds_an_include_against_the_table(self):
        files = {"map/map.cpp": '// why\n#include "swiftlet/store/store.hpp"\n'}
        self.assert_only_fault("map.cpp:2: layer map may not see layer store", files)

    def test_finds_it_in_angle_brackets_and_odd_spacing(self):
        files = {"map/map.cpp": "  #  include <swiftlet/store/store.hpp>\n"}
        self.assert_only_fault("layer map may not see layer store", files)

    def test_finds_headers_that_include_each_other(self):
        files = {
            "map/a.hpp": '#include "swiftlet/map/b.hpp"\n',
            "map/b.hpp": '#include "swiftlet/map/a.hpp"\n',
        }
        self.assert_only_fault("swiftlet/map/a.hpp -> swiftlet/map/b.hpp -> swiftlet/map/a.hpp", files)

    def test_finds_input_and_output_in_core(self):
        for header in ("fstream", "iostream", "cstdio", "filesystem"):
            with self.subTest(header):
                self.assert_only_fault(f"<{header}>", {"map/map.cpp": f"#include <{header}>\n"})

    def test_finds_sockets_and_backends_in_core(self):
        for header in ("sys/socket.h", "unistd.h", "sqlite3.h", "png.h", "embree3/rtcore.h",
                       "octomap/OcTree.h", "yaml-cpp/yaml.h", "zstd.h", "fmt/ostream.h"):
            with self.subTest(header):
                self.assert_only_fault(f"<{header}>", {"base/time.cpp": f"#include <{header}>\n"})

    def test_finds_a_backend_in_an_installed_header(self):
        self.assert_only_fault("installed header", {"store/tiles.hpp": "#include <sqlite3.h>\n"})

    def test_finds_a_folder_without_a_row(self):
        self.assert_only_fault("src/swiftlet/extra: has no row", {"extra/a.hpp": "#pragma once\n"})

    def test_finds_a_relative_include(self):
        self.assert_only_fault("relative path", {"map/map.cpp": '#include "map.hpp"\n'})

    def test_finds_an_include_that_does_not_exist(self):
        self.assert_only_fault("does not exist", {"map/map.cpp": '#include "swiftlet/base/gone.hpp"\n'})

    def test_finds_an_include_by_macro(self):
        self.assert_only_fault("macro", {"map/map.cpp": "#include SWIFTLET_HEADER\n"})

    def test_refuses_a_cycle_in_the_table(self):
        table = TABLE.replace("| `base` | core | |", "| `base` | core | `map` |")
        self.assert_only_fault("cycle: base -> map -> base", table=table, code=2)

    def test_refuses_a_core_row_that_sees_the_edge(self):
        table = TABLE.replace("| `map` | core | `base` |", "| `map` | core | `base` `store` |")
        self.assert_only_fault("core layer map may not see store", table=table, code=2)

    def test_refuses_a_name_without_a_row(self):
        table = TABLE.replace("| `map` | core | `base` |", "| `map` | core | `bass` |")
        self.assert_only_fault("bass, which has no row", table=table, code=2)

    def test_accepts_rooms_that_see_what_their_rows_name(self):
        self.assertEqual(check(ROOMS, ROOMS_TABLE), (0, []))

    def test_finds_a_room_that_sees_another_against_the_table(self):
        files = {**ROOMS, "map/a/one.cpp": '#include "swiftlet/map/b/two.hpp"\n'}
        self.assert_only_fault("layer map/a may not see layer map/b", files, ROOMS_TABLE)

    def test_finds_a_room_that_sees_more_than_the_layer_around_it(self):
        files = {**ROOMS, "map/a/one.cpp": '#include "swiftlet/store/store.hpp"\n'}
        self.assert_only_fault("layer map/a may not see layer store", files, ROOMS_TABLE)

    def test_finds_a_room_without_a_row(self):
        self.assert_only_fault("src/swiftlet/map/c: has no row", {"map/c/three.hpp": "#pragma once\n"})

    def test_refuses_a_room_in_a_layer_without_a_row(self):
        self.assert_only_fault("lies in maps, which has no row", table=TABLE + "| `maps/a` | core | |\n", code=2)

    def test_refuses_a_missing_table(self):
        self.assert_only_fault("no layer table", table="# Architecture\n", code=2)


if __name__ == "__main__":
    unittest.main()
