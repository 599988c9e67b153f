// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import type {FrameRecord, Vec3} from '../wire/messages';

export type CameraMode = 'orbit' | 'follow' | 'top';

/// Where the page looks from. Orbit frames the whole map until the user takes hold of it; follow flies behind the
/// vehicle; top looks straight down.
export class Cameras {
  readonly camera = new THREE.PerspectiveCamera(48, 1, 0.05, 2000);
  readonly controls: OrbitControls;
  mode: CameraMode = 'orbit';
  #isHeld = false;
  #behind_m = 2.6;
  /// Parts of the view that panels cover, so that the map is centred in what is left [px].
  inset = {left: 0, right: 0, top: 0, bottom: 0};

  constructor(element: HTMLElement, onChange: () => void) {
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-6, -6, 7);
    this.controls = new OrbitControls(this.camera, element);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.minDistance = 0.5;
    this.controls.maxDistance = 500;
    this.controls.addEventListener('start', () => (this.#isHeld = true));
    this.controls.addEventListener('change', onChange);
    element.addEventListener('wheel', (event) => {
      if (this.mode === 'follow') this.#behind_m = Math.min(20, Math.max(0.6, this.#behind_m * (1 + event.deltaY / 900)));
      onChange();
    }, {passive: true});
  }

  setMode(mode: CameraMode): void {
    this.mode = mode;
    this.#isHeld = false;
    this.controls.enabled = mode !== 'follow';
    this.controls.enableRotate = mode !== 'top';
    this.controls.mouseButtons.LEFT = mode === 'top' ? THREE.MOUSE.PAN : THREE.MOUSE.ROTATE;
    this.controls.touches.ONE = mode === 'top' ? THREE.TOUCH.PAN : THREE.TOUCH.ROTATE;
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / height;
    const {left, right, top, bottom} = this.inset;
    this.camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    this.camera.updateProjectionMatrix();
  }

  /// Moves on; true while there is still somewhere to go.
  step(low: Vec3 | null, high: Vec3 | null, frame: FrameRecord | null, dt_s: number, size: [number, number]): boolean {
    const ease = 1 - Math.exp(-dt_s * 5);
    if (this.mode === 'follow' && frame) return this.#follow(frame, ease);
    if (low && high && !this.#isHeld) {
      const centre = new THREE.Vector3(...low).add(new THREE.Vector3(...high)).multiplyScalar(0.5);
      const free = Math.min(
        (size[0] - this.inset.left - this.inset.right) / size[0] * this.camera.aspect,
        (size[1] - this.inset.top - this.inset.bottom) / size[1]);
      const radius = Math.max(1.5, new THREE.Vector3(...high).sub(new THREE.Vector3(...low)).length() / 2);
      const distance = (radius * 0.92) / Math.tan((this.camera.fov * Math.PI) / 360) / Math.max(0.25, free);
      const direction = this.mode === 'top' ? new THREE.Vector3(-1e-3, 0, 1) : new THREE.Vector3(-0.62, -0.5, 0.85);
      const goal = direction.normalize().multiplyScalar(distance).add(centre);
      const moves = goal.distanceTo(this.camera.position) > 0.01 * distance;
      if (moves) {
        this.camera.position.lerp(goal, ease);
        this.controls.target.lerp(centre, ease);
      }
      this.controls.update();
      return moves;
    }
    return this.controls.update();
  }

  #follow(frame: FrameRecord, ease: number): boolean {
    const at = new THREE.Vector3(...frame.position);
    const ahead = new THREE.Vector3(0, 0, 1).applyQuaternion(new THREE.Quaternion(...frame.rotation));
    ahead.z = 0;
    if (ahead.lengthSq() < 1e-6) ahead.set(1, 0, 0);
    ahead.normalize();
    const goal = at.clone().addScaledVector(ahead, -this.#behind_m).add(new THREE.Vector3(0, 0, 0.55 * this.#behind_m));
    const target = at.clone().addScaledVector(ahead, 0.6 * this.#behind_m);
    const moves = goal.distanceTo(this.camera.position) > 0.005;
    this.camera.position.lerp(goal, ease);
    this.controls.target.lerp(target, ease);
    this.camera.lookAt(this.controls.target);
    return moves;
  }
}
