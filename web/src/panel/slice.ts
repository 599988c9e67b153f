// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {World} from '../state/world';
import {rotate} from '../state/walk';
import type {Vec3} from '../wire/messages';
import {css, element, sharp} from './dom';

interface Fit {
  scale: number; // px per voxel
  left: number; // voxel y at the left edge: y points left
  top: number; // voxel x at the upper edge: x points up
}

/// One layer from above, x up and y left, with the thesis's colours: occupied blue, free yellow, unknown white.
export class Slice {
  z_m = 1.2;
  followsCamera = true;
  onMove: (z_m: number) => void = () => {};
  onPoint: (voxel: Vec3 | null, isKept: boolean) => void = () => {};
  #canvas = element<HTMLCanvasElement>('slice');
  #rail = element<HTMLCanvasElement>('rail');
  #fit: Fit | null = null;
  #image: ImageData | null = null;

  constructor(private readonly world: World) {
    const drag = (event: PointerEvent): void => {
      const {top, height} = this.#rail.getBoundingClientRect();
      const [low, high] = this.#layers();
      const z = high - ((event.clientY - top) / height) * (high - low);
      this.moveTo((Math.floor(Math.min(high - 1, Math.max(low, z))) + 0.5) * this.#voxel_m, true);
    };
    this.#rail.addEventListener('pointerdown', (event) => {
      this.#rail.setPointerCapture(event.pointerId);
      drag(event);
    });
    this.#rail.addEventListener('pointermove', (event) => {
      if (this.#rail.hasPointerCapture(event.pointerId)) drag(event);
    });
    this.#rail.addEventListener('keydown', (event) => {
      const layers = {ArrowUp: 1, ArrowDown: -1, PageUp: 5, PageDown: -5}[event.key];
      if (!layers) return;
      event.preventDefault();
      this.moveBy(layers);
    });
    this.#canvas.addEventListener('pointermove', (event) => this.onPoint(this.#voxelAt(event), false));
    this.#canvas.addEventListener('pointerleave', () => this.onPoint(null, false));
    this.#canvas.addEventListener('click', (event) => this.onPoint(this.#voxelAt(event), true));
  }

  moveTo(z_m: number, byHand: boolean): void {
    if (byHand) this.followsCamera = false;
    this.z_m = z_m;
    this.onMove(z_m);
  }
  moveBy(layers: number): void {
    const [low, high] = this.#layers();
    const z = Math.min(high - 1, Math.max(low, this.layer + layers));
    this.moveTo((z + 0.5) * this.#voxel_m, true);
  }
  get layer(): number {
    return Math.floor(this.z_m / this.#voxel_m + 1e-9);
  }

  draw(): void {
    this.#drawLayer();
    this.#drawRail();
  }

  get #voxel_m(): number {
    return this.world.hello?.voxel_m ?? 0.1;
  }
  /// First layer with an occupied voxel, and the one behind the last.
  #layers(): [number, number] {
    const layers = [...this.world.layers].filter(([, n]) => n > 0).map(([z]) => z);
    return layers.length > 0 ? [Math.min(...layers), Math.max(...layers) + 1] : [0, 25];
  }

  #drawLayer(): void {
    const target = sharp(this.#canvas);
    if (!target) return;
    const {g, width, height} = target;
    const z = this.layer;
    let [lowX, lowY, highX, highY] = [Infinity, Infinity, -Infinity, -Infinity];
    const blocks = [...this.world.blocks.values()].filter((block) => {
      if (block.occupied > 0 || block.z === z >> 3) {
        lowX = Math.min(lowX, 8 * block.x);
        lowY = Math.min(lowY, 8 * block.y);
        highX = Math.max(highX, 8 * block.x + 8);
        highY = Math.max(highY, 8 * block.y + 8);
      }
      return block.z === z >> 3;
    });
    this.#fit = null;
    if (lowX > highX) return;
    const [voxelsX, voxelsY] = [highX - lowX, highY - lowY];
    const scale = Math.min(width / voxelsY, height / voxelsX);
    this.#fit = {
      scale,
      left: highY + (width / scale - voxelsY) / 2,
      top: highX + (height / scale - voxelsX) / 2,
    };
    if (!this.#image || this.#image.width !== voxelsY || this.#image.height !== voxelsX) {
      this.#image = new ImageData(voxelsY, voxelsX);
    }
    const pixels = new Uint32Array(this.#image.data.buffer);
    pixels.fill(0);
    const colours = {occupied: abgr(css('--occupied')), free: abgr(css('--free')), unknown: 0};
    for (const block of blocks) {
      for (let y = 0; y < 8; ++y) {
        for (let x = 0; x < 8; ++x) {
          const byte = block.voxels[x | (y << 3) | ((z & 7) << 6)]!;
          const row = highX - 1 - (8 * block.x + x);
          pixels[row * voxelsY + (highY - 1 - (8 * block.y + y))] = colours[this.world.stateOf(byte)];
        }
      }
    }
    const sheet = new OffscreenCanvas(voxelsY, voxelsX);
    sheet.getContext('2d')!.putImageData(this.#image, 0, 0);
    g.imageSmoothingEnabled = false;
    const [x0, y0] = this.#toPixel([highX, highY]);
    g.fillStyle = css('--unknown');
    g.fillRect(0, 0, width, height);
    g.drawImage(sheet, x0, y0, voxelsY * scale, voxelsX * scale);
    this.#drawMarks(g);
  }

  #drawMarks(g: CanvasRenderingContext2D): void {
    const v = this.#voxel_m;
    const at = (p: readonly number[]): [number, number] => this.#toPixel([p[0]! / v, p[1]! / v]);
    const status = this.world.status;
    g.lineWidth = 1.5;
    if (status && status.windowSize[0] > 0) {
      g.strokeStyle = css('--window');
      const [ax, ay] = this.#toPixel([8 * (status.windowFirst[0] + status.windowSize[0]), 8 * (status.windowFirst[1] + status.windowSize[1])]);
      const [bx, by] = this.#toPixel([8 * status.windowFirst[0], 8 * status.windowFirst[1]]);
      g.strokeRect(ax, ay, bx - ax, by - ay);
    }
    g.strokeStyle = css('--track');
    g.beginPath();
    for (const p of this.world.track) g.lineTo(...at(p));
    g.stroke();
    const frame = this.world.lastFrame;
    if (!frame) return;
    const ahead = rotate(frame.rotation, [0, 0, 1]);
    const angle = Math.atan2(ahead[1], ahead[0]);
    const [x, y] = at(frame.position);
    g.save();
    g.translate(x, y);
    g.rotate(-angle);
    g.fillStyle = css('--accent');
    g.strokeStyle = css('--unknown');
    g.beginPath();
    for (const [px, py] of [[0, -9], [6, 7], [0, 3.5], [-6, 7]] as const) g.lineTo(px, py);
    g.closePath();
    g.fill();
    g.stroke();
    g.restore();
  }

  #drawRail(): void {
    const target = sharp(this.#rail);
    if (!target) return;
    const {g, width, height} = target;
    const [low, high] = this.#layers();
    const step = height / (high - low);
    const most = Math.max(1, ...this.world.layers.values());
    g.fillStyle = css('--muted');
    for (const [z, n] of this.world.layers) {
      const length = (Math.sqrt(n / most)) * (width - 6);
      g.fillRect(width - length, height - (z - low + 1) * step, length, Math.max(1, step - 1));
    }
    const y = height - (this.z_m / this.#voxel_m - low) * step;
    g.fillStyle = css('--accent');
    g.fillRect(0, Math.round(y) - 1, width, 2);
    g.beginPath();
    g.arc(5, Math.round(y), 5, 0, 2 * Math.PI);
    g.fill();
    this.#rail.setAttribute('aria-valuemin', (low * this.#voxel_m).toFixed(2));
    this.#rail.setAttribute('aria-valuemax', (high * this.#voxel_m).toFixed(2));
    this.#rail.setAttribute('aria-valuenow', this.z_m.toFixed(2));
  }

  #toPixel([x, y]: [number, number]): [number, number] {
    const fit = this.#fit!;
    return [(fit.left - y) * fit.scale, (fit.top - x) * fit.scale];
  }
  #voxelAt(event: MouseEvent): Vec3 | null {
    if (!this.#fit) return null;
    const box = this.#canvas.getBoundingClientRect();
    return [
      Math.floor(this.#fit.top - (event.clientY - box.top) / this.#fit.scale),
      Math.floor(this.#fit.left - (event.clientX - box.left) / this.#fit.scale),
      this.layer,
    ];
  }
}

/// '#rrggbb' as a pixel of ImageData on a little-endian machine.
function abgr(hex: string): number {
  const rgb = parseInt(hex.slice(1), 16);
  return ((255 << 24) | ((rgb & 255) << 16) | (rgb & 0xff00) | (rgb >> 16)) >>> 0;
}
