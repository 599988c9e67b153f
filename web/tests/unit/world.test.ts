// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {describe, expect, it} from 'vitest';

import {EventLog, FrameRate} from '../../src/state/events';
import {occupiedAsPly} from '../../src/state/ply';
import {sourceRates} from '../../src/state/rates';
import {opticalAxisProfile, rotate, walk} from '../../src/state/walk';
import {World} from '../../src/state/world';
import type {Blocks, FrameRecord, Hello, Vec3} from '../../src/wire/messages';

const hello: Hello = {
  op: 'hello', protocol: 1, world: 1, source: 'sim:test', version: '1', live: true, voxel_m: 0.1, free_below: 107,
  occupied_from: 180, logodds_per_step: 0.04, trigger_m: [1, 1, 1], min_range_m: 0.2, max_range_m: 5,
  stages: ['a', 'b', 'c', 'd'], verdicts: ['integrated', 'no_readings'], losses: ['no_pose', 'overload'],
};
const frame = (number: number, position: Vec3 = [0, 0, 0]): FrameRecord => ({
  stamp_ns: BigInt(number), number, verdict: 0, hasShifted: false, isLate: false, wasHidden: false, camera: 0, position,
  rotation: [0, 0, 0, 1], stages_ms: [1, 1, 1, 1], readings: 1, voxels: 1, blocksLeft: 0, width: 10, height: 10, fx: 5,
  fy: 5, cx: 4.5, cy: 4.5, lost: 0,
});
const blocks = (list: [number, number, number, number | null][], clearsFirst = false): Blocks => ({
  type: 'blocks', sequence: 0, world: 1, clearsFirst, frame: 1,
  blocks: list.map(([x, y, z, byte]) => ({x, y, z, voxels: byte === null ? null : new Uint8Array(512).fill(byte)})),
});
function started(): World {
  const world = new World();
  world.start(hello);
  return world;
}

describe('World', () => {
  it('has the same digest however it came to its blocks', () => {
    const one = started();
    one.apply(blocks([[0, 0, 0, 200], [1, 0, 0, 50], [-5, -6, -7, 127]]));
    const other = started();
    other.apply(blocks([[9, 9, 9, 255], [1, 0, 0, 20]]));
    other.apply(blocks([[-5, -6, -7, 127], [9, 9, 9, null], [1, 0, 0, 50]]));
    other.apply(blocks([[0, 0, 0, 200], [8, 8, 8, null]]));
    expect(other.digest).toEqual(one.digest);
    expect(one.digest).toMatchObject({blocks: 3, occupied: 512, free: 512});
    expect([...other.layers].filter(([, n]) => n > 0)).toEqual([...one.layers]);
    other.apply(blocks([[0, 0, 0, 201]]));
    expect(other.digest).not.toEqual(one.digest);
  });

  it('drops everything when a message says so', () => {
    const world = started();
    world.apply(blocks([[0, 0, 0, 200]]));
    world.changed.clear();
    world.apply(blocks([[3, 0, 0, 200]], true));
    expect(world.digest.blocks).toBe(1);
    expect(world.changed.size).toBe(2); // whoever draws must take one away and put one in
  });

  it('finds voxels on either side of the origin', () => {
    const world = started();
    const update = blocks([[-1, 0, 2, 127]]);
    update.blocks[0]!.voxels![7 | (3 << 3) | (5 << 6)] = 222;
    world.apply(update);
    expect(world.voxel(-1, 3, 21)).toBe(222);
    expect(world.voxel(0, 3, 21)).toBe(127);
    expect(world.stateOf(222)).toBe('occupied');
    expect(world.stateOf(106)).toBe('free');
    expect(world.stateOf(150)).toBe('unknown');
    expect(world.probability(127)).toBeCloseTo(0.5, 12);
    expect(world.probability(255)).toBeCloseTo(0.99406, 5);
  });

  it('is bounded over a long flight', () => {
    const world = started();
    for (let i = 0; i < 40_000; ++i) {
      world.apply({type: 'frames', sequence: i, world: 1, frames: [frame(i, [i, 0, 0])]});
    }
    expect(world.frames.length).toBeLessThanOrEqual(1800);
    expect(world.track.length).toBeLessThanOrEqual(8000);
    expect(world.track[0]).toEqual([0, 0, 0]); // from its beginning
  });

  it('keeps the flight when the same server comes back, and not that of another', () => {
    const world = started();
    world.apply({type: 'frames', sequence: 0, world: 1, frames: [frame(1)]});
    world.start(hello);
    expect(world.frames).toHaveLength(1);
    world.start({...hello, source: 'tum:other'});
    expect(world.frames).toHaveLength(0);
  });

  it('writes the occupied voxels as PLY', async () => {
    const world = started();
    world.apply(blocks([[0, 0, 0, 200], [1, 0, 0, 50]]));
    const text = await occupiedAsPly(world).text();
    expect(text).toContain('element vertex 512\n');
    expect((await occupiedAsPly(world).arrayBuffer()).byteLength).toBe(text.indexOf('end_header\n') + 11 + 512 * 13);
  });
});

describe('walk', () => {
  it('visits the voxels of a ray, face by face', () => {
    let seed = 1;
    const random = (): number => ((seed = (seed * 48271) % 2147483647) / 2147483647) * 2 - 1;
    for (let i = 0; i < 200; ++i) {
      const origin: Vec3 = [random(), random(), random()];
      const direction: Vec3 = [random(), random(), random()];
      const voxels: Vec3[] = [];
      walk(origin, direction, 0.1, 3, ({voxel, distance_m}) => {
        const norm = Math.hypot(...direction);
        // The point just behind the entry lies in the voxel.
        const inside = voxel.every((c, k) => {
          const p = origin[k]! + ((distance_m + 1e-9) * direction[k]!) / norm;
          return p > c * 0.1 - 1e-6 && p < (c + 1) * 0.1 + 1e-6;
        });
        expect(inside).toBe(true);
        voxels.push(voxel);
        return false;
      });
      for (let k = 1; k < voxels.length; ++k) {
        expect(voxels[k]!.reduce((sum, v, a) => sum + Math.abs(v - voxels[k - 1]![a]!), 0)).toBe(1);
      }
    }
  });

  it('gives the profile along the optical axis', () => {
    const world = started();
    world.apply(blocks([[0, 0, 0, 40], [0, 0, 1, 240]]));
    world.apply({type: 'frames', sequence: 0, world: 1, frames: [frame(1, [0.05, 0.05, 0.05])]});
    const profile = opticalAxisProfile(world, 2);
    expect(profile.map((p) => p.byte)).toEqual([...Array(8).fill(40), ...Array(8).fill(240), ...Array(5).fill(127)]);
    expect(profile[8]!.distance_m).toBeCloseTo(0.75, 12);
  });

  it('rotates', () => {
    const s = Math.SQRT1_2;
    expect(rotate([0, 0, s, s], [1, 0, 0]).map((v) => Math.round(v * 1e9) / 1e9 + 0)).toEqual([0, 1, 0]);
  });
});

describe('EventLog', () => {
  it('keeps what matters in sight however often the window moves', () => {
    const log = new EventLog();
    for (let i = 0; i < 100; ++i) {
      log.add('shift', 'the window moved');
      if (i % 20 === 0) log.add('refused', `refused: ${i}`);
    }
    expect(log.list.filter((event) => event.kind === 'shift').map((event) => event.count)).toEqual([100]);
    expect(log.list.slice(0, 5).every((event) => event.kind === 'refused')).toBe(true);
  });

  it('tells refused frames, and lost poses from other losses', () => {
    const log = new EventLog();
    log.frames([{...frame(1), verdict: 1}, {...frame(2), verdict: 1}, {...frame(3), isLate: true}], hello);
    const status = {
      type: 'status', sequence: 0, world: 1, state: 'flying', windowFirst: [0, 0, 0], windowSize: [0, 0, 0],
      triggerCentre: [0, 0, 0], frame: 0, memoryBytes: 0, blocks: 0, pending: 0, clients: 1, rateLimit: 0,
      reportsMissed: 0, verdicts: [1, 2],
    } as const;
    const told = (losses: number[], now_ms: number): void =>
      log.status({...status, verdicts: [1, 2], losses, windowFirst: [0, 0, 0], windowSize: [0, 0, 0], triggerCentre: [0, 0, 0]}, hello, now_ms);
    told([90, 0], 5); // before the page was there
    told([90, 4], 10);
    expect(log.poseLostAt_ms).toBe(-Infinity);
    told([93, 4], 20);
    expect(log.poseLostAt_ms).toBe(20);
    expect(log.list.map((e) => [e.text, e.count])).toEqual([
      ['lost: no pose', 3], ['lost: overload', 4], ['deadline: far blocks left for later', 1], ['refused: no readings', 2],
    ]);
    log.forget();
    told([99, 4], 30); // the link was lost for a while
    expect(log.poseLostAt_ms).toBe(-Infinity);
    for (let i = 0; i < 1000; ++i) log.add(i % 2 === 0 ? 'shift' : 'late', String(i));
    expect(log.list.length).toBeLessThanOrEqual(60);
  });
});

describe('sourceRates', () => {
  it('are those of the stamps, also across a gap', () => {
    const frames = Array.from({length: 60}, (_, i) => ({...frame(i), stamp_ns: BigInt(i) * 20_000_000n + (i < 30 ? 0n : 2_000_000_000n)}));
    const rates = sourceRates(frames);
    expect(rates[0]).toBe(0);
    expect(rates[20]).toBeCloseTo(50, 9);
    expect(rates[35]).toBeCloseTo(15 / 2.3, 9);
    expect(rates[59]).toBeCloseTo(50, 9);
  });
});

describe('FrameRate', () => {
  it('is that of the last two seconds', () => {
    const rate = new FrameRate();
    expect(rate.at(0)).toBeNull();
    for (let t = 0; t <= 4000; t += 50) rate.add(2, t);
    expect(rate.at(4000)).toBeCloseTo(40, 9);
    expect(rate.at(7000)).toBeNull();
    for (let i = 0; i < 5000; ++i) rate.add(1, 8000 + i / 10); // out of sight, where nobody asks
    expect(rate.kept).toBeLessThanOrEqual(200);
    expect(rate.at(8500)).toBeCloseTo(10_000, 6);
  });
});
