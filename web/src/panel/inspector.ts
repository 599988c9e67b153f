// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {World} from '../state/world';
import type {Vec3} from '../wire/messages';
import {element} from './dom';

/// Says what is known of one voxel.
export class Inspector {
  voxel: Vec3 | null = null;
  isKept = false;

  constructor(private readonly world: World) {}

  /// A voxel under the pointer is shown until it leaves; one that was clicked stays until another is.
  point(voxel: Vec3 | null, isKept: boolean): void {
    if (isKept) {
      const isSame = this.isKept && voxel && this.voxel?.every((v, i) => v === voxel[i]);
      this.isKept = voxel !== null && !isSame;
      this.voxel = this.isKept ? voxel : null;
    } else if (!this.isKept) {
      this.voxel = voxel;
    }
    this.draw();
  }

  draw(): void {
    const {voxel, world} = this;
    element('voxel').hidden = !voxel;
    element('voxel-hint').hidden = voxel !== null;
    if (!voxel || !world.hello) return;
    const byte = world.voxel(...voxel);
    const state = world.stateOf(byte);
    const set = (id: string, text: string): void => {
      element(id).textContent = text;
    };
    set('voxel-index', voxel.join('  '));
    set('voxel-centre', voxel.map((i) => ((i + 0.5) * world.hello!.voxel_m).toFixed(2)).join('  ') + ' m');
    set('voxel-byte', String(byte));
    set('voxel-probability', `${(100 * world.probability(byte)).toFixed(1)} %`);
    set('voxel-state', state);
    element('voxel-state').dataset.state = state;
  }
}
