// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {decompress} from 'fzstd';

import {flightStates, type BlockUpdate, type FrameRecord, type Hello, type ServerMessage, type Vec3} from './messages';

export class WireError extends Error {}

const kVersion = 1;
const kBlockVoxels = 512;
const kFrameRecord_bytes = 112;

/// Reads a binary message. Throws WireError for what is no message of this version; a type that it does not know is
/// null, so that newer servers may say more.
export function decode(data: ArrayBuffer): ServerMessage | null {
  try {
    return decodeUnguarded(data);
  } catch (error) {
    if (error instanceof WireError) throw error;
    throw new WireError(`a message of ${data.byteLength} bytes cannot be read: ${String(error)}`);
  }
}

function decodeUnguarded(data: ArrayBuffer): ServerMessage | null {
  const view = new DataView(data);
  const version = view.getUint8(1);
  if (version !== kVersion) throw new WireError(`the server speaks version ${version}, this page ${kVersion}`);
  const header = {sequence: view.getUint32(4, true), world: view.getUint32(8, true)};
  switch (view.getUint8(0)) {
    case 1:
      return {type: 'blocks', ...header, clearsFirst: (view.getUint16(2, true) & 1) !== 0, ...readBlocks(view)};
    case 2:
      return {type: 'frames', ...header, frames: readFrames(view)};
    case 3:
      return {type: 'status', ...header, ...readStatus(view)};
    case 4:
      return {
        type: 'checksum',
        ...header,
        frame: Number(view.getBigUint64(12, true)),
        digest: {
          blocks: view.getUint32(20, true),
          occupied: view.getUint32(24, true),
          free: view.getUint32(28, true),
          hashA: view.getUint32(32, true),
          hashB: view.getUint32(36, true),
        },
      };
    case 5:
      return {type: 'course', ...header, ...readCourse(view)};
    default:
      return null;
  }
}

function readIndex(view: DataView, offset: number): Vec3 {
  return [view.getInt32(offset, true), view.getInt32(offset + 4, true), view.getInt32(offset + 8, true)];
}

function readBlocks(view: DataView): {frame: number; blocks: BlockUpdate[]} {
  const [baseX, baseY, baseZ] = readIndex(view, 20);
  const known = view.getUint16(32, true);
  const count = known + view.getUint16(34, true);
  const plainSize = 6 * count + kBlockVoxels * known;
  const plain = decompress(new Uint8Array(view.buffer, view.byteOffset + 36), new Uint8Array(plainSize));
  if (plain.length !== plainSize) throw new WireError(`${plain.length} bytes of blocks instead of ${plainSize}`);
  const places = new DataView(plain.buffer, plain.byteOffset, plain.byteLength);
  const blocks: BlockUpdate[] = [];
  for (let i = 0; i < count; ++i) {
    const start = 6 * count + kBlockVoxels * i;
    blocks.push({
      x: baseX + places.getInt16(6 * i, true),
      y: baseY + places.getInt16(6 * i + 2, true),
      z: baseZ + places.getInt16(6 * i + 4, true),
      voxels: i < known ? plain.slice(start, start + kBlockVoxels) : null,
    });
  }
  return {frame: Number(view.getBigUint64(12, true)), blocks};
}

function readFrames(view: DataView): FrameRecord[] {
  const count = view.getUint16(12, true);
  const size = view.getUint16(14, true); // of a record; newer servers may append to it
  if (size < kFrameRecord_bytes || 16 + count * size > view.byteLength) {
    throw new WireError(`${count} records of ${size} bytes in a message of ${view.byteLength}`);
  }
  const frames: FrameRecord[] = [];
  for (let i = 0; i < count; ++i) frames.push(readFrame(view, 16 + i * size));
  return frames;
}

function readFrame(view: DataView, at: number): FrameRecord {
  const f32 = (offset: number): number => view.getFloat32(at + offset, true);
  const f64 = (offset: number): number => view.getFloat64(at + offset, true);
  const u32 = (offset: number): number => view.getUint32(at + offset, true);
  const flags = view.getUint8(at + 13);
  return {
    stamp_ns: view.getBigInt64(at, true),
    number: u32(8),
    verdict: view.getUint8(at + 12),
    hasShifted: (flags & 1) !== 0,
    isLate: (flags & 2) !== 0,
    wasHidden: (flags & 4) !== 0,
    camera: view.getUint8(at + 14),
    position: [f64(16), f64(24), f64(32)],
    rotation: [f32(40), f32(44), f32(48), f32(52)],
    stages_ms: [f32(56), f32(60), f32(64), f32(68)],
    readings: u32(72),
    voxels: u32(76),
    blocksLeft: u32(80),
    width: view.getUint16(at + 84, true),
    height: view.getUint16(at + 86, true),
    fx: f32(88),
    fy: f32(92),
    cx: f32(96),
    cy: f32(100),
    lost: u32(104),
  };
}

function readStatus(view: DataView) {
  const state = flightStates[view.getUint8(12)];
  if (!state) throw new WireError(`unknown flight state ${view.getUint8(12)}`);
  const verdictCount = view.getUint8(13);
  const lossCount = view.getUint8(14);
  const counters = (first: number, count: number): number[] =>
    Array.from({length: count}, (_, i) => view.getUint32(first + 4 * i, true));
  return {
    state,
    windowFirst: readIndex(view, 16),
    windowSize: readIndex(view, 28),
    triggerCentre: [view.getFloat64(40, true), view.getFloat64(48, true), view.getFloat64(56, true)] as Vec3,
    frame: Number(view.getBigUint64(64, true)),
    memoryBytes: Number(view.getBigUint64(72, true)),
    blocks: view.getUint32(80, true),
    pending: view.getUint32(84, true),
    clients: view.getUint32(88, true),
    rateLimit: view.getUint32(92, true),
    reportsMissed: view.getUint32(96, true),
    verdicts: counters(100, verdictCount),
    losses: counters(100 + 4 * verdictCount, lossCount),
  };
}

function readCourse(view: DataView) {
  const place = (at: number): Vec3 => [0, 4, 8].map((k) => view.getFloat32(at + k, true)) as Vec3;
  const [points, pieces, flags] = [view.getUint16(20, true), view.getUint16(22, true), view.getUint32(24, true)];
  const end = 64 + 16 * points;
  return {
    frame: Number(view.getBigUint64(12, true)),
    goal: flags & 1 ? place(28) : null,
    target: flags & 2 ? place(40) : null,
    looksAt: flags & 4 ? place(52) : null,
    path: Array.from({length: points}, (_, i) => (
      {position: place(64 + 16 * i), clearance_m: view.getFloat32(64 + 16 * i + 12, true)})),
    frontier: Array.from({length: pieces}, (_, i) => (
      {centroid: place(end + 16 * i), voxels: view.getUint32(end + 16 * i + 12, true)})),
  };
}

/// Reads a text message; null for one that is no hello.
export function decodeHello(text: string): Hello | null {
  const message = JSON.parse(text) as Partial<Hello>;
  return message.op === 'hello' ? (message as Hello) : null;
}
