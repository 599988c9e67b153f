// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// Foxglove's own client and decoders against the real server: no line of them is ours.

import {FoxgloveClient, type Channel} from '@foxglove/ws-protocol';
import {parse} from '@foxglove/rosmsg';
import {MessageReader} from '@foxglove/rosmsg2-serialization';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {afterAll, beforeAll, describe, expect, it} from 'vitest';
import WebSocket from 'ws';

import {voxelsOf, RunningProgram} from './program';

const folder = mkdtempSync(join(tmpdir(), 'swiftlet-fox-'));
const map = join(folder, 'flat.swl');
let program: RunningProgram;

beforeAll(async () => {
  program = await RunningProgram.start(
    ['map', 'sim:apartment', '--set', 'map.voxel_m=0.1', '--frames', '40', '-o', map, '--view', '--stay', '--listen', '127.0.0.1:0'],
    folder);
});
afterAll(async () => {
  await program.end('SIGKILL');
  rmSync(folder, {recursive: true, force: true});
});

interface Fields {name: string; offset: number; type: number}
type Message = Record<string, any>;

/// The newest message of each channel, read with the schema that came with it, until `isEnough`.
async function listen(subprotocol: string, isEnough: (newest: Map<string, Message>) => boolean): Promise<Map<string, Message>> {
  const socket = new WebSocket(`ws://127.0.0.1:${program.port}/`, [subprotocol]);
  const client = new FoxgloveClient({ws: socket as never});
  const topics = new Map<number, {channel: Channel; read: (data: DataView) => Message}>();
  const newest = new Map<string, Message>();
  await new Promise<void>((resolve, reject) => {
    client.on('error', reject);
    client.on('advertise', (channels) => {
      for (const channel of channels) {
        const reader = channel.encoding === 'cdr' ? new MessageReader(parse(channel.schema, {ros2: true})) : null;
        const read = (data: DataView): Message =>
          reader ? reader.readMessage(data) as Message : (JSON.parse(new TextDecoder().decode(data)) as Message);
        topics.set(client.subscribe(channel.id), {channel, read});
      }
    });
    client.on('message', (event) => {
      const topic = topics.get(event.subscriptionId)!;
      const {buffer, byteOffset, byteLength} = event.data;
      newest.set(topic.channel.topic, topic.read(new DataView(buffer as ArrayBuffer, byteOffset, byteLength)));
      if (isEnough(newest)) resolve();
    });
  });
  client.close();
  return newest;
}

const kTopics = ['/map/occupied', '/map/window', '/vehicle', '/tf', '/camera/calibration', '/camera/depth', '/statistics'];

describe.each(['foxglove.sdk.v1', 'foxglove.websocket.v1'])('a client that speaks %s', (subprotocol) => {
  it('reads every channel, and counts the voxels that the map file holds', async () => {
    // The depth image comes while the flight goes on: the first client is in time for it.
    const needed = subprotocol === 'foxglove.sdk.v1' ? kTopics : kTopics.filter((t) => t !== '/camera/depth');
    const first = await listen(subprotocol, (newest) => needed.every((topic) => newest.has(topic)));
    await program.says(/frames +\d+ in/);
    // The station looks at the map twenty times a second: the last look may be yet to come.
    await new Promise((resolve) => setTimeout(resolve, 1000));
    const newest = await listen(subprotocol, (n) => needed.every((t) => t === '/camera/depth' || n.has(t)));

    const cloud = newest.get('/map/occupied')!;
    const voxels = voxelsOf(map);
    expect(cloud.frame_id).toBe('map');
    expect(cloud.fields.map((f: Fields) => [f.name, f.offset, f.type])).toEqual([['x', 0, 7], ['y', 4, 7], ['z', 8, 7], ['log_odds', 12, 1]]);
    expect(cloud.data.length / cloud.point_stride).toBe(voxels.occupied);
    expect(cloud.data[12]).toBeGreaterThanOrEqual(180);

    const grid = newest.get('/map/window')!;
    expect(grid.data.length % grid.slice_stride).toBe(0);
    expect(grid.slice_stride).toBe(grid.row_stride * grid.row_count);
    expect(grid.row_stride).toBe(grid.cell_stride * grid.column_count);
    expect(grid.cell_size).toEqual({x: 0.1, y: 0.1, z: 0.1});
    // Each point of the cloud inside the grid is an occupied voxel there, at its place.
    const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
    let inside = 0;
    for (let i = 0; i < voxels.occupied; ++i) {
      const at = ['x', 'y', 'z'].map((axis, k) =>
        Math.round((view.getFloat32(i * 13 + 4 * k, true) - grid.pose.position[axis]) / 0.1 - 0.5));
      const [x, y, z] = at as [number, number, number];
      const depth = grid.data.length / grid.slice_stride;
      if (x < 0 || y < 0 || z < 0 || x >= grid.column_count || y >= grid.row_count || z >= depth) continue;
      ++inside;
      expect(grid.data[z * grid.slice_stride + y * grid.row_stride + x * grid.cell_stride]).toBe(cloud.data[i * 13 + 12]);
    }
    expect(inside).toBeGreaterThan(1000);

    const [transform] = newest.get('/tf')!.transforms;
    expect([transform.parent_frame_id, transform.child_frame_id]).toEqual(['map', 'camera']);
    const {x, y, z, w} = transform.rotation;
    expect(Math.hypot(x, y, z, w)).toBeCloseTo(1, 9);

    const [entity] = newest.get('/vehicle')!.entities;
    expect(entity.id).toBe('vehicle');
    expect(entity.cubes).toHaveLength(2);
    expect(entity.cubes[0].pose.position).toEqual(transform.translation);
    expect(entity.lines[0].points).toHaveLength(5);
    expect(entity.lines[0].points[1].z).toBeCloseTo(1, 9); // the field of view, drawn to 1 m

    const camera = newest.get('/camera/calibration')!;
    expect(camera.k[0]).toBeGreaterThan(100);
    expect(camera.p[0]).toBe(camera.k[0]);

    const depth = first.get('/camera/depth');
    if (needed.includes('/camera/depth')) {
      expect(depth).toMatchObject({encoding: '16UC1', width: camera.width, height: camera.height, frame_id: 'camera'});
      expect(depth!.data.length).toBe(depth!.step * depth!.height);
      expect(Math.max(...new Uint16Array(depth!.data.slice().buffer).slice(0, 50_000))).toBeGreaterThan(300); // [mm]
    }
    const statistics = newest.get('/statistics')!;
    expect(statistics).toMatchObject({occupied: voxels.occupied, free: voxels.free});
    expect(statistics.verdicts.integrated).toBe(statistics.frame_count);
  });
});
