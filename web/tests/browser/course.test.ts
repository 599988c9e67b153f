// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// A flight on nothing but its map, watched: what the planner is at stands over the map, and the page fits.

import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {expect, it} from 'vitest';

import {openBrowser, until} from './browser';
import {RunningProgram} from './program';

it('shows the path, the goal and the frontier of a planner', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'swiftlet-course-'));
  const browser = await openBrowser();
  const program = await RunningProgram.start(
    ['fly', 'sim:apartment', '--to', '8.4,1.7,1.3', '--view', '--stay', '--listen', '127.0.0.1:0'], folder);
  try {
    const page = await browser.newPage({viewport: {width: 1440, height: 900}});
    await page.goto(program.url, {timeout: 60_000});
    await until(page, () => (window.swiftlet.world.course?.path.length ?? 0) > 3, undefined);
    const told = (await page.evaluate(() => window.swiftlet.world.course))!;
    expect(told.goal).toEqual([8.4, 1.7, 1.3].map((v) => Math.fround(v)));
    expect(told.target).not.toBeNull();
    expect(told.frontier.length).toBeGreaterThan(3);
    for (const {clearance_m} of told.path) expect(clearance_m).toBeGreaterThan(0.2);

    await until(page, () => window.swiftlet.viewer.course.group.visible, undefined);
    const button = page.locator('[data-show=course]');
    expect(await button.isVisible()).toBe(true);
    await page.keyboard.press('r');
    expect(await button.getAttribute('aria-pressed')).toBe('false');
    await until(page, () => !window.swiftlet.viewer.course.group.visible, undefined);
  } finally {
    await program.end('SIGKILL');
    await browser.close();
    rmSync(folder, {recursive: true, force: true});
  }
});
