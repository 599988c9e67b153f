// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {blockHash} from '../wire/hash';
import type {Course, Digest, FrameRecord, Hello, ServerMessage, StatusMessage, Vec3} from '../wire/messages';

export const kUnknownVoxel = 127;
export const kEdge = 8;

export interface Block {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  voxels: Uint8Array; // 512, x fastest, then y, then z
  occupied: number;
  free: number;
  hashA: number;
  hashB: number;
}

export type VoxelState = 'free' | 'unknown' | 'occupied';

const kHalf = 65536; // blocks along each axis on either side of the origin
const kFramesKept = 1800;
const kTrackKept = 8000;

function keyOf(x: number, y: number, z: number): number {
  return ((x + kHalf) * 2 * kHalf + (y + kHalf)) * 2 * kHalf + (z + kHalf);
}

/// The map and the flight as the page knows them; knows neither the page nor the connection. Memory is bounded: the
/// server keeps the number of blocks in bounds, the rest are rings.
export class World {
  hello: Hello | null = null;
  status: StatusMessage | null = null;
  frames: FrameRecord[] = [];
  track: Vec3[] = []; // where the camera was [m, world]
  course: Course | null = null; // of the planner, if the flight has one
  digest: Digest = {blocks: 0, occupied: 0, free: 0, hashA: 0, hashB: 0};
  confirmedFrame = -1; // the map was exactly the server's at this frame
  revision = 0; // counts changes of blocks
  readonly blocks = new Map<number, Block>();
  readonly changed = new Set<number>(); // keys, for whoever draws; they clear it
  layers = new Map<number, number>(); // occupied voxels by layer (voxel index z)

  start(hello: Hello): void {
    const isSame = this.hello?.world === hello.world && this.hello.source === hello.source;
    this.hello = hello;
    this.status = null;
    this.clear();
    if (!isSame) {
      this.frames = [];
      this.track = [];
      this.course = null;
    }
  }

  /// Whether the message was a checksum, and the map is what it says.
  apply(message: ServerMessage): {confirmed: boolean; isRight: boolean} {
    switch (message.type) {
      case 'blocks':
        if (message.clearsFirst) this.clear();
        for (const block of message.blocks) this.#put(block.x, block.y, block.z, block.voxels);
        ++this.revision;
        break;
      case 'frames':
        for (const frame of message.frames) this.#book(frame);
        break;
      case 'status':
        this.status = message;
        break;
      case 'course':
        this.course = message;
        break;
      case 'checksum': {
        const isRight = (Object.keys(this.digest) as (keyof Digest)[]).every((k) => this.digest[k] === message.digest[k]);
        if (isRight) this.confirmedFrame = message.frame;
        return {confirmed: true, isRight};
      }
    }
    return {confirmed: false, isRight: true};
  }

  clear(): void {
    for (const key of this.blocks.keys()) this.changed.add(key);
    this.blocks.clear();
    this.layers.clear();
    this.digest = {blocks: 0, occupied: 0, free: 0, hashA: 0, hashB: 0};
    this.confirmedFrame = -1;
    ++this.revision;
  }

  /// The voxel's byte; kUnknownVoxel where nothing is known.
  voxel(x: number, y: number, z: number): number {
    const block = this.blocks.get(keyOf(x >> 3, y >> 3, z >> 3));
    return block ? block.voxels[(x & 7) | ((y & 7) << 3) | ((z & 7) << 6)]! : kUnknownVoxel;
  }

  stateOf(byte: number): VoxelState {
    if (!this.hello || byte >= this.hello.occupied_from) return byte === kUnknownVoxel ? 'unknown' : 'occupied';
    return byte < this.hello.free_below ? 'free' : 'unknown';
  }

  probability(byte: number): number {
    return 1 / (1 + Math.exp(-(byte - kUnknownVoxel) * (this.hello?.logodds_per_step ?? 0.04)));
  }

  get lastFrame(): FrameRecord | null {
    return this.frames[this.frames.length - 1] ?? null;
  }

  #put(x: number, y: number, z: number, voxels: Uint8Array | null): void {
    const key = keyOf(x, y, z);
    const old = this.blocks.get(key);
    if (old) {
      this.#count(old, -1);
      if (!voxels) this.blocks.delete(key);
    }
    this.changed.add(key);
    if (!voxels) return;
    const words = new Uint32Array(voxels.buffer, voxels.byteOffset, voxels.length / 4);
    const block: Block = {
      x, y, z, voxels, occupied: 0, free: 0,
      hashA: blockHash(x, y, z, words, 0),
      hashB: blockHash(x, y, z, words, 1),
    };
    const occupiedFrom = this.hello?.occupied_from ?? 180;
    const freeBelow = this.hello?.free_below ?? 107;
    for (let i = 0; i < voxels.length; ++i) {
      const byte = voxels[i]!;
      if (byte >= occupiedFrom) ++block.occupied;
      else if (byte < freeBelow) ++block.free;
    }
    this.blocks.set(key, block);
    this.#count(block, 1);
  }

  #count(block: Block, sign: 1 | -1): void {
    const sum = this.digest;
    sum.blocks += sign;
    sum.occupied += sign * block.occupied;
    sum.free += sign * block.free;
    sum.hashA = (sum.hashA + sign * block.hashA) >>> 0;
    sum.hashB = (sum.hashB + sign * block.hashB) >>> 0;
    if (block.occupied === 0) return;
    const occupiedFrom = this.hello?.occupied_from ?? 180;
    for (let z = 0; z < kEdge; ++z) {
      let n = 0;
      for (let i = 64 * z; i < 64 * (z + 1); ++i) n += block.voxels[i]! >= occupiedFrom ? 1 : 0;
      if (n > 0) this.layers.set(8 * block.z + z, (this.layers.get(8 * block.z + z) ?? 0) + sign * n);
    }
  }

  #book(frame: FrameRecord): void {
    this.frames.push(frame);
    if (this.frames.length > kFramesKept) this.frames.splice(0, this.frames.length - kFramesKept);
    if (frame.verdict !== 0) return;
    const last = this.track[this.track.length - 1];
    const step = this.hello ? this.hello.voxel_m / 2 : 0.05;
    if (last && Math.hypot(...frame.position.map((v, i) => v - last[i]!)) < step) return;
    this.track.push(frame.position);
    // A long flight keeps its shape with half the points.
    if (this.track.length > kTrackKept) this.track = this.track.filter((_, i) => i % 2 === 0);
  }
}
