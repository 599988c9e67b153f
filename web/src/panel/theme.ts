// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import type {Theme} from '../scene/viewer';
import {css} from './dom';

const kStored = 'swiftlet-theme';

/// Follows the system until the user chooses; remembers the choice.
export function startTheme(): void {
  let chosen: string | null = null;
  try {
    chosen = localStorage.getItem(kStored);
  } catch {
    // A browser that stores nothing follows the system.
  }
  const isLight = window.matchMedia('(prefers-color-scheme: light)').matches;
  document.documentElement.dataset.theme = chosen ?? (isLight ? 'light' : 'dark');
}

export function nextTheme(): void {
  const next = document.documentElement.dataset.theme === 'light' ? 'dark' : 'light';
  document.documentElement.dataset.theme = next;
  try {
    localStorage.setItem(kStored, next);
  } catch {
    // Then it holds until the page is closed.
  }
}

/// The colours of the 3-D view, from the style sheet.
export function sceneTheme(): Theme {
  return {
    background: css('--scene'),
    grid: css('--grid'),
    track: css('--track'),
    frustum: css('--accent'),
    window: css('--window'),
    trigger: css('--trigger'),
    goal: css('--accent'),
    frontier: css('--frontier'),
    highlight: css('--text'),
    slice: css('--text'),
    free: css('--free'),
    unknown: css('--muted'),
  };
}
