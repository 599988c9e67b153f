// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the page says to the server.

export type Pace = 'flow' | 'hold' | 'step';

function message(type: number, detail: number, ...words: number[]): ArrayBuffer {
  const data = new ArrayBuffer(4 + 4 * words.length);
  const view = new DataView(data);
  view.setUint8(0, type);
  view.setUint8(1, detail);
  words.forEach((word, i) => view.setUint32(4 + 4 * i, word, true));
  return data;
}

export const encode = {
  resend: (first: number, last: number): ArrayBuffer => message(1, 0, first, last),
  sendAll: (): ArrayBuffer => message(2, 0),
  pace: (pace: Pace): ArrayBuffer => message(3, ['flow', 'hold', 'step'].indexOf(pace)),
  rate: (bytesPerSecond: number): ArrayBuffer => message(4, 0, bytesPerSecond),
};
