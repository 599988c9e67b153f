// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {opticalAxisProfile} from '../state/walk';
import type {World} from '../state/world';
import {css, element, sharp} from './dom';

/// The byte of each voxel along the optical axis, against the distance from the camera.
export function drawProfile(world: World): void {
  const target = sharp(element<HTMLCanvasElement>('profile'));
  if (!target) return;
  const {g, width, height} = target;
  const [left, right, top, bottom] = [26, 6, 8, 18];
  const length_m = Math.min(10, world.hello?.max_range_m || 5);
  const x = (m: number): number => left + (m / length_m) * (width - left - right);
  const y = (byte: number): number => top + (1 - byte / 255) * (height - top - bottom);

  g.font = `10px ${css('--mono')}`;
  g.textBaseline = 'middle';
  for (const byte of [0, 127, 255]) {
    g.strokeStyle = css('--line');
    g.setLineDash(byte === 127 ? [3, 3] : []);
    g.beginPath();
    g.moveTo(left, y(byte));
    g.lineTo(width - right, y(byte));
    g.stroke();
    g.fillStyle = css('--muted-text');
    g.textAlign = 'right';
    g.fillText(String(byte), left - 5, y(byte));
  }
  g.setLineDash([]);
  g.textAlign = 'center';
  for (let m = 0; m <= length_m; m += length_m > 5 ? 2 : 1) g.fillText(`${m} m`, x(m) + (m === 0 ? 6 : m + 1 > length_m ? -8 : 0), height - 6);

  const points = opticalAxisProfile(world, length_m);
  if (points.length === 0) return;
  const line = new Path2D();
  points.forEach((point, i) => {
    const end_m = points[i + 1]?.distance_m ?? length_m;
    if (i === 0) line.moveTo(x(0), y(point.byte));
    line.lineTo(x(point.distance_m), y(point.byte));
    line.lineTo(x(Math.min(length_m, end_m)), y(point.byte));
  });
  const area = new Path2D(line);
  area.lineTo(x(length_m), y(127));
  area.lineTo(x(0), y(127));
  area.closePath();
  // What speaks for occupied in its colour, what speaks for free in the other.
  for (const [from, to, colour] of [[0, y(127), '--occupied'], [y(127), height, '--free']] as const) {
    g.save();
    g.beginPath();
    g.rect(0, from, width, to - from);
    g.clip();
    g.fillStyle = css(colour);
    g.globalAlpha = 0.75;
    g.fill(area);
    g.restore();
  }
  g.strokeStyle = css('--text');
  g.lineWidth = 1.5;
  g.stroke(line);
}
