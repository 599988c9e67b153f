# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""script/install on systems that lack something: it must say what is wrong and what to install by hand.

Each case puts its own dpkg-query, apt-get and sudo before the real ones; what they were asked is in a log.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
ALL_INSTALLED = "echo installed"
NO_EIGEN = 'case "$*" in *libeigen3-dev*) exit 1;; *) echo installed;; esac'


def install(purpose="build", **commands):
    """Runs the script with these commands (name=shell text); gives exit code, all output, calls of apt-get."""
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "calls"
        for name, text in {"sudo": 'exec "$@"', **commands}.items():
            command = Path(folder) / name.replace("_", "-")
            note = f'echo "$*" >> {log}\n' if name == "apt_get" else ""
            command.write_text(f"#!/bin/sh\n{note}{text}\n")
            command.chmod(0o755)
        environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
        run = subprocess.run([PROJECT / "script" / "install", purpose], env=environment, capture_output=True,
                             text=True, check=False, stdin=subprocess.DEVNULL)
        calls = log.read_text() if log.exists() else ""
    return run.returncode, run.stdout + run.stderr, calls


class Install(unittest.TestCase):
    def test_does_not_call_apt_when_nothing_is_missing(self):
        code, output, calls = install(dpkg_query=ALL_INSTALLED, apt_get="exit 1")
        self.assertEqual((code, calls), (0, ""), output)

    def test_installs_what_is_missing_and_nothing_else(self):
        code, output, calls = install(dpkg_query=NO_EIGEN, apt_get="exit 0")
        self.assertEqual(code, 0, output)
        self.assertTrue(calls.splitlines()[-1].endswith("-y libeigen3-dev"), calls)
        self.assertIn("Installing with apt, to build Swiftlet: libeigen3-dev", output)

    def test_without_network_says_what_to_install_by_hand(self):
        code, output, _ = install(dpkg_query=NO_EIGEN, apt_get="echo 'Could not resolve host' >&2; exit 100")
        self.assertEqual(code, 1)
        self.assertIn("Could not resolve host", output)
        self.assertIn("install by hand: apt-get install libeigen3-dev", output)

    def test_shows_the_end_of_what_apt_said_when_it_fails(self):
        failing = 'case "$*" in *update*) ;; *) echo "Unable to locate package"; exit 100;; esac'
        code, output, _ = install(dpkg_query=NO_EIGEN, apt_get=failing)
        self.assertEqual(code, 1)
        self.assertIn("Unable to locate package", output)
        self.assertIn("install by hand: apt-get install libeigen3-dev", output)

    def test_to_test_needs_more_than_to_build(self):
        needs = 'case "$*" in *libgtest-dev*) exit 1;; *) echo installed;; esac'
        self.assertEqual(install("build", dpkg_query=needs, apt_get="exit 0")[2], "")
        self.assertIn("libgtest-dev", install("test", dpkg_query=needs, apt_get="exit 0")[2])

    def test_refuses_an_unknown_purpose(self):
        code, output, _ = install("fly")
        self.assertEqual(code, 1)
        self.assertIn("known are: build, test", output)


if __name__ == "__main__":
    unittest.main()
