// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {FrameRecord, Hello, StatusMessage} from '../wire/messages';

export type EventKind = 'refused' | 'lost' | 'late' | 'shift' | 'link';

export interface FlightEvent {
  at: Date;
  kind: EventKind;
  text: string;
  count: number;
}

/// Frames that had no pose that the mapper could trust, by what the sources call it.
export const poseLosses = ['no_pose', 'pose_gap', 'pose_refused', 'pose_jump', 'pose_stale'];

const kKept = 60;
const kArrivalsKept = 200;

/// What happened, newest first. The same thing again within a moment counts up instead of filling the list; moves of the
/// window, which every flight has by the hundred, count up wherever they stand and push nothing else out.
export class EventLog {
  list: FlightEvent[] = [];
  poseLostAt_ms = -Infinity;
  #losses: number[] | null = null; // null: not told yet

  add(kind: EventKind, text: string, count = 1): void {
    const isSame = (event: FlightEvent | undefined): boolean => event?.kind === kind && event.text === text;
    const known = kind === 'shift' ? this.list.find(isSame) : this.list.slice(0, 1).find(isSame);
    if (known) {
      known.count += count;
      known.at = new Date();
      return;
    }
    this.list.unshift({at: new Date(), kind, text, count});
    this.list.length = Math.min(this.list.length, kKept);
  }

  frames(frames: readonly FrameRecord[], hello: Hello): void {
    for (const frame of frames) {
      if (frame.verdict !== 0) this.add('refused', `refused: ${words(hello.verdicts[frame.verdict])}`);
      if (frame.isLate) this.add('late', 'deadline: far blocks left for later');
      if (frame.hasShifted) this.add('shift', 'the window moved');
    }
  }

  /// What was lost before the first status that came is old news.
  status(status: StatusMessage, hello: Hello, now_ms: number): void {
    const before = this.#losses ?? status.losses;
    status.losses.forEach((count, i) => {
      const more = count - (before[i] ?? 0);
      const name = hello.losses[i] ?? '';
      if (more <= 0) return;
      this.add('lost', `lost: ${words(name)}`, more);
      if (poseLosses.includes(name)) this.poseLostAt_ms = now_ms;
    });
    this.#losses = status.losses;
  }
  forget(): void {
    this.#losses = null;
    this.poseLostAt_ms = -Infinity;
  }
}

export function words(name: string | undefined): string {
  return (name ?? '?').replaceAll('_', ' ');
}

/// Frames that the mapper takes a second, over the last two by the clock on the wall.
export class FrameRate {
  #arrivals: [number, number][] = [];

  add(count: number, now_ms: number): void {
    this.#arrivals.push([now_ms, count]);
    // In a tab that is out of sight nobody asks for the rate.
    if (this.#arrivals.length > kArrivalsKept) this.#forget(now_ms);
  }
  get kept(): number {
    return this.#arrivals.length;
  }
  /// null while there are none.
  at(now_ms: number): number | null {
    this.#forget(now_ms);
    const first = this.#arrivals[0];
    if (!first || this.#arrivals.length < 2) return null;
    const count = this.#arrivals.slice(1).reduce((sum, [, n]) => sum + n, 0);
    const last = this.#arrivals[this.#arrivals.length - 1]!;
    return last[0] > first[0] ? (1000 * count) / (last[0] - first[0]) : null;
  }
  #forget(now_ms: number): void {
    this.#arrivals = this.#arrivals.filter(([at]) => now_ms - at < 2000).slice(-kArrivalsKept);
  }
}

export function median(values: readonly number[]): number | null {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)]!;
}
