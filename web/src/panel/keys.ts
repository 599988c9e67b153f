// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {element} from './dom';

export type Action =
  | 'orbit' | 'follow' | 'top' | 'cut' | 'free' | 'unknown' | 'boxes' | 'course' | 'colour' | 'pause' | 'step' | 'higher'
  | 'lower' | 'atCamera' | 'theme' | 'screenshot' | 'save' | 'help';
export type Actions = Record<Action, () => unknown>;

const kKeys: [string, Action, string][] = [
  ['1', 'orbit', 'orbit camera'],
  ['2', 'follow', 'follow the vehicle'],
  ['3', 'top', 'look from above'],
  [' ', 'pause', 'pause and go on'],
  ['.', 'step', 'one step while paused'],
  [']', 'higher', 'slice one layer up'],
  ['[', 'lower', 'slice one layer down'],
  ['h', 'atCamera', 'slice at the camera’s height'],
  ['x', 'cut', 'cut away what lies above the slice'],
  ['c', 'colour', 'colour by height or log-odds'],
  ['f', 'free', 'free voxels'],
  ['u', 'unknown', 'undecided voxels'],
  ['b', 'boxes', 'window and trigger box'],
  ['r', 'course', 'a planner’s path, goal and frontier'],
  ['p', 'screenshot', 'screenshot'],
  ['d', 'save', 'download the map'],
  ['t', 'theme', 'light or dark'],
  ['?', 'help', 'these keys'],
];

/// One key an action; none while a field is being edited. Fills the list of keys that the page shows.
export function keysToActions(actions: Actions): void {
  element('key-list').replaceChildren(
    ...kKeys.map(([key, , meaning]) => {
      const row = document.createElement('div');
      const name = document.createElement('dt');
      const what = document.createElement('dd');
      name.textContent = key === ' ' ? 'space' : key;
      what.textContent = meaning;
      row.append(name, what);
      return row;
    }),
  );
  window.addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    // A dialog that was just closed may hold the focus for a moment.
    const isElsewhere = target.closest('select, input') || document.querySelector('dialog[open]');
    if (event.ctrlKey || event.metaKey || event.altKey || isElsewhere) return;
    const found = kKeys.find(([key]) => key === event.key);
    if (!found) return;
    event.preventDefault();
    actions[found[1]]();
  });
}
