// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {occupiedAsPly} from '../state/ply';
import type {World} from '../state/world';
import {download, element, grouped} from './dom';

/// What of the map can be taken home: the map file, which the server writes, and the voxels that the page holds.
export class Downloads {
  #dialog = element<HTMLDialogElement>('downloads');
  #note = element('download-note');

  constructor(private readonly world: World) {
    element('get-swl').addEventListener('click', () => void this.#mapFile());
    element('get-ply').addEventListener('click', () => {
      download(occupiedAsPly(this.world), 'swiftlet.ply');
      this.#dialog.close();
    });
  }

  open(): void {
    const {occupied, blocks} = this.world.digest;
    element('swl-size').textContent = `${grouped(blocks)} blocks`;
    element('ply-size').textContent = `${grouped(occupied)} voxels`;
    this.#tell('');
    this.#dialog.showModal();
  }

  async #mapFile(): Promise<void> {
    const button = element<HTMLButtonElement>('get-swl');
    button.disabled = true;
    this.#tell('The server is writing the map…');
    try {
      const answer = await fetch(`map.swl${location.search}`);
      if (!answer.ok) throw new Error((await answer.text()) || `the server answers ${answer.status}`);
      download(await answer.blob(), 'swiftlet.swl');
      this.#dialog.close();
    } catch (error) {
      this.#tell(`No map file: ${error instanceof Error ? error.message : String(error)}`);
    } finally {
      button.disabled = false;
    }
  }
  #tell(text: string): void {
    this.#note.textContent = text;
    this.#note.hidden = text === '';
  }
}
