# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""script/realsense-sdk where the SDK cannot be had: skipped (77) with the reason, and nothing unchecked is used.

Each case has an empty cache and puts its own npm before the real one. That it builds is shown by script/test.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SKIPPED = 77


def realsense_sdk(npm):
    """Runs the script with an npm of this shell text; gives exit code, standard output, and what was said."""
    with tempfile.TemporaryDirectory() as folder:
        command = Path(folder) / "npm"
        command.write_text(f"#!/bin/sh\n{npm}\n")
        command.chmod(0o755)
        cache = Path(folder) / "cache"
        environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "SWIFTLET_CACHE": str(cache)}
        run = subprocess.run([PROJECT / "script" / "realsense-sdk"], env=environment, capture_output=True, text=True,
                             check=False, stdin=subprocess.DEVNULL)
        left = sorted(path.name for path in cache.glob("*")) if cache.exists() else []
    return run.returncode, run.stdout, run.stderr, left


@unittest.skipIf(subprocess.run(["pkg-config", "--exists", "libusb-1.0", "libudev"], check=False).returncode,
                 "libusb or libudev is missing")
class RealsenseSdk(unittest.TestCase):
    def test_without_network_is_skipped_with_the_reason(self):
        code, out, said, left = realsense_sdk("echo 'getaddrinfo ENOTFOUND' >&2; exit 1")
        self.assertEqual((code, out, left), (SKIPPED, "", []), said)
        self.assertIn("skipped: the RealSense SDK cannot be built here: npm cannot fetch", said)
        self.assertIn("is there a network?", said)

    def test_refuses_what_was_not_published(self):
        code, out, said, left = realsense_sdk("echo evil > node-librealsense-0.2130.0.tgz")
        self.assertEqual((code, out, left), (1, "", []), said)
        self.assertIn("its SHA-512 differs; nothing of it was used", said)


if __name__ == "__main__":
    unittest.main()
