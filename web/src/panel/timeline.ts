// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {words} from '../state/events';
import {sourceRates} from '../state/rates';
import type {World} from '../state/world';
import type {FrameRecord} from '../wire/messages';
import {css, element, sharp} from './dom';

const kStageColours = ['--stage-1', '--stage-2', '--stage-3', '--stage-4'];
const kBar_px = 3;
const kLeft_px = 40;
const kRight_px = 46;
const kBelow_px = 10; // for the marks

/// Time that each of the last frames took, stage by stage; how many came a second, as a line; frames that were refused
/// or lost as marks below.
export class Timeline {
  #canvas = element<HTMLCanvasElement>('timeline');
  #pointer: number | null = null;

  constructor(private readonly world: World) {
    this.#canvas.addEventListener('pointermove', (event) => (this.#pointer = event.offsetX));
    this.#canvas.addEventListener('pointerleave', () => (this.#pointer = null));
  }

  draw(): void {
    const target = sharp(this.#canvas);
    if (!target) return;
    const {g, width, height} = target;
    const right = width - kRight_px;
    const frames = this.world.frames.slice(-Math.floor((right - kLeft_px) / kBar_px));
    const base = height - kBelow_px;
    const y = (share: number): number => base - share * (base - 8);
    g.font = `10px ${css('--mono')}`;
    g.textBaseline = 'middle';
    // One slow frame must not flatten all others: it is cut off at the top.
    const times = frames.map(totalOf).sort((a, b) => a - b);
    const most_ms = niceCeiling(Math.max(5, 1.25 * (times[Math.floor(times.length * 0.97)] ?? 0)));
    const rates = sourceRates(frames);
    const most_fps = niceCeiling(Math.max(5, 1.1 * Math.max(0, ...rates)));
    this.#axes(g, width, y, most_ms, most_fps);
    const xOf = (i: number): number => right - (frames.length - i) * kBar_px;
    const colours = kStageColours.map(css);
    const marks = {refused: css('--bad'), late: css('--warn'), lost: css('--lost'), shift: css('--window')};
    frames.forEach((frame, i) => {
      let sum = 0;
      frame.stages_ms.forEach((ms, k) => {
        g.fillStyle = frame.verdict !== 0 ? marks.refused : colours[k]!;
        const top = Math.max(6, y((sum + ms) / most_ms));
        g.fillRect(xOf(i), top, kBar_px - 1, Math.max(0, y(sum / most_ms) - top));
        sum += ms;
      });
      const before = frames[i - 1];
      const kind = frame.verdict !== 0 ? 'refused' : frame.isLate ? 'late' : before && frame.lost > before.lost ? 'lost' : null;
      if (kind) {
        g.fillStyle = marks[kind];
        g.fillRect(xOf(i), base + 3, kBar_px - 1, 6);
      }
      if (frame.hasShifted) {
        g.fillStyle = marks.shift;
        g.fillRect(xOf(i), 0, kBar_px - 1, 4);
      }
    });
    g.strokeStyle = css('--text');
    g.globalAlpha = 0.8;
    g.beginPath();
    rates.forEach((fps, i) => g.lineTo(xOf(i) + 1, y(Math.min(1, fps / most_fps))));
    g.stroke();
    g.globalAlpha = 1;
    this.#explain(g, frames, rates, right);
  }

  #axes(g: CanvasRenderingContext2D, width: number, y: (share: number) => number, ms: number, fps: number): void {
    for (const share of [0, 0.5, 1]) {
      g.strokeStyle = css('--line');
      g.beginPath();
      g.moveTo(kLeft_px, Math.round(y(share)) + 0.5);
      g.lineTo(width - kRight_px, Math.round(y(share)) + 0.5);
      g.stroke();
      g.fillStyle = css('--muted-text');
      g.textAlign = 'right';
      g.fillText(share === 1 ? `${ms} ms` : `${share * ms}`, kLeft_px - 5, y(share));
      g.textAlign = 'left';
      g.fillText(share === 1 ? `${fps} Hz` : `${share * fps}`, width - kRight_px + 5, y(share));
    }
  }

  /// What the frame under the pointer is.
  #explain(g: CanvasRenderingContext2D, frames: FrameRecord[], rates: number[], right: number): void {
    if (this.#pointer === null || !this.world.hello) return;
    const i = frames.length - Math.ceil((right - this.#pointer) / kBar_px);
    const frame = frames[i];
    if (!frame) return;
    const parts = [`#${frame.number}`, `${totalOf(frame).toFixed(1)} ms`, words(this.world.hello.verdicts[frame.verdict])];
    if (rates[i]! > 0) parts.splice(2, 0, `camera at ${rates[i]!.toFixed(0)} Hz`);
    if (frame.isLate) parts.push(`${frame.blocksLeft} blocks left`);
    const lost = frame.lost - (frames[i - 1]?.lost ?? frame.lost);
    if (lost > 0) parts.push(`${lost} lost before it`);
    const text = parts.join('  ');
    const w = g.measureText(text).width + 14;
    const x = Math.min(right - w, Math.max(0, this.#pointer - w / 2));
    g.fillStyle = css('--panel-solid');
    g.strokeStyle = css('--line');
    g.beginPath();
    g.roundRect(x, 6, w, 20, 6);
    g.fill();
    g.stroke();
    g.fillStyle = css('--text');
    g.textAlign = 'left';
    g.fillText(text, x + 7, 16.5);
  }
}

function totalOf(frame: FrameRecord): number {
  return frame.stages_ms.reduce((a, b) => a + b, 0);
}

function niceCeiling(value: number): number {
  return [5, 10, 20, 30, 50, 100, 200, 500, 1000, 2000, 5000].find((n) => n >= value) ?? Math.ceil(value);
}
