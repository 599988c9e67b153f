// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {FrameRecord} from '../wire/messages';

const kOver = 15; // frames: half a second of most cameras

/// Frames a second by the stamps of the source, over the fifteen frames up to each; 0 where that cannot be told.
export function sourceRates(frames: readonly FrameRecord[]): number[] {
  return frames.map((frame, i) => {
    const first = Math.max(0, i - kOver);
    const passed_s = Number(frame.stamp_ns - frames[first]!.stamp_ns) / 1e9;
    return passed_s > 0 ? (i - first) / passed_s : 0;
  });
}
