// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// One table for the shader, the legends and the slice.

type Rgb = [number, number, number];

// Polynomial fits of matplotlib's colour maps (Matt Zucker, public domain).
const viridis: Rgb[] = [
  [0.2777, 0.0054, 0.3341], [0.1051, 1.4046, 1.3846], [-0.3308, 0.2148, 0.0951], [-4.6342, -5.7991, -19.3324],
  [6.2283, 14.1799, 56.6906], [4.7764, -13.7451, -65.353], [-5.4355, 4.6459, 26.3124],
];
const plasma: Rgb[] = [
  [0.0587, 0.0233, 0.5433], [2.1765, 0.2384, 0.754], [-2.6895, -7.4559, 3.1108], [6.1303, 42.3462, -28.5189],
  [-11.1074, -82.6663, 60.1398], [10.0231, 71.4136, -54.0722], [-3.6587, -22.9315, 18.1919],
];

function ramp(fit: Rgb[], t: number): Rgb {
  return [0, 1, 2].map((c) => {
    let value = 0;
    for (let i = fit.length - 1; i >= 0; --i) value = value * t + fit[i]![c]!;
    return Math.min(255, Math.max(0, Math.round(255 * value)));
  }) as Rgb;
}

export type Colouring = 'height' | 'logodds';

/// 256 RGBA entries. Height leaves out the darkest end, which drowns in a dark page.
export function colourTable(colouring: Colouring): Uint8Array {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const t = i / 255;
    const rgb = colouring === 'height' ? ramp(viridis, 0.12 + 0.88 * t) : ramp(plasma, 0.05 + 0.93 * t);
    table.set([...rgb, 255], 4 * i);
  }
  return table;
}

/// As a CSS gradient from left to right.
export function cssGradient(colouring: Colouring): string {
  const table = colourTable(colouring);
  const stops = Array.from({length: 17}, (_, k) => {
    const i = Math.round((k * 255) / 16);
    return `rgb(${table[4 * i]} ${table[4 * i + 1]} ${table[4 * i + 2]})`;
  });
  return `linear-gradient(90deg, ${stops.join(', ')})`;
}
