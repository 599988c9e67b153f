// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import * as THREE from 'three';
import {mergeGeometries} from 'three/addons/utils/BufferGeometryUtils.js';

import type {FrameRecord, Vec3} from '../wire/messages';

function part(geometry: THREE.BufferGeometry, colour: string, x = 0, y = 0, z = 0): THREE.BufferGeometry {
  geometry.translate(x, y, z);
  const c = new THREE.Color(colour);
  const n = geometry.getAttribute('position').count;
  const colours = Float32Array.from({length: 3 * n}, (_, i) => [c.r, c.g, c.b][i % 3]!);
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return geometry.index ? geometry.toNonIndexed() : geometry;
}

/// A small quadrotor, nose along x, in one mesh. It stands where the camera is.
export function makeVehicle(): THREE.Mesh {
  const parts = [
    part(new THREE.BoxGeometry(0.2, 0.1, 0.05), '#f4f1ea'),
    part(new THREE.BoxGeometry(0.05, 0.08, 0.035), '#16202c', 0.1, 0, 0),
    part(new THREE.SphereGeometry(0.022, 12, 8), '#ff7a45', -0.1, 0, 0.02),
  ];
  for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]] as const) {
    const arm = new THREE.BoxGeometry(0.2, 0.022, 0.016).rotateZ(Math.atan2(y, x));
    parts.push(part(arm, '#4a5868', 0.08 * x, 0.08 * y, 0.012));
    const rotor = new THREE.CylinderGeometry(0.085, 0.085, 0.006, 28).rotateX(Math.PI / 2);
    parts.push(part(rotor, x > 0 ? '#ff7a45' : '#93a4b8', 0.145 * x, 0.145 * y, 0.035));
  }
  const material = new THREE.MeshLambertMaterial({vertexColors: true, emissive: '#3a3a3a', emissiveIntensity: 0.6});
  const mesh = new THREE.Mesh(mergeGeometries(parts), material);
  mesh.visible = false;
  return mesh;
}

const T_camera_body = new THREE.Quaternion().setFromRotationMatrix(
  // Body x is camera z, body y is -camera x, body z is -camera y.
  new THREE.Matrix4().makeBasis(new THREE.Vector3(0, 0, 1), new THREE.Vector3(-1, 0, 0), new THREE.Vector3(0, -1, 0)),
);

export function place(mesh: THREE.Object3D, frame: FrameRecord): void {
  mesh.visible = true;
  mesh.position.set(...frame.position);
  mesh.quaternion.set(...frame.rotation).multiply(T_camera_body);
}

/// Corners of the field of view at a depth along the optical axis [m, world]: top left, top right, bottom right, bottom left.
export function frustumCorners(frame: FrameRecord, depth_m: number): Vec3[] {
  if (frame.fx === 0) return [];
  const q = new THREE.Quaternion(...frame.rotation);
  return ([[0, 0], [frame.width - 1, 0], [frame.width - 1, frame.height - 1], [0, frame.height - 1]] as const).map(
    ([u, v]) =>
      new THREE.Vector3(((u - frame.cx) / frame.fx) * depth_m, ((v - frame.cy) / frame.fy) * depth_m, depth_m)
        .applyQuaternion(q)
        .add(new THREE.Vector3(...frame.position))
        .toArray() as Vec3,
  );
}
