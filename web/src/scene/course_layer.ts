// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import * as THREE from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';

import type {Course, CoursePoint} from '../wire/messages';
import type {Theme} from './viewer';

const kTight_m = 0.25;
const kRoomy_m = 0.8;

/// Red where there is hardly room for a small drone, green where there is plenty.
function clearanceColour(clearance_m: number): THREE.Color {
  const t = Math.min(1, Math.max(0, (clearance_m - kTight_m) / (kRoomy_m - kTight_m)));
  return new THREE.Color().setHSL(0.36 * t, 0.85, 0.55);
}

/// What a planner is at: its path, its goal, and the frontier of what is known. Three draw calls.
export class CourseLayer {
  readonly group = new THREE.Group();
  #path = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({vertexColors: true, linewidth: 5}));
  #goal = new THREE.Mesh(
    new THREE.TorusGeometry(0.3, 0.035, 12, 48),
    new THREE.MeshBasicMaterial());
  #frontier = new THREE.Points(
    new THREE.BufferGeometry(),
    new THREE.PointsMaterial({size: 0.22, transparent: true, opacity: 0.85, depthWrite: false}));
  #shown: Course | null = null;
  #cut_m = Infinity;

  constructor() {
    this.#path.frustumCulled = false;
    this.#frontier.frustumCulled = false;
    // Over the voxels: a path on the far side of a wall is still the path.
    this.#path.material.depthTest = false;
    this.#goal.material.depthTest = false;
    for (const part of [this.#frontier, this.#goal, this.#path]) part.renderOrder = 5;
    this.group.add(this.#path, this.#goal, this.#frontier);
    this.group.visible = false;
  }

  resize(width: number, height: number): void {
    this.#path.material.resolution.set(width, height);
  }

  /// What lies above the cut is left out, but for path and goal.
  show(course: Course | null, cut_m: number, theme: Theme): void {
    this.group.visible = course !== null;
    this.#goal.material.color.set(theme.goal);
    this.#frontier.material.color.set(theme.frontier);
    if (!course || (course === this.#shown && cut_m === this.#cut_m)) return;
    this.#shown = course;
    this.#cut_m = cut_m;
    this.#setPath(course.path);
    this.#goal.visible = course.goal !== null;
    if (course.goal) this.#goal.position.set(...course.goal);
    const seen = course.frontier.filter(({centroid}) => centroid[2] <= cut_m);
    this.#frontier.geometry.dispose();
    this.#frontier.geometry = new THREE.BufferGeometry().setFromPoints(
      seen.map(({centroid}) => new THREE.Vector3(...centroid)));
  }

  #setPath(path: CoursePoint[]): void {
    this.#path.visible = path.length > 1;
    if (path.length < 2) return;
    const positions: number[] = [];
    const colours: number[] = [];
    for (let i = 1; i < path.length; ++i) {
      for (const point of [path[i - 1]!, path[i]!]) {
        positions.push(...point.position);
        colours.push(...clearanceColour(point.clearance_m).toArray());
      }
    }
    this.#path.geometry.dispose();
    this.#path.geometry = new LineSegmentsGeometry().setPositions(positions).setColors(colours);
  }
}
