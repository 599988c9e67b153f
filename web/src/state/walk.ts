// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {Vec3} from '../wire/messages';
import type {World} from './world';

export interface Step {
  voxel: Vec3;
  distance_m: number; // where the ray enters the voxel
}

/// Visits the voxels that a ray crosses, near to far (Amanatides & Woo 1987), until `visit` says stop.
export function walk(
  origin: Vec3, direction: Vec3, voxel_m: number, length_m: number, visit: (step: Step) => boolean,
): void {
  const norm = Math.hypot(...direction);
  const d = direction.map((v) => v / norm) as Vec3;
  const voxel = origin.map((v) => Math.floor(v / voxel_m)) as Vec3;
  const step = d.map(Math.sign) as Vec3;
  const next = d.map((v, i) =>
    v === 0 ? Infinity : ((voxel[i]! + (v > 0 ? 1 : 0)) * voxel_m - origin[i]!) / v) as Vec3;
  const delta = d.map((v) => (v === 0 ? Infinity : Math.abs(voxel_m / v))) as Vec3;
  let at = 0;
  while (at <= length_m) {
    if (visit({voxel: [...voxel], distance_m: at})) return;
    const axis = next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : next[1] <= next[2] ? 1 : 2;
    at = next[axis];
    next[axis] += delta[axis];
    voxel[axis] += step[axis];
  }
}

/// A vector turned by a unit quaternion x, y, z, w.
export function rotate(q: readonly number[], v: Vec3): Vec3 {
  const [x, y, z, w] = q as [number, number, number, number];
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

export interface ProfilePoint {
  distance_m: number;
  byte: number;
}

/// The bytes of the voxels along the optical axis.
export function opticalAxisProfile(world: World, length_m: number): ProfilePoint[] {
  const frame = world.lastFrame;
  if (!frame || !world.hello) return [];
  const points: ProfilePoint[] = [];
  walk(frame.position, rotate(frame.rotation, [0, 0, 1]), world.hello.voxel_m, length_m, (step) => {
    points.push({distance_m: step.distance_m, byte: world.voxel(...step.voxel)});
    return false;
  });
  return points;
}
