// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import * as THREE from 'three';

import type {Vec3} from '../wire/messages';

/// Coloured line segments in one draw call, written anew whenever something changes.
export class LineLayer {
  readonly lines: THREE.LineSegments;
  #position = new Float32Array(0);
  #colour = new Float32Array(0);
  #count = 0;

  constructor() {
    const material = new THREE.LineBasicMaterial({vertexColors: true, transparent: true});
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), material);
    this.lines.frustumCulled = false;
    this.#grow(3 * 1024);
  }

  begin(): void {
    this.#count = 0;
  }
  segment(a: Vec3, b: Vec3, colour: THREE.Color): void {
    if (3 * (this.#count + 2) > this.#position.length) this.#grow(2 * this.#position.length);
    for (const p of [a, b]) {
      this.#position.set(p, 3 * this.#count);
      colour.toArray(this.#colour, 3 * this.#count);
      ++this.#count;
    }
  }
  polyline(points: readonly Vec3[], colour: THREE.Color, isClosed = false): void {
    for (let i = 1; i < points.length; ++i) this.segment(points[i - 1]!, points[i]!, colour);
    if (isClosed && points.length > 2) this.segment(points[points.length - 1]!, points[0]!, colour);
  }
  box(low: Vec3, high: Vec3, colour: THREE.Color): void {
    const corner = (i: number): Vec3 => [0, 1, 2].map((k) => ((i >> k) & 1 ? high[k]! : low[k]!)) as Vec3;
    for (let i = 0; i < 8; ++i) {
      for (const bit of [1, 2, 4]) if (!(i & bit)) this.segment(corner(i), corner(i | bit), colour);
    }
  }
  end(): void {
    const geometry = this.lines.geometry;
    geometry.setDrawRange(0, this.#count);
    geometry.getAttribute('position').needsUpdate = true;
    geometry.getAttribute('color').needsUpdate = true;
    this.lines.visible = this.#count > 0;
  }

  #grow(length: number): void {
    const position = new Float32Array(length);
    const colour = new Float32Array(length);
    position.set(this.#position);
    colour.set(this.#colour);
    this.#position = position;
    this.#colour = colour;
    this.lines.geometry.dispose();
    this.lines.geometry.boundingSphere = new THREE.Sphere(); // never culled: nobody need measure it
    this.lines.geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
    this.lines.geometry.setAttribute('color', new THREE.BufferAttribute(colour, 3));
  }
}
