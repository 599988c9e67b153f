// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {World} from './world';

/// The occupied voxels as a binary PLY cloud: x, y, z [m] of their centres and the byte, as `swiftlet export --to ply`.
export function occupiedAsPly(world: World): Blob {
  const voxel_m = world.hello?.voxel_m ?? 0.1;
  const count = world.digest.occupied;
  const header = `ply
format binary_little_endian 1.0
comment occupied voxels of a Swiftlet map, ${voxel_m} m; frame ${world.confirmedFrame}
element vertex ${count}
property float x
property float y
property float z
property uchar log_odds
end_header
`;
  const size = 13;
  const data = new DataView(new ArrayBuffer(count * size));
  let at = 0;
  for (const block of world.blocks.values()) {
    for (let i = 0; i < block.voxels.length; ++i) {
      const byte = block.voxels[i]!;
      if (world.stateOf(byte) !== 'occupied') continue;
      data.setFloat32(at, (8 * block.x + (i & 7) + 0.5) * voxel_m, true);
      data.setFloat32(at + 4, (8 * block.y + ((i >> 3) & 7) + 0.5) * voxel_m, true);
      data.setFloat32(at + 8, (8 * block.z + (i >> 6) + 0.5) * voxel_m, true);
      data.setUint8(at + 12, byte);
      at += size;
    }
  }
  return new Blob([header, data.buffer], {type: 'application/octet-stream'});
}
