// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

/// MurmurHash3_x86_32 of x, y, z (little-endian int32) and the 512 voxels of a block, as the server computes it.
export function blockHash(x: number, y: number, z: number, words: Uint32Array, seed: number): number {
  let h = seed;
  const add = (word: number): void => {
    let k = Math.imul(word, 0xcc9e2d51);
    k = (k << 15) | (k >>> 17);
    h ^= Math.imul(k, 0x1b873593);
    h = (h << 13) | (h >>> 19);
    h = (Math.imul(h, 5) + 0xe6546b64) | 0;
  };
  add(x);
  add(y);
  add(z);
  for (let i = 0; i < words.length; ++i) add(words[i]!);
  h ^= 12 + 4 * words.length;
  h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return (h ^ (h >>> 16)) >>> 0;
}
