// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {World} from '../state/world';
import type {Vec3} from '../wire/messages';
import {element} from './dom';

/// Says what is known of one cell.
export class Inspector {
  cell: Vec3 | null = null;
  isKept = false;

  constructor(private readonly world: World) {}

  /// A cell under the pointer is shown until it leaves; one that was clicked stays until another is.
  point(cell: Vec3 | null, isKept: boolean): void {
    if (isKept) {
      const isSame = this.isKept && cell && this.cell?.every((v, i) => v === cell[i]);
      this.isKept = cell !== null && !isSame;
      this.cell = this.isKept ? cell : null;
    } else if (!this.isKept) {
      this.cell = cell;
    }
    this.draw();
  }

  draw(): void {
    const {cell, world} = this;
    element('cell').hidden = !cell;
    element('cell-hint').hidden = cell !== null;
    if (!cell || !world.hello) return;
    const byte = world.cell(...cell);
    const state = world.stateOf(byte);
    const set = (id: string, text: string): void => {
      element(id).textContent = text;
    };
    set('cell-index', cell.join('  '));
    set('cell-centre', cell.map((i) => ((i + 0.5) * world.hello!.voxel_m).toFixed(2)).join('  ') + ' m');
    set('cell-byte', String(byte));
    set('cell-probability', `${(100 * world.probability(byte)).toFixed(1)} %`);
    set('cell-state', state);
    element('cell-state').dataset.state = state;
  }
}
