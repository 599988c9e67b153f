// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the server says, decoded. docs/formats/station_wire.md has the byte tables.

export interface Hello {
  op: 'hello';
  protocol: number;
  world: number;
  source: string;
  version: string;
  live: boolean;
  voxel_m: number;
  free_below: number;
  occupied_from: number;
  logodds_per_step: number;
  trigger_m: [number, number, number];
  min_range_m: number;
  max_range_m: number;
  stages: string[];
  verdicts: string[];
  losses: string[];
}

export type Vec3 = [number, number, number];

interface Header {
  sequence: number;
  world: number;
}

export interface BlockUpdate {
  x: number;
  y: number;
  z: number;
  voxels: Uint8Array | null; // null: nothing is known there any more
}

export interface Blocks extends Header {
  type: 'blocks';
  clearsFirst: boolean;
  frame: number;
  blocks: BlockUpdate[];
}

export interface FrameRecord {
  stamp_ns: bigint;
  number: number;
  verdict: number;
  hasShifted: boolean;
  isLate: boolean; // the deadline left far blocks out
  wasHidden: boolean;
  camera: number;
  position: Vec3; // of the camera, world [m]
  rotation: [number, number, number, number]; // camera to world: x, y, z, w
  stages_ms: number[];
  readings: number;
  voxels: number;
  blocksLeft: number;
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
  lost: number; // frames lost before the mapper so far
}

export interface Frames extends Header {
  type: 'frames';
  frames: FrameRecord[];
}

export const flightStates = ['waiting', 'flying', 'over', 'saved'] as const;
export type FlightState = (typeof flightStates)[number];

export interface StatusMessage extends Header {
  type: 'status';
  state: FlightState;
  windowFirst: Vec3; // blocks
  windowSize: Vec3;
  triggerCentre: Vec3;
  frame: number;
  memoryBytes: number;
  blocks: number;
  pending: number;
  clients: number;
  rateLimit: number;
  reportsMissed: number;
  verdicts: number[];
  losses: number[];
}

export interface Digest {
  blocks: number;
  occupied: number;
  free: number;
  hashA: number;
  hashB: number;
}

export interface Checksum extends Header {
  type: 'checksum';
  frame: number;
  digest: Digest;
}

export interface CoursePoint {
  position: Vec3; // world [m]
  clearance_m: number; // to the nearest voxel that is not free
}

/// What a planner is at.
export interface Course extends Header {
  type: 'course';
  frame: number;
  goal: Vec3 | null;
  target: Vec3 | null; // where the path leads
  looksAt: Vec3 | null; // what is to be seen from there
  path: CoursePoint[]; // from the vehicle on
  frontier: {centroid: Vec3; voxels: number}[];
}

export type ServerMessage = Blocks | Frames | StatusMessage | Checksum | Course;
