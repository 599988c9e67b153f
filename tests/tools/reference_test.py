#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""script/reference builds the API reference, and fails for a public symbol without a sentence."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
HEADER = "src/swiftlet/query/ray_query.hpp"


class Reference(unittest.TestCase):
    def build(self, plant=lambda text: text):
        """Builds the reference of a copy of the project whose header `plant` has changed."""
        with tempfile.TemporaryDirectory() as name:
            copy = Path(name)
            for part in ("include", "src", "script"):
                shutil.copytree(PROJECT / part, copy / part)
            (copy / "docs").mkdir()
            for file in ("Doxyfile", "reference.md"):
                shutil.copy(PROJECT / "docs" / file, copy / "docs")
            header = copy / HEADER
            header.write_text(plant(header.read_text()))
            built = subprocess.run([copy / "script/reference", copy / "out"], capture_output=True, text=True, check=False)
            page = copy / "out/html/index.html"
            return built, page.read_text() if page.exists() else ""

    def test_has_a_page_with_a_link_to_every_name_on_it(self):
        built, page = self.build()
        self.assertEqual(built.returncode, 0, built.stderr)
        self.assertIn("Swiftlet: the public headers", page)
        self.assertIn(">swiftlet::cast_ray()</a>", page)

    def test_fails_for_a_function_without_a_sentence(self):
        built, _ = self.build(lambda text: text.replace("/// What a ray met first.", "int planted();\n\n/// What."))
        self.assertNotEqual(built.returncode, 0)
        self.assertIn("planted", built.stdout + built.stderr)

    def test_fails_for_a_member_without_a_sentence(self):
        built, _ = self.build(lambda text: text.replace("struct RayHit {", "struct RayHit {\n  int planted = 0;\n"))
        self.assertNotEqual(built.returncode, 0)
        self.assertIn("planted", built.stdout + built.stderr)


if __name__ == "__main__":
    if not shutil.which("doxygen"):
        sys.exit(77)  # skipped
    unittest.main()
