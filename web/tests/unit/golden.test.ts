// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The files that the C++ tests write and read, too (tests/station/wire_test.cpp).

import {readFileSync} from 'node:fs';
import {describe, expect, it} from 'vitest';

import {World} from '../../src/state/world';
import {decode, decodeHello, WireError} from '../../src/wire/decode';
import type {Blocks, Course, Frames, Hello, Checksum, StatusMessage} from '../../src/wire/messages';

function golden(name: string): Buffer {
  return readFileSync(new URL(`../../../tests/golden/station/${name}`, import.meta.url));
}
function bytes(name: string): ArrayBuffer {
  const file = golden(name);
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength) as ArrayBuffer;
}
const hello = (): Hello => decodeHello(golden('hello.json').toString())!;

describe('the golden files', () => {
  it('hello', () => {
    expect(hello()).toEqual({
      op: 'hello', protocol: 1, world: 3, source: 'sim:test', version: '1.2.3', live: true, voxel_m: 0.1,
      free_below: 107, occupied_from: 180, logodds_per_step: 0.04, trigger_m: [1, 1, 0.5], min_range_m: 0.2,
      max_range_m: 5, stages: ['preprocess', 'recentre', 'integrate', 'publish'],
      verdicts: ['integrated', 'no_readings'], losses: ['no_pose', 'pose_gap'],
    });
  });

  it('blocks', () => {
    const message = decode(bytes('blocks.bin')) as Blocks;
    expect(message).toMatchObject({type: 'blocks', sequence: 17, world: 3, clearsFirst: true, frame: 0});
    expect(message.blocks.map(({x, y, z, voxels}) => [x, y, z, voxels?.length ?? null])).toEqual([
      [-3, 2, 1, 512], [-2, 2, 1, 512], [5, 5, 5, null],
    ]);
    expect([...message.blocks[0]!.voxels!.slice(0, 5)]).toEqual([0, 0, 1, 1, 2]);
    expect([...message.blocks[1]!.voxels!.slice(-3)]).toEqual([5, 6, 6]);
  });

  it('frames', () => {
    const message = decode(bytes('frames.bin')) as Frames;
    expect(message.frames).toHaveLength(2);
    expect(message.frames[0]).toEqual({
      stamp_ns: 1_700_000_000_123_456_789n, number: 42, verdict: 1, hasShifted: true, isLate: true, wasHidden: false,
      camera: 2, position: [1.25, -2.5, 999_999.875], rotation: [-0.5, 0.5, -0.5, 0.5],
      stages_ms: [0.25, 0.5, 4, 0.125], readings: 400_000, voxels: 12_345, blocksLeft: 3, width: 848, height: 480,
      fx: 425.5, fy: 426.5, cx: 423.25, cy: 239.75, lost: 9,
    });
    expect(message.frames[1]).toMatchObject({number: 43, verdict: 0, fx: 0, lost: 0});
  });

  it('status', () => {
    expect(decode(bytes('status.bin')) as StatusMessage).toEqual({
      type: 'status', sequence: 19, world: 3, state: 'flying', windowFirst: [-5, 6, -7], windowSize: [27, 28, 9],
      triggerCentre: [0.5, -1.5, 2.5], frame: 5_000_000_000, memoryBytes: 12_345_678_901, blocks: 1, pending: 2,
      clients: 3, rateLimit: 125_000, reportsMissed: 4, verdicts: [100, 7], losses: [8, 9, 10],
    });
  });

  it('course', () => {
    const message = decode(bytes('course.bin')) as Course;
    expect(message).toEqual({
      type: 'course', sequence: 21, world: 3, frame: 5_000_000_001, goal: [8.5, 1.75, 1.25], target: [2.5, -0.5, 1],
      looksAt: null, path: [{position: [1, 0.5, 1.25], clearance_m: 0.75}, {position: [2.5, -0.5, 1], clearance_m: 0.25}],
      frontier: [{centroid: [3, -1, 0.5], voxels: 321}],
    });
    const world = new World();
    world.start(hello());
    world.apply(message);
    expect(world.course).toBe(message);
    world.start({...hello(), world: 4});
    expect(world.course).toBeNull();
  });

  it('the checksum is that of the blocks', () => {
    const world = new World();
    world.start(hello());
    expect(world.apply(decode(bytes('blocks.bin'))!).confirmed).toBe(false);
    const checksum = decode(bytes('checksum.bin')) as Checksum;
    expect(world.digest).toEqual(checksum.digest);
    expect(world.apply(checksum)).toEqual({confirmed: true, isRight: true});
    expect(world.confirmedFrame).toBe(99);
  });
});

describe('what is no message', () => {
  it('is refused whatever it is cut to', () => {
    for (const name of ['blocks.bin', 'frames.bin', 'status.bin', 'checksum.bin', 'course.bin']) {
      const whole = bytes(name);
      for (let size = 0; size < whole.byteLength; ++size) {
        expect(() => decode(whole.slice(0, size)), `${name} cut to ${size}`).toThrow(WireError);
      }
    }
  });
  it('of another version is refused by name', () => {
    const other = bytes('checksum.bin');
    new DataView(other).setUint8(1, 2);
    expect(() => decode(other)).toThrow('the server speaks version 2, this page 1');
  });
  it('of a type that this page does not know is left out', () => {
    const other = bytes('checksum.bin');
    new DataView(other).setUint8(0, 99);
    expect(decode(other)).toBeNull();
  });
});
