#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""One flight in every container and serialisation of ROS, written by packages that are not ours: the same map.

    peer_recordings_test.py SWIFTLET NODE
"""

import hashlib
import json
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).parent
PROGRAM, NODE = sys.argv[1:3]
SAME = """flight.bag none.mcap zstd.mcap lz4.mcap plain.mcap ros1.mcap packed.mcap.zstd newest.db3 first.db3 split split_bare
packed_files packed_messages compressed_depth_png.mcap compressed_depth_old.mcap compressed_depth_rvl.mcap
compressed_png.mcap cloud.mcap""".split()


def run(*words, code=0):
    ended = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert ended.returncode == code, f"{words}: {ended.returncode}\n{ended.stdout}{ended.stderr}"
    return ended.stdout + ended.stderr


def bits_of(path):
    """A hash of all blocks of a map, whatever it says of where they came from."""
    digest = hashlib.sha256()
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    tables = [name for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
    assert "blocks" in tables, tables
    rows = sorted(map(repr, database.execute("SELECT z, y, x, data FROM blocks")))
    assert rows
    digest.update("\n".join(rows).encode())
    return digest.hexdigest()


class PeerRecordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="swiftlet-peers-")
        cls.folder = Path(cls.temporary.name)
        subprocess.run([NODE, HERE / "write_flight.mjs", cls.folder], check=True)
        subprocess.run([sys.executable, HERE / "write_recordings.py", cls.folder], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def map_bits(self, name, *words):
        out = self.folder / (name + ".swl")
        said = run("map", f"bag:{self.folder / name}", "-o", out, "--overwrite", *words)
        self.assertIn("30 ", said, name)
        return bits_of(out)

    def test_every_form_gives_the_same_map_bits(self):
        reference = self.map_bits(SAME[0])
        for name in SAME[1:]:
            with self.subTest(name):
                self.assertEqual(self.map_bits(name), reference)

    def test_quantised_metres_give_nearly_the_same_map(self):
        name = "compressed_depth_metres.mcap"
        self.map_bits(name)
        self.map_bits(SAME[0])
        voxels = [json.loads(run("info", self.folder / (n + ".swl"), "--json"))["voxels"]["occupied"]
                 for n in (name, SAME[0])]
        self.assertGreater(voxels[0], 0.8 * voxels[1])
        self.assertLess(voxels[0], 1.25 * voxels[1])

    def test_poses_from_the_tree_of_tf_are_those_of_the_odometry(self):
        reference = self.map_bits("none.mcap")
        self.assertEqual(self.map_bits("none.mcap", "--pose-topic", "/tf", "--body-frame", "base_link"), reference)

    def test_info_tells_the_topics_of_every_form(self):
        for name in SAME:
            with self.subTest(name):
                report = json.loads(run("info", self.folder / name, "--json"))
                topics = {topic["name"]: topic for topic in report["topics"]}
                self.assertEqual(topics["/odom"]["messages"], 31)
                self.assertEqual(topics["/odom"]["type"], "nav_msgs/Odometry")
                self.assertEqual(topics["/odom"]["frames"], ["odom"])
                self.assertEqual(topics["/tf_static"]["frames"], ["depth_optical"])
                self.assertTrue(any("depth from" in choice for choice in report["would_map"]), report)
        self.assertIn("MCAP, profile ros2", run("info", self.folder / "zstd.mcap"))
        self.assertIn("rosbag2 SQLite, 3 files", run("info", self.folder / "split"))

    def test_a_recorder_that_was_killed_leaves_what_can_be_mapped(self):
        whole = (self.folder / "none.mcap").read_bytes()
        cut = self.folder / "cut.mcap"
        cut.write_bytes(whole[: len(whole) // 2])
        said = run("map", f"bag:{cut}", "-o", self.folder / "cut.swl", code=1)
        self.assertIn("the file ends at byte", said)
        frames = json.loads(run("info", self.folder / "cut.swl", "--json"))["frames"]
        self.assertGreater(frames, 10)

    def test_a_wrong_name_says_nothing_of_what_a_file_is(self):
        disguised = self.folder / "flight.txt"
        disguised.write_bytes((self.folder / "newest.db3").read_bytes())
        run("map", f"bag:{disguised}", "-o", self.folder / "disguised.swl")
        self.assertEqual(bits_of(self.folder / "disguised.swl"), self.map_bits("flight.bag"))


if __name__ == "__main__":
    if missing := [tool for tool in (NODE, "zstd", "lz4") if not shutil.which(tool)]:
        print("skipped: there is no", ", ".join(missing))
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
