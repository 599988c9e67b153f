// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import * as THREE from 'three';

import type {Block, World} from '../state/world';
import {colourTable, type Colouring} from './colours';

// A voxel is drawn as the three faces that look at the camera: half the work of a whole box.
const kVertex = /* glsl */ `
  attribute vec4 indexAndByte;  // index along x, y, z from the origin voxel; byte
  uniform vec3 origin;
  uniform float voxel, size, cutZ;
  uniform vec2 range;
  uniform bool byHeight;
  varying vec3 vNormal;
  varying vec2 vFace;
  varying float vShade;
  void main() {
    vec3 centre = (origin + indexAndByte.xyz + 0.5) * voxel;
    vec3 side = sign(cameraPosition - centre);
    vec3 axis = normal;
    vec3 corner = position * 0.5;                 // in the frame of the face: outward is +
    vec3 world = centre + corner * mix(vec3(1.0), side, axis) * voxel * size;
    vNormal = axis * side;
    vFace = uv;
    float t = byHeight ? (centre.z - range.x) / max(range.y - range.x, 0.001) : indexAndByte.w / 255.0;
    vShade = clamp(t, 0.0, 1.0);
    gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
    if (centre.z > cutZ) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside of everything
  }`;

const kFragment = /* glsl */ `
  uniform sampler2D colours;
  uniform float edge, light;
  uniform vec3 tint;
  varying vec3 vNormal;
  varying vec2 vFace;
  varying float vShade;
  void main() {
    vec3 base = texture2D(colours, vec2(vShade * 0.996 + 0.002, 0.5)).rgb * tint;
    float lit = 0.70 + 0.30 * vNormal.z + 0.10 * vNormal.x - 0.07 * abs(vNormal.y);
    vec2 rim = min(vFace, 1.0 - vFace);
    vec2 width = fwidth(vFace);
    float line = 1.0 - smoothstep(0.0, 1.5, min(rim.x / width.x, rim.y / width.y));
    float near = 1.0 - smoothstep(0.08, 0.22, max(width.x, width.y));  // no lines on specks
    gl_FragColor = vec4(base * lit * light * (1.0 - edge * line * near), 1.0);
    #include <colorspace_fragment>
  }`;

function threeFaces(): THREE.InstancedBufferGeometry {
  const position: number[] = [];
  const normal: number[] = [];
  const uv: number[] = [];
  const index: number[] = [];
  for (let axis = 0; axis < 3; ++axis) {
    const first = position.length / 3;
    for (const [a, b] of [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const) {
      const corner = [0, 0, 0];
      corner[axis] = 1;
      corner[(axis + 1) % 3] = a;
      corner[(axis + 2) % 3] = b;
      position.push(...corner);
      normal.push(...[0, 1, 2].map((k) => (k === axis ? 1 : 0)));
      uv.push((a + 1) / 2, (b + 1) / 2);
    }
    index.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normal, 3));
  geometry.setAttribute('uv', new THREE.Float32BufferAttribute(uv, 2));
  geometry.setIndex(index);
  return geometry;
}

export type VoxelFilter = (byte: number) => boolean;

/// All voxels of one state, in one draw call. Keeps the voxels of each block, and joins them when blocks have changed.
export class VoxelLayer {
  readonly mesh: THREE.Mesh;
  count = 0;
  #lists = new Map<number, Int16Array>();
  #buffer = new Int16Array(0);
  #origin: [number, number, number] | null = null;
  #material: THREE.ShaderMaterial;
  #filter: VoxelFilter;

  constructor(filter: VoxelFilter, size: number, edge: number) {
    this.#filter = filter;
    this.#material = new THREE.ShaderMaterial({
      vertexShader: kVertex,
      fragmentShader: kFragment,
      side: THREE.DoubleSide,
      uniforms: {
        origin: {value: new THREE.Vector3()},
        voxel: {value: 0.1},
        size: {value: size},
        edge: {value: edge},
        light: {value: 1},
        tint: {value: new THREE.Color(1, 1, 1)},
        cutZ: {value: Infinity},
        range: {value: new THREE.Vector2(0, 2.5)},
        byHeight: {value: true},
        colours: {value: null},
      },
    });
    this.mesh = new THREE.Mesh(threeFaces(), this.#material);
    this.mesh.frustumCulled = false;
    this.setColouring('height');
  }

  setColouring(colouring: Colouring): void {
    const texture = new THREE.DataTexture(colourTable(colouring), 256, 1);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    (this.#material.uniforms.colours!.value as THREE.Texture | null)?.dispose();
    this.#material.uniforms.colours!.value = texture;
    this.#material.uniforms.byHeight!.value = colouring === 'height';
  }
  setPlainColour(colour: THREE.ColorRepresentation): void {
    const c = new THREE.Color(colour);
    const rgb = c.getRGB({r: 0, g: 0, b: 0}, THREE.SRGBColorSpace);
    const table = new Uint8Array([255 * rgb.r, 255 * rgb.g, 255 * rgb.b, 255]);
    const texture = new THREE.DataTexture(table, 1, 1);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.needsUpdate = true;
    this.#material.uniforms.colours!.value = texture;
  }
  setCut(z_m: number): void {
    this.#material.uniforms.cutZ!.value = z_m;
  }
  setRange(low_m: number, high_m: number): void {
    (this.#material.uniforms.range!.value as THREE.Vector2).set(low_m, high_m);
  }

  /// Takes over blocks that have changed; `keys` of all blocks when the layer is shown for the first time.
  update(world: World, keys: Iterable<number>): void {
    for (const key of keys) {
      const block = world.blocks.get(key);
      const list = block ? this.#voxelsOf(block) : null;
      if (list && list.length > 0) this.#lists.set(key, list);
      else this.#lists.delete(key);
    }
    if (world.blocks.size === 0) this.#origin = null;
    this.#join(world.hello?.voxel_m ?? 0.1);
  }
  drop(): void {
    this.#lists.clear();
    this.#join(0.1);
  }

  #voxelsOf(block: Block): Int16Array {
    // Indices on the GPU are int16, from the block that came first: 32767 voxels each way.
    this.#origin ??= [8 * block.x, 8 * block.y, 8 * block.z];
    const [ox, oy, oz] = this.#origin;
    const out: number[] = [];
    for (let i = 0; i < block.voxels.length; ++i) {
      const byte = block.voxels[i]!;
      if (!this.#filter(byte)) continue;
      out.push(8 * block.x + (i & 7) - ox, 8 * block.y + ((i >> 3) & 7) - oy, 8 * block.z + (i >> 6) - oz, byte);
    }
    return Int16Array.from(out);
  }

  #join(voxel_m: number): void {
    let length = 0;
    for (const list of this.#lists.values()) length += list.length;
    const geometry = this.mesh.geometry as THREE.InstancedBufferGeometry;
    if (length > this.#buffer.length || !geometry.getAttribute('indexAndByte')) {
      this.#buffer = new Int16Array(Math.max(4096, Math.ceil(length * 1.5)));
      geometry.dispose(); // the old buffer on the GPU
      const voxels = new THREE.InstancedBufferAttribute(this.#buffer, 4);
      voxels.setUsage(THREE.DynamicDrawUsage);
      geometry.setAttribute('indexAndByte', voxels);
    }
    let at = 0;
    for (const list of this.#lists.values()) {
      this.#buffer.set(list, at);
      at += list.length;
    }
    const voxels = geometry.getAttribute('indexAndByte') as THREE.InstancedBufferAttribute;
    voxels.clearUpdateRanges();
    if (at > 0) voxels.addUpdateRange(0, at);
    voxels.needsUpdate = true;
    this.count = at / 4;
    geometry.instanceCount = this.count;
    this.mesh.visible = this.count > 0;
    const uniforms = this.#material.uniforms;
    uniforms.voxel!.value = voxel_m;
    (uniforms.origin!.value as THREE.Vector3).set(...(this.#origin ?? [0, 0, 0]));
  }
}
