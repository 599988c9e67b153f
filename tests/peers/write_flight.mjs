// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// node write_flight.mjs FOLDER
//
// Writes one flight past a wall as recordings of ROS, all of it by packages that are not ours: Foxglove's serialisers
// of both ROS, and the MCAP writer of Foxglove. FOLDER/*.mcap are the recordings; FOLDER/messages.jsonl holds the same
// messages in both serialisations for writers of other containers (write_recordings.py).

import { execFileSync } from "node:child_process";
import { appendFileSync, closeSync, openSync, writeFileSync, writeSync } from "node:fs";
import { createRequire } from "node:module";
import { deflateSync } from "node:zlib";
import path from "node:path";

const web = createRequire(new URL("../../web/package.json", import.meta.url));
const { McapWriter } = web("@mcap/core");
const { MessageWriter: Ros1Writer } = web("@foxglove/rosmsg-serialization");
const { MessageWriter: Ros2Writer } = web("@foxglove/rosmsg2-serialization");
const { ros1, ros2humble } = web("@foxglove/rosmsg-msgs-common");
const { stringify } = web("@foxglove/rosmsg");

const folder = process.argv[2];
const WIDTH = 160, HEIGHT = 120, F = 120, FRAMES = 30;

// The messages, plain as JavaScript has them -----------------------------------------------------

const stamp = (ms) => ({ sec: 1700000000 + Math.floor(ms / 1000), nsec: (ms % 1000) * 1000000 });
const header = (ms, frame_id) => ({ seq: 0, stamp: stamp(ms), frame_id });

/// z of a wall at 2.5 m, a pillar before it, and a hole without a reading.
function depthAt(u, v, frame) {
  const x = ((u - WIDTH / 2) / F) * 2.5 + 0.02 * frame;
  if (u < 8 && v < 8) return 0;
  return x > 0.4 && x < 0.6 ? 1.8 : 2.5 + 0.1 * Math.sin(3 * x);
}

function depthImage(frame, ms) {
  const data = new Uint8Array(WIDTH * HEIGHT * 2);
  const view = new DataView(data.buffer);
  for (let v = 0; v < HEIGHT; ++v)
    for (let u = 0; u < WIDTH; ++u)
      view.setUint16(2 * (v * WIDTH + u), Math.round(1000 * depthAt(u, v, frame)), true);
  return { header: header(ms, "depth_optical"), height: HEIGHT, width: WIDTH, encoding: "16UC1", is_bigendian: 0,
           step: 2 * WIDTH, data };
}

const cameraInfo = (ms) => {
  const k = [F, 0, WIDTH / 2, 0, F, HEIGHT / 2, 0, 0, 1];
  const r = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const p = [F, 0, WIDTH / 2, 0, 0, F, HEIGHT / 2, 0, 0, 0, 1, 0];
  return { header: header(ms, "depth_optical"), height: HEIGHT, width: WIDTH, distortion_model: "plumb_bob",
           D: [0, 0, 0, 0, 0], K: k, R: r, P: p, d: [0, 0, 0, 0, 0], k, r, p, binning_x: 0, binning_y: 0,
           roi: { x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false } };
};

const zero3 = { x: 0, y: 0, z: 0 };
const level = { x: 0, y: 0, z: 0, w: 1 };
const at = (ms) => ({ x: 0, y: -0.0006 * ms, z: 1 });  // to the right, 0.6 m/s
const odometry = (ms) => ({
  header: header(ms, "odom"), child_frame_id: "base_link",
  pose: { pose: { position: at(ms), orientation: level }, covariance: new Array(36).fill(0) },
  twist: { twist: { linear: zero3, angular: zero3 }, covariance: new Array(36).fill(0) } });
const transforms = (ms, parent, child, translation, rotation) => ({
  transforms: [{ header: header(ms, parent), child_frame_id: child, transform: { translation, rotation } }] });
const opticalOnBody = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };

function* flight(depthTopic = "/camera/depth/image_rect_raw", depth = depthImage, type = "sensor_msgs/Image") {
  yield ["/tf_static", "tf2_msgs/TFMessage", 0,
         transforms(0, "base_link", "depth_optical", { x: 0.1, y: 0, z: 0.02 }, opticalOnBody)];
  for (let frame = 0; frame < FRAMES; ++frame) {
    const ms = 33 * frame;
    yield ["/odom", "nav_msgs/Odometry", ms, odometry(ms)];
    yield ["/tf", "tf2_msgs/TFMessage", ms, transforms(ms, "odom", "base_link", at(ms), level)];
    yield ["/camera/depth/camera_info", "sensor_msgs/CameraInfo", ms, cameraInfo(ms)];
    yield [depthTopic, type, ms, depth(frame, ms)];
  }
  yield ["/odom", "nav_msgs/Odometry", 33 * FRAMES, odometry(33 * FRAMES)];
}

// The same depth as image_transport and others pack it --------------------------------------------

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let i = 0; i < 8; ++i) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function png16(values) {
  const rows = Buffer.alloc(HEIGHT * (1 + 2 * WIDTH));
  for (let v = 0; v < HEIGHT; ++v)
    for (let u = 0; u < WIDTH; ++u)
      rows.writeUInt16BE(values[v * WIDTH + u], v * (1 + 2 * WIDTH) + 1 + 2 * u);
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]);
    const out = Buffer.alloc(8 + body.length);
    out.writeUInt32BE(data.length);
    body.copy(out, 4);
    out.writeUInt32BE(crc32(body), 4 + body.length);
    return out;
  };
  const size = Buffer.alloc(13);
  size.writeUInt32BE(WIDTH, 0);
  size.writeUInt32BE(HEIGHT, 4);
  size[8] = 16;
  return Buffer.concat([Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]), chunk("IHDR", size),
                        chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))]);
}

const millimetres = (frame) =>
  Array.from({ length: WIDTH * HEIGHT }, (_, i) => Math.round(1000 * depthAt(i % WIDTH, Math.floor(i / WIDTH), frame)));

/// As RvlCodec of compressed_depth_image_transport.
function rvl(values) {
  const groups = [];
  const number = (value) => {
    do {
      const group = value & 7;
      value = Math.floor(value / 8);
      groups.push(value ? group | 8 : group);
    } while (value);
  };
  let previous = 0;
  for (let i = 0; i < values.length;) {
    let zeros = 0;
    while (i + zeros < values.length && values[i + zeros] === 0) ++zeros;
    i += zeros;
    let readings = 0;
    while (i + readings < values.length && values[i + readings] !== 0) ++readings;
    number(zeros);
    number(readings);
    for (const end = i + readings; i < end; ++i) {
      const delta = values[i] - previous;
      number(delta < 0 ? -2 * delta - 1 : 2 * delta);
      previous = values[i];
    }
  }
  while (groups.length % 8) groups.push(0);
  const out = Buffer.alloc(8 + groups.length / 2);
  out.writeUInt32LE(WIDTH, 0);
  out.writeUInt32LE(HEIGHT, 4);
  for (let i = 0; i < groups.length; i += 8) {
    let word = 0;
    for (let k = 0; k < 8; ++k) word = word * 16 + groups[i + k];
    out.writeUInt32LE(word, 8 + i / 2);
  }
  return out;
}

function config(a = 0, b = 0) {
  const out = Buffer.alloc(12);
  out.writeFloatLE(a, 4);
  out.writeFloatLE(b, 8);
  return out;
}

const compressed = (format, pack) => (frame, ms) => ({
  header: header(ms, "depth_optical"), format, data: new Uint8Array(pack(millimetres(frame))) });

function cloud(frame, ms) {
  const step = 16;
  const data = new Uint8Array(WIDTH * HEIGHT * step);
  const view = new DataView(data.buffer);
  millimetres(frame).forEach((mm, i) => {
    const z = mm / 1000;
    const point = mm === 0 ? [NaN, NaN, NaN]
      : [((i % WIDTH - WIDTH / 2) / F) * z, ((Math.floor(i / WIDTH) - HEIGHT / 2) / F) * z, z];
    point.forEach((value, axis) => view.setFloat32(i * step + 4 * axis, value, true));
  });
  const fields = ["x", "y", "z"].map((name, i) => ({ name, offset: 4 * i, datatype: 7, count: 1 }));
  return { header: header(ms, "depth_optical"), height: HEIGHT, width: WIDTH, fields, is_bigendian: false,
           point_step: step, row_step: step * WIDTH, data, is_dense: false };
}

// The recordings ----------------------------------------------------------------------------------

/// The definition of a type and of those in it, the outermost first.
function definitionsOf(type, known) {
  const found = new Map();
  const collect = (name) => {
    if (found.has(name)) return;
    found.set(name, known[name]);
    for (const field of known[name].definitions) if (field.isComplex) collect(field.type);
  };
  collect(type);
  return [...found.values()];
}

const ROS1 = { name: "ros1", encoding: "ros1", schema: "ros1msg", known: ros1, Writer: Ros1Writer, typeName: (t) => t };
const ROS2 = { name: "ros2", encoding: "cdr", schema: "ros2msg", known: ros2humble, Writer: Ros2Writer,
               typeName: (t) => t.replace("/", "/msg/") };

const writers = new Map();
function serialised(ros, type, message) {
  const key = ros.name + type;
  if (!writers.has(key))
    writers.set(key, new ros.Writer(definitionsOf(ros.known[ros.typeName(type)] ? ros.typeName(type) : type, ros.known)));
  return writers.get(key).writeMessage(message);
}

const nanoseconds = (ms) => 1700000000000000000n + BigInt(ms) * 1000000n;

async function writeMcap(file, messages, ros, { compression, useChunks = true, chunkSize = 100000 }) {
  const out = openSync(path.join(folder, file), "w");
  let position = 0n;
  const writable = {
    position: () => position,
    write: async (bytes) => {
      writeSync(out, bytes);
      position += BigInt(bytes.length);
    } };
  const tools = { zstd: ["zstd", ["-q", "-c"]], lz4: ["lz4", ["-q", "-c"]] };
  const compressChunk = compression && ((bytes) => {
    const [program, words] = tools[compression];
    return { compression, compressedData: new Uint8Array(execFileSync(program, words, { input: bytes })) };
  });
  const writer = new McapWriter({ writable, useChunks, chunkSize, compressChunk });
  await writer.start({ profile: ros.name, library: "@mcap/core" });
  const channels = new Map();
  let sequence = 0;
  for (const [topic, type, ms, message] of messages) {
    if (!channels.has(topic)) {
      const name = ros.typeName(type);
      const text = definitionsOf(ros.known[name] ? name : type, ros.known).map((d) => stringify([d])).join("\n");
      const schemaId = await writer.registerSchema(
        { name, encoding: ros.schema, data: new TextEncoder().encode(text) });
      channels.set(topic, await writer.registerChannel(
        { topic, schemaId, messageEncoding: ros.encoding, metadata: new Map() }));
    }
    await writer.addMessage({ channelId: channels.get(topic), sequence: sequence++, logTime: nanoseconds(ms),
                              publishTime: nanoseconds(ms), data: serialised(ros, type, message) });
  }
  await writer.end();
  closeSync(out);
}

const raw = [...flight()];
await writeMcap("none.mcap", raw, ROS2, {});
await writeMcap("zstd.mcap", raw, ROS2, { compression: "zstd" });
await writeMcap("lz4.mcap", raw, ROS2, { compression: "lz4" });
await writeMcap("plain.mcap", raw, ROS2, { useChunks: false });
await writeMcap("ros1.mcap", raw, ROS1, { compression: "lz4" });

const base = "/camera/depth/image_rect_raw/";
const images = "sensor_msgs/CompressedImage";
const packedForms = {
  compressed_depth_png: ["compressedDepth", "16UC1; compressedDepth png", (mm) => Buffer.concat([config(), png16(mm)])],
  compressed_depth_old: ["compressedDepth", "16UC1; compressedDepth", (mm) => Buffer.concat([config(), png16(mm)])],
  compressed_depth_rvl: ["compressedDepth", "16UC1; compressedDepth rvl", (mm) => Buffer.concat([config(), rvl(mm)])],
  compressed_png: ["compressed", "16UC1; png compressed ", png16] };
for (const [name, [way, format, pack]] of Object.entries(packedForms))
  await writeMcap(name + ".mcap", flight(base + way, compressed(format, pack), images), ROS2, {});
// Metres quantised by their inverse; a and b as the transport computes them for 10 m and steps of 100.
const a = 100 * 101, b = 1 - a / 10;
await writeMcap("compressed_depth_metres.mcap", flight(base + "compressedDepth",
  compressed("32FC1; compressedDepth png", (mm) => Buffer.concat(
    [config(a, b), png16(mm.map((d) => (d === 0 ? 0 : Math.floor(a / (d / 1000) + b))))])), images), ROS2, {});
await writeMcap("cloud.mcap", flight("/camera/depth/points", cloud, "sensor_msgs/PointCloud2"), ROS2, {});

const list = path.join(folder, "messages.jsonl");
writeFileSync(list, "");
const base64 = (bytes) => Buffer.from(bytes).toString("base64");
for (const [topic, type, ms, message] of raw) {
  appendFileSync(list, JSON.stringify({ topic, type, time_ns: nanoseconds(ms).toString(),
                                        ros1: base64(serialised(ROS1, type, message)),
                                        cdr: base64(serialised(ROS2, type, message)) }) + "\n");
}
