// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {World} from '../state/world';
import {css, element, sharp} from './dom';

const kStageColours = ['--stage-1', '--stage-2', '--stage-3', '--stage-4'];

/// Time that each of the last frames took, stage by stage; frames that were refused or lost as marks.
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
    const bar = 3;
    const left = 30;
    const frames = this.world.frames.slice(-Math.floor((width - left) / bar));
    const times = frames.map((f) => f.stages_ms.reduce((a, b) => a + b, 0));
    // One slow frame must not flatten all others: it is cut off at the top.
    const usual = [...times].sort((a, b) => a - b)[Math.floor(times.length * 0.97)] ?? 0;
    const most = niceCeiling(Math.max(5, 1.25 * usual));
    const base = height - 10;
    const y = (ms: number): number => base - (ms / most) * (base - 8);
    g.font = `10px ${css('--mono')}`;
    g.textAlign = 'right';
    g.textBaseline = 'middle';
    for (const ms of [0, most / 2, most]) {
      g.strokeStyle = css('--line');
      g.beginPath();
      g.moveTo(left, Math.round(y(ms)) + 0.5);
      g.lineTo(width, Math.round(y(ms)) + 0.5);
      g.stroke();
      g.fillStyle = css('--muted-text');
      g.fillText(`${ms}`, left - 6, y(ms));
    }
    const colours = kStageColours.map(css);
    const [bad, late, lost] = [css('--bad'), css('--warn'), css('--lost')];
    frames.forEach((frame, i) => {
      const x = width - (frames.length - i) * bar;
      let sum = 0;
      frame.stages_ms.forEach((ms, k) => {
        g.fillStyle = frame.verdict !== 0 ? bad : colours[k]!;
        const top = Math.max(6, y(sum + ms));
        g.fillRect(x, top, bar - 1, Math.max(0, y(sum) - top));
        sum += ms;
      });
      const mark = (colour: string): void => {
        g.fillStyle = colour;
        g.fillRect(x, base + 3, bar - 1, 6);
      };
      const before = frames[i - 1];
      if (before && frame.lost > before.lost) mark(lost);
      if (frame.isLate) mark(late);
      if (frame.verdict !== 0) mark(bad);
      if (frame.hasShifted) {
        g.fillStyle = css('--window');
        g.fillRect(x, 0, bar - 1, 4);
      }
    });
    this.#explain(g, frames.length, width, bar);
  }

  /// What the frame under the pointer is.
  #explain(g: CanvasRenderingContext2D, count: number, width: number, bar: number): void {
    if (this.#pointer === null || !this.world.hello) return;
    const i = this.world.frames.length - Math.ceil((width - this.#pointer) / bar);
    const frame = this.world.frames[i];
    if (!frame || i < this.world.frames.length - count) return;
    const total = frame.stages_ms.reduce((a, b) => a + b, 0);
    const text = `#${frame.number}  ${total.toFixed(1)} ms  ${this.world.hello.verdicts[frame.verdict] ?? ''}`;
    const w = g.measureText(text).width + 14;
    const x = Math.min(width - w, Math.max(0, this.#pointer - w / 2));
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

function niceCeiling(value: number): number {
  return [5, 10, 20, 30, 50, 100, 200, 500, 1000, 2000, 5000].find((n) => n >= value) ?? Math.ceil(value);
}
