// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import * as THREE from 'three';

import {walk} from '../state/walk';
import type {World} from '../state/world';
import type {Vec3} from '../wire/messages';
import {Cameras, type CameraMode} from './cameras';
import {CourseLayer} from './course_layer';
import {VoxelLayer} from './voxel_layer';
import type {Colouring} from './colours';
import {LineLayer} from './line_layer';
import {frustumCorners, makeVehicle, place} from './vehicle';

export interface Theme {
  background: string;
  grid: string;
  track: string;
  frustum: string;
  window: string;
  trigger: string;
  goal: string;
  frontier: string;
  highlight: string;
  slice: string;
  free: string;
  unknown: string;
}

const kFieldOfView_m = 1; // as in the thesis

/// The 3-D view. Draws when something has changed and not otherwise, in at most a dozen draw calls.
export class Viewer {
  readonly renderer: THREE.WebGLRenderer;
  readonly cameras: Cameras;
  readonly occupied: VoxelLayer;
  readonly free: VoxelLayer;
  readonly unknown: VoxelLayer;
  readonly show = {free: false, unknown: false, boxes: true, course: true, cut: true};
  sliceZ_m = 1.2;
  picked: Vec3 | null = null; // voxel
  frames = 0;
  #scene = new THREE.Scene();
  #lines = new LineLayer();
  #vehicle = makeVehicle();
  readonly course = new CourseLayer();
  #plane: THREE.Mesh;
  #grid: THREE.GridHelper | null = null;
  #theme: Theme;
  #isStale = true;
  #bounds: {low: Vec3; high: Vec3} | null = null;
  #last_ms = 0;
  #lastDraw_ms = 0;
  #drawTook_ms: number | null = 0;
  #lastJoin_ms = 0;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly world: World, theme: Theme) {
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, powerPreference: 'high-performance'});
    this.renderer.info.autoReset = false;
    this.cameras = new Cameras(canvas, () => this.refresh());
    const from = (): number => world.hello?.occupied_from ?? 180;
    const below = (): number => world.hello?.free_below ?? 107;
    this.occupied = new VoxelLayer((byte) => byte >= from(), 1, 0.34);
    this.free = new VoxelLayer((byte) => byte < below(), 0.16, 0);
    this.unknown = new VoxelLayer((byte) => byte >= below() && byte < from(), 0.12, 0);
    this.#plane = new THREE.Mesh(
      new THREE.PlaneGeometry(1, 1),
      new THREE.MeshBasicMaterial({transparent: true, opacity: 0.07, depthWrite: false, side: THREE.DoubleSide}));
    this.#plane.visible = false;
    this.#scene.add(this.occupied.mesh, this.free.mesh, this.unknown.mesh, this.#lines.lines, this.#vehicle, this.#plane,
      this.course.group);
    this.#scene.add(new THREE.HemisphereLight('#ffffff', '#5a6470', 2.6));
    this.#theme = theme;
    this.setTheme(theme);
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    this.#scene.background = new THREE.Color(theme.background);
    if (this.#grid) this.#scene.remove(this.#grid);
    this.#grid?.dispose();
    this.#grid = new THREE.GridHelper(60, 60, theme.grid, theme.grid);
    this.#grid.rotation.x = Math.PI / 2;
    this.#grid.position.z = -0.16;
    const material = this.#grid.material as THREE.LineBasicMaterial;
    material.transparent = true;
    material.opacity = 0.5;
    material.depthWrite = false;
    this.#scene.add(this.#grid);
    this.free.setPlainColour(theme.free);
    this.unknown.setPlainColour(theme.unknown);
    (this.#plane.material as THREE.MeshBasicMaterial).color.set(theme.slice);
    this.refresh();
  }
  setColouring(colouring: Colouring): void {
    this.occupied.setColouring(colouring);
    this.refresh();
  }
  setMode(mode: CameraMode): void {
    this.cameras.setMode(mode);
    this.refresh();
  }
  setShown(what: keyof Viewer['show'], isShown: boolean): void {
    this.show[what] = isShown;
    if (what === 'free' || what === 'unknown') {
      if (isShown) this[what].update(this.world, this.world.blocks.keys());
      else this[what].drop();
    }
    this.refresh();
  }
  refresh(): void {
    this.#isStale = true;
  }
  get bounds(): {low: Vec3; high: Vec3} | null {
    return this.#bounds;
  }

  resize(): void {
    const {clientWidth, clientHeight} = this.canvas;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.course.resize(clientWidth, clientHeight);
    this.cameras.resize(clientWidth, clientHeight);
    this.refresh();
  }

  /// Called for each animation frame.
  draw(now_ms: number): void {
    const dt_s = Math.min(0.5, (now_ms - this.#last_ms) / 1000);
    this.#last_ms = now_ms;
    // Blocks are joined ten times a second at most: the eye sees no more of a growing map. While the map has not come
    // whole for the first time, taking it is worth more than drawing its parts.
    const isWhole = this.world.confirmedFrame >= 0;
    const pause_ms = isWhole ? 100 : 400;
    const sinceDraw_ms = now_ms - this.#lastDraw_ms;
    this.#drawTook_ms ??= sinceDraw_ms; // the browser calls again when it is done
    if (!isWhole && this.#drawTook_ms > 50 && sinceDraw_ms < pause_ms) return;
    if (this.world.changed.size > 0 && now_ms - this.#lastJoin_ms > pause_ms) {
      this.#lastJoin_ms = now_ms;
      this.#takeBlocks();
    }
    const frame = this.world.lastFrame;
    const size: [number, number] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const [low, high] = this.#framed();
    const moves = this.cameras.step(low, high, frame, dt_s, size);
    if (!moves && !this.#isStale) return;
    this.#isStale = false;
    this.#lastDraw_ms = now_ms;
    this.#drawTook_ms = null;
    this.#arrange();
    this.renderer.info.reset();
    this.renderer.render(this.#scene, this.cameras.camera);
    ++this.frames;
  }

  /// A picture of the view as it is.
  picture(): Promise<Blob | null> {
    this.#arrange();
    this.renderer.render(this.#scene, this.cameras.camera);
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }

  /// The first occupied voxel under a point of the canvas [px].
  pick(x: number, y: number): Vec3 | null {
    const voxel_m = this.world.hello?.voxel_m;
    if (!voxel_m) return null;
    const ndc = new THREE.Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(ndc, this.cameras.camera);
    const cut = this.show.cut ? this.sliceZ_m : Infinity;
    let hit: Vec3 | null = null;
    walk(ray.ray.origin.toArray() as Vec3, ray.ray.direction.toArray() as Vec3, voxel_m, 80, ({voxel}) => {
      if ((voxel[2] + 0.5) * voxel_m > cut) return false;
      if (this.world.stateOf(this.world.voxel(...voxel)) !== 'occupied') return false;
      hit = voxel;
      return true;
    });
    return hit;
  }

  #takeBlocks(): void {
    const keys = [...this.world.changed];
    this.world.changed.clear();
    this.occupied.update(this.world, keys);
    if (this.show.free) this.free.update(this.world, keys);
    if (this.show.unknown) this.unknown.update(this.world, keys);
    this.#bounds = this.#measure();
    if (this.#bounds) {
      for (const layer of [this.occupied, this.free, this.unknown]) {
        layer.setRange(this.#bounds.low[2], this.#bounds.high[2]);
      }
    }
    this.refresh();
  }

  /// What orbit and top show: the map, and the goal of a flight.
  #framed(): [Vec3 | null, Vec3 | null] {
    const goal = this.show.course ? this.world.course?.goal : null;
    const bounds = this.#bounds;
    if (!bounds || !goal) return [bounds?.low ?? null, bounds?.high ?? null];
    const withGoal = (corner: Vec3, pick: (a: number, b: number) => number): Vec3 =>
      corner.map((v, k) => pick(v, goal[k]!)) as Vec3;
    return [withGoal(bounds.low, Math.min), withGoal(bounds.high, Math.max)];
  }

  #measure(): {low: Vec3; high: Vec3} | null {
    const low: Vec3 = [Infinity, Infinity, Infinity];
    const high: Vec3 = [-Infinity, -Infinity, -Infinity];
    for (const block of this.world.blocks.values()) {
      if (block.occupied === 0) continue;
      const at = [block.x, block.y, block.z];
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k]!, at[k]!);
        high[k] = Math.max(high[k]!, at[k]! + 1);
      }
    }
    if (low[0] > high[0]) return null;
    const block_m = 8 * (this.world.hello?.voxel_m ?? 0.1);
    const scaled = {low: low.map((v) => v * block_m) as Vec3, high: high.map((v) => v * block_m) as Vec3};
    const layers = [...this.world.layers].filter(([, n]) => n > 0).map(([z]) => z);
    if (layers.length > 0) {
      scaled.low[2] = Math.min(...layers) * (block_m / 8);
      scaled.high[2] = (Math.max(...layers) + 1) * (block_m / 8);
    }
    return scaled;
  }

  /// Puts everything but the voxels in its place.
  #arrange(): void {
    const {world, show} = this;
    const cut = show.cut ? this.sliceZ_m : Infinity;
    for (const layer of [this.occupied, this.free, this.unknown]) layer.setCut(cut);
    const colour = (name: keyof Theme): THREE.Color => new THREE.Color(this.#theme[name]);
    const lines = this.#lines;
    lines.begin();
    lines.polyline(world.track, colour('track'));
    const frame = world.lastFrame;
    this.#vehicle.visible = false;
    if (frame) {
      place(this.#vehicle, frame);
      const corners = frustumCorners(frame, kFieldOfView_m);
      for (const corner of corners) lines.segment(frame.position, corner, colour('frustum'));
      lines.polyline(corners, colour('frustum'), true);
    }
    const status = world.status;
    if (show.boxes && world.hello && status && status.windowSize[0] > 0) {
      const block_m = 8 * world.hello.voxel_m;
      const low = status.windowFirst.map((v) => v * block_m) as Vec3;
      lines.box(low, low.map((v, k) => v + status.windowSize[k]! * block_m) as Vec3, colour('window'));
      const trigger = world.hello.trigger_m;
      const c = status.triggerCentre;
      lines.box(c.map((v, k) => v - trigger[k]!) as Vec3, c.map((v, k) => v + trigger[k]!) as Vec3, colour('trigger'));
    }
    if (this.picked && world.hello) {
      const v = world.hello.voxel_m;
      const grow = 0.04 * v;
      lines.box(this.picked.map((i) => i * v - grow) as Vec3, this.picked.map((i) => (i + 1) * v + grow) as Vec3,
        colour('highlight'));
    }
    lines.end();
    this.course.show(show.course ? world.course : null, cut, this.#theme);
    if (this.#bounds) {
      const {low, high} = this.#bounds;
      this.#plane.visible = true;
      this.#plane.position.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, this.sliceZ_m);
      this.#plane.scale.set(high[0] - low[0] + 0.4, high[1] - low[1] + 0.4, 1);
      if (this.#grid) this.#grid.position.set(Math.round(this.#plane.position.x), Math.round(this.#plane.position.y), low[2] - 0.01);
    } else {
      this.#plane.visible = false;
    }
  }
}
