// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Every state that the page can be in, brought about by the real program and a link that fails, on a phone, a tablet
// and a desk, light and dark: what it says, and that nothing lies upon anything else. With SWIFTLET_PICTURES=FOLDER
// (`npm run gallery`) it leaves pictures of them all, to be looked at.

import {mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import type {Browser, Page} from 'playwright-core';
import {afterAll, afterEach, beforeAll, expect, it} from 'vitest';

import {openBrowser, until} from './browser';
import {RunningProgram} from './program';
import {WeakLink} from './weak_link';

const kSizes = {phone: [390, 844], tablet: [820, 1180], desktop: [1440, 900]} as const;
const pictures = process.env.SWIFTLET_PICTURES;
const folder = mkdtempSync(join(tmpdir(), 'swiftlet-states-'));
let browser: Browser;
let page: Page;
let program: RunningProgram | null = null;
let link: WeakLink | null = null;
let flights = 0;

beforeAll(async () => {
  browser = await openBrowser();
  if (pictures) mkdirSync(pictures, {recursive: true});
}, 60_000);
afterEach(async () => {
  await page.close();
  link?.close();
  await program?.end('SIGKILL');
  program = link = null;
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

/// The apartment, flown through five times, with a rig that is described anew.
function scene(name: string, rig: string): string {
  const apartment = readFileSync(new URL('../../../src/swiftlet/sim/scenes/apartment.yaml', import.meta.url), 'utf8');
  const [head, waypoints] = apartment.split('  waypoints:\n') as [string, string];
  const file = join(folder, name);
  writeFileSync(file, `${head}  waypoints:\n${waypoints.repeat(5)}\n${rig}\n`);
  return `sim:${file}`;
}
async function fly(source: string): Promise<void> {
  program = await RunningProgram.start(
    ['map', source, '--set', 'map.voxel_m=0.1', '--realtime', '-o', join(folder, `flight_${++flights}.swl`), '--view', '--stay',
      '--listen', '127.0.0.1:0'], folder);
  link = await WeakLink.to(program.port);
}
async function open(url: string): Promise<void> {
  page = await browser.newPage({viewport: {width: 1440, height: 900}, colorScheme: 'dark'});
  await page.goto(url, {timeout: 60_000}); // drawn in software, it takes its time on a busy machine
}

/// Boxes of what lies side by side, and how they touch where they must not; empty if all is well.
function overlaps(): string[] {
  const shown = ['#bar', '#controls', '#panels', 'body > #timeline-card', '#banner', '#overlay-title', '#overlay-text']
    .map((name) => ({name, box: document.querySelector(name)?.getBoundingClientRect()}))
    .filter(({box}) => box && box.width > 0 && box.height > 0) as {name: string; box: DOMRect}[];
  const faults: string[] = [];
  for (const [i, a] of shown.entries()) {
    if (a.box.left < -0.5 || a.box.right > innerWidth + 0.5 || a.box.bottom > innerHeight + 0.5) faults.push(`${a.name} leaves the page`);
    for (const b of shown.slice(i + 1)) {
      const x = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
      const y = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
      if (x > 1 && y > 1) faults.push(`${a.name} lies upon ${b.name}`);
    }
  }
  // Words that are cut off in the bar.
  for (const element of document.querySelectorAll<HTMLElement>('#state, #figures dd, #banner, .tools')) {
    if (element.scrollWidth > element.clientWidth + 1) faults.push(`${element.id || element.className} is cut off`);
  }
  return faults;
}

type Size = keyof typeof kSizes;
/// The state must still be the same when all has been looked at, but for a flight that stutters on a busy machine.
async function lookAt(name: string, sizes: Size[] = ['phone', 'tablet', 'desktop']): Promise<void> {
  const state = await page.locator('#state').getAttribute('data-state');
  for (const size of sizes) {
    const [width, height] = kSizes[size];
    await page.setViewportSize({width, height});
    await page.waitForTimeout(pictures ? 1000 : 100);
    for (const theme of ['dark', 'light']) {
      // Drawn in software, the page may take its time on a busy machine.
      await expect.poll(() => page.evaluate(overlaps), {message: `${name} on a ${size}`, timeout: 60_000}).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe(theme);
      if (pictures) await page.screenshot({path: join(pictures, `${name}_${size}_${theme}.png`)});
      await page.evaluate(() => document.querySelector<HTMLElement>('#theme')!.click());
      await page.waitForTimeout(200);
    }
  }
  await expect.poll(() => page.locator('#state').getAttribute('data-state'), {message: name, timeout: 60_000}).toBe(state);
}
async function says(id: string, what: string): Promise<void> {
  await page.locator(id, {hasText: what}).waitFor({timeout: 60_000});
}

it('connects, and says that there is no mapper', async () => {
  await fly('sim:apartment');
  link!.losesSockets = true;
  await open(link!.url);
  await says('#overlay-title', 'Connecting');
  await lookAt('connecting');
  await program!.end('SIGKILL');
  link!.close();
  await says('#overlay-title', 'No mapper here');
  await lookAt('no_mapper');
});

it('waits for the first pose that can be trusted', async () => {
  await fly(scene('untrusted.yaml', 'tracker: { medium_after_s: 1000, high_after_s: 1000 }'));
  await open(program!.url);
  await says('#state', 'No data yet');
  await says('#overlay-title', 'Waiting for the first pose');
  await lookAt('no_data');
});

/// Small images without noise, so that a flight and a browser that draws in software fit on one machine.
async function flySmall(): Promise<void> {
  await fly(`${scene('small.yaml', 'camera: { max_range_m: 16, width_px: 212, height_px: 120 }')}?noise=off`);
  await open(link!.url);
  await until(page, () => window.swiftlet.world.confirmedFrame >= 60, 0);
  await says('#state', 'Flying');
}

it('flies, and pauses', async () => {
  await flySmall();
  await lookAt('flying');
  await page.keyboard.press(' ');
  await says('#banner', 'Paused');
  await lookAt('paused', ['phone']);
  await page.evaluate(() => document.querySelector('#panels')!.scrollTo({left: 9999}));
  await lookAt('frames', ['phone']); // the last card of the strip
  await page.keyboard.press(' ');
  await says('#state', 'Flying');
});

it('says that the link is silent, then lost, and comes back when it speaks again', async () => {
  await flySmall();
  link!.goSilent();
  await says('#banner', 'Nothing heard');
  await lookAt('silent', ['phone']);
  await says('#banner', 'Link lost');
  await lookAt('lost');
  const checksums = await page.evaluate(() => window.swiftlet.link.checksums);
  link!.speak();
  await until(page, (before) => window.swiftlet.link.checksums > before, checksums);
  await says('#state', 'Flying');
});

it('says that the pose is lost, and how many images that cost', async () => {
  await fly('sim:apartment?fault=dead&fault_at=3');
  await open(program!.url);
  await says('#state', 'Pose lost');
  await says('#banner', 'Pose lost');
  await says('#reasons', 'pose stale');
  await lookAt('pose_lost');
});

it('shows a saved map, and what can be taken home', async () => {
  const map = join(folder, 'saved.swl');
  const flight = await RunningProgram.start(
    ['map', 'sim:apartment', '--set', 'map.voxel_m=0.1', '--frames', '90', '-o', map, '--view', '--stay', '--listen', '127.0.0.1:0'], folder);
  await flight.says(/frames +\d+ in/);
  await flight.end();
  program = await RunningProgram.start(['view', map, '--listen', '127.0.0.1:0'], folder);
  await open(program.url);
  await until(page, () => window.swiftlet.viewer.occupied.count > 0, 0);
  await says('#state', 'Saved map');
  await lookAt('saved');
  for (const [key, name] of [['d', 'downloads'], ['?', 'keys']] as const) {
    await page.keyboard.press(key);
    await page.locator(`#${name}`).waitFor({state: 'visible'});
    await lookAt(name, ['phone']);
    await page.keyboard.press('Escape');
    await page.locator(`#${name}`).waitFor({state: 'hidden'});
  }
});
