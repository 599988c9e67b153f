#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""Writes the flight of write_flight.mjs into the other containers of ROS.

    write_recordings.py FOLDER

Reads FOLDER/messages.jsonl. Databases are written by Python's sqlite3 with the tables of each version of rosbag2, and
packed by the program zstd; the ROS 1 bag as wiki.ros.org/Bags/Format/2.0 has it.
"""

import base64
import json
import sqlite3
import struct
import subprocess
import sys
from pathlib import Path

FIRST_TABLES = """
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                      data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
"""
NEWEST_TABLES = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
                    offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
                                 encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                      data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES(4, 'jazzy');
"""


def zstd(data):
    return subprocess.run(["zstd", "-q", "-c"], input=data, stdout=subprocess.PIPE, check=True).stdout


def write_database(path, messages, tables=NEWEST_TABLES, pack=lambda data: data):
    database = sqlite3.connect(path)
    database.executescript(tables)
    topics = {}
    for message in messages:
        if message["topic"] not in topics:
            number = topics[message["topic"]] = len(topics) + 1
            row = [number, message["topic"], message["type"].replace("/", "/msg/"), "cdr"]
            row += ["", "RIHS01_00"] if tables is NEWEST_TABLES else []
            database.execute(f"INSERT INTO topics VALUES({','.join('?' * len(row))})", row)
        database.execute(
            "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
            (topics[message["topic"]], message["time_ns"], pack(message["cdr"])),
        )
    database.commit()
    database.close()


def write_metadata(folder, files, mode=""):
    lines = ["rosbag2_bagfile_information:", "  version: 9", "  storage_identifier: sqlite3", "  relative_file_paths:"]
    lines += [f"    - {name}" for name in files]
    lines += [f"  compression_format: {'zstd' if mode else repr('')}", f"  compression_mode: {mode or repr('')}"]
    (folder / "metadata.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_split(folder, messages, parts, mode="", with_metadata=True):
    """A folder as `ros2 bag record` leaves it."""
    folder.mkdir()
    names = []
    size = -(-len(messages) // parts)
    for i in range(parts):
        path = folder / f"{folder.name}_{i}.db3"
        part = messages[i * size : (i + 1) * size]
        write_database(path, part, pack=zstd if mode == "MESSAGE" else lambda data: data)
        if mode == "FILE":
            packed = path.with_name(path.name + ".zstd")
            packed.write_bytes(zstd(path.read_bytes()))
            path.unlink()
            path = packed
        names.append(path.name)
    if with_metadata:
        write_metadata(folder, names, mode)


def field(name, value):
    data = name.encode() + b"=" + value
    return struct.pack("<I", len(data)) + data


def record(header, data):
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def write_bag(path, messages):
    out = b"#ROSBAG V2.0\n" + record(
        field("op", b"\x03") + field("index_pos", bytes(8)) + field("conn_count", bytes(4))
        + field("chunk_count", bytes(4)), b" " * 64)
    connections = {}
    for message in messages:
        chunk = b""
        topic = message["topic"].encode()
        if topic not in connections:
            connections[topic] = struct.pack("<I", len(connections))
            chunk += record(
                field("op", b"\x07") + field("conn", connections[topic]) + field("topic", topic),
                field("topic", topic) + field("type", message["type"].encode()) + field("md5sum", b"*"))
        time = struct.pack("<II", *divmod(message["time_ns"], 10**9))
        chunk += record(field("op", b"\x02") + field("conn", connections[topic]) + field("time", time), message["ros1"])
        out += record(
            field("op", b"\x05") + field("compression", b"none") + field("size", struct.pack("<I", len(chunk))), chunk)
    path.write_bytes(out)


def main():
    folder = Path(sys.argv[1])
    messages = []
    for line in (folder / "messages.jsonl").read_text(encoding="utf-8").splitlines():
        message = json.loads(line)
        message["time_ns"] = int(message["time_ns"])
        for form in ("ros1", "cdr"):
            message[form] = base64.b64decode(message[form])
        messages.append(message)
    write_bag(folder / "flight.bag", messages)
    write_database(folder / "newest.db3", messages)
    write_database(folder / "first.db3", messages, FIRST_TABLES)
    write_split(folder / "split", messages, 3)
    write_split(folder / "split_bare", messages, 12, with_metadata=False)
    write_split(folder / "packed_files", messages, 2, "FILE")
    write_split(folder / "packed_messages", messages, 2, "MESSAGE", with_metadata=False)
    (folder / "packed.mcap.zstd").write_bytes(zstd((folder / "none.mcap").read_bytes()))


if __name__ == "__main__":
    main()
