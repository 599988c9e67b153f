// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The page in a real browser, with the real program behind it, over a flight of the simulated rig.

import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import type {Browser, Page} from 'playwright-core';
import {afterAll, afterEach, beforeAll, expect, it} from 'vitest';

import {openBrowser, until as untilOn} from './browser';
import {voxelsOf, compared, RunningProgram} from './program';

const folder = mkdtempSync(join(tmpdir(), 'swiftlet-web-'));
const map = join(folder, 'flat.swl');
const kFrames = 200; // 20 s, at a rate that leaves a browser that draws in software its share: it is open before that
const flight = ['map', 'sim:apartment?rate=10', '--set', 'map.voxel_m=0.1', '--frames', String(kFrames), '--overwrite', '--realtime',
  '-o', map, '--view', '--stay', '--listen', '127.0.0.1:0'];

let browser: Browser;
let page: Page;
const faults: string[] = []; // of all pages: none is expected unless a test says so
const requests: string[] = [];
const running: RunningProgram[] = [];

async function start(args: string[]): Promise<RunningProgram> {
  const one = await RunningProgram.start(args, folder);
  running.push(one);
  return one;
}
async function open(url: string): Promise<void> {
  page = await browser.newPage({viewport: {width: 1024, height: 760}});
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('request', (request) => requests.push(request.url()));
  await page.goto(url, {timeout: 60_000}); // drawn in software, it takes its time on a busy machine
}
const knowledge = () =>
  page.evaluate(() => {
    const {world, link, viewer} = window.swiftlet;
    return {
      digest: world.digest, confirmed: world.confirmedFrame, state: world.status?.state, gaps: link.gaps, checksums: link.checksums,
      bytes: link.bytes, calls: viewer.renderer.info.render.calls, drawn: viewer.occupied.count, track: world.track.length,
    };
  });
function until<T>(isTrue: (argument: T) => boolean, argument: T): Promise<void> {
  return untilOn(page, isTrue, argument);
}
async function confirmed(frame: number): Promise<void> {
  await until((n) => window.swiftlet.world.confirmedFrame >= n, frame);
}

beforeAll(async () => {
  browser = await openBrowser();
}, 60_000);
afterEach(async () => {
  await page?.close();
  await Promise.all(running.splice(0).map((one) => one.end('SIGKILL')));
  expect(faults.splice(0)).toEqual([]);
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

it('shows a flight, voxel for voxel, at 1 Mbit/s and through lost packets, and fetches nothing from elsewhere', async () => {
  const program = await start(flight);
  await open(program.url);
  await confirmed(5);
  await page.selectOption('#limit', '125000');
  await until(() => window.swiftlet.world.status?.rateLimit === 125_000, 0);
  const start_ms = performance.now();
  const before = (await knowledge()).bytes;
  await page.evaluate(() => window.swiftlet.link.dropNext(4));
  await program.says(/frames +\d+ in/);
  await until(() => window.swiftlet.world.status?.state === 'over', 0);
  await until(() => window.swiftlet.world.confirmedFrame === window.swiftlet.world.status?.frame, 0);
  const live = await knowledge();
  const passed_s = (performance.now() - start_ms) / 1000;
  expect(live.bytes - before).toBeLessThan(125_000 * (passed_s + 0.1) + 40_000);
  expect(live.gaps).toBeGreaterThan(0);
  expect(live.digest).toMatchObject(pick(voxelsOf(map)));
  expect(live.digest.occupied).toBeGreaterThan(5000);
  expect(live.track).toBeGreaterThan(1);  // how many depends on the frames that a busy machine loses
  await until(() => window.swiftlet.viewer.occupied.count === window.swiftlet.world.digest.occupied, 0);
  expect((await knowledge()).calls).toBeLessThanOrEqual(10);
  await page.locator('#state', {hasText: 'Flight over'}).waitFor();
  for (const url of requests) expect(url.startsWith('blob:') || new URL(url).host).toBe(new URL(program.url).host);

  // The saved file holds the same map, bit for bit.
  expect(await program.end()).toBe(0);
  const saved = await start(['view', map, '--listen', '127.0.0.1:0']);
  await page.close();
  faults.length = 0; // the link was lost
  await open(saved.url);
  await confirmed(0);
  expect((await knowledge()).digest).toEqual(live.digest);
  await page.locator('#state', {hasText: 'Saved map'}).waitFor();
});

function pick(voxels: {occupied: number; free: number}): {occupied: number; free: number} {
  return {occupied: voxels.occupied, free: voxels.free};
}

it('slice, height and inspector tell what the map holds', async () => {
  const program = await start(['view', map, '--listen', '127.0.0.1:0']);
  await open(program.url);
  await page.setViewportSize({width: 1100, height: 1100}); // a slice of several pixels a voxel
  await confirmed(0);
  await until(() => window.swiftlet.viewer.occupied.count > 0, 0);

  // The rail: from its middle to near its upper end.
  const rail = (await page.locator('#rail').boundingBox())!;
  await page.mouse.move(rail.x + 10, rail.y + rail.height / 2);
  await page.mouse.down();
  await page.mouse.move(rail.x + 10, rail.y + rail.height * 0.25, {steps: 4});
  await page.mouse.up();
  const z_m = await page.evaluate(() => window.swiftlet.slice.z_m);
  expect(z_m).toBeGreaterThan(1.4);
  expect(await page.locator('#slice-z').innerText()).toBe(`${z_m.toFixed(2)} m`);
  await page.locator('#rail').press('ArrowDown');
  expect(await page.evaluate(() => window.swiftlet.slice.z_m)).toBeCloseTo(z_m - 0.1, 6);

  // The slice's colours are the voxels of that layer: no voxel is lost or made up.
  const painted = await page.evaluate(() => {
    const {world, slice} = window.swiftlet;
    const sheet = document.querySelector<HTMLCanvasElement>('#slice')!;
    const g = sheet.getContext('2d')!;
    const box = sheet.getBoundingClientRect();
    slice.draw();
    const counts = {asked: 0, wrong: 0, occupied: 0};
    const voxelAt = (x: number, y: number): [number, number, number] | null => {
      let voxel: [number, number, number] | null = null;
      const keep = slice.onPoint;
      slice.onPoint = (c) => (voxel = c);
      sheet.dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + x, clientY: box.top + y}));
      slice.onPoint = keep;
      return voxel;
    };
    for (let x = 4; x < sheet.clientWidth - 4; x += 5) {
      for (let y = 4; y < sheet.clientHeight - 4; y += 5) {
        const voxels = [0, 0.5, 0.99].map((d) => voxelAt(x + d, y + d));
        if (!voxels[1] || voxels.some((c) => String(c) !== String(voxels[1]))) continue; // a pixel of two voxels
        const state = world.stateOf(world.voxel(...voxels[1]));
        const ratio = sheet.width / box.width;
        const [r, , b] = g.getImageData(Math.floor(x * ratio), Math.floor(y * ratio), 1, 1).data;
        const seen = b! > 180 && r! < 120 ? 'occupied' : b! < 120 ? 'free' : 'unknown';
        ++counts.asked;
        if (state === 'occupied') ++counts.occupied;
        if (seen !== state) ++counts.wrong;
      }
    }
    return counts;
  });
  expect(painted.asked).toBeGreaterThan(100);
  expect(painted.occupied).toBeGreaterThan(5);
  expect(painted.wrong).toBe(0);

  // The inspector, over the first occupied voxel that a row of points in the 3-D view meets.
  await page.keyboard.press('3');
  await page.waitForTimeout(1500);
  const canvas = (await page.locator('#view').boundingBox())!;
  let state = '';
  for (let x = 0.2; x < 0.7 && state !== 'occupied'; x += 0.04) {
    await page.mouse.move(canvas.x + canvas.width * x, canvas.y + canvas.height * 0.45);
    await page.waitForTimeout(60);
    if (await page.locator('#voxel').isVisible()) state = await page.locator('#voxel-state').innerText();
  }
  expect(state).toBe('occupied');
  const voxel = (await page.locator('#voxel-index').innerText()).split(/\s+/).map(Number) as [number, number, number];
  const byte = await page.evaluate((c) => window.swiftlet.world.voxel(...c), voxel);
  expect(Number(await page.locator('#voxel-byte').innerText())).toBe(byte);
  expect(byte).toBeGreaterThanOrEqual(180);
});

it('hands out the map file, which holds the same voxels', async () => {
  const program = await start(['view', map, '--listen', '127.0.0.1:0', '--token', 'only-for-me']);
  await open(program.url);
  await confirmed(0);
  await page.keyboard.press('d');
  const [swl] = await Promise.all([page.waitForEvent('download'), page.click('#get-swl')]);
  expect(swl.suggestedFilename()).toBe('swiftlet.swl');
  const got = join(folder, 'got.swl');
  await swl.saveAs(got);
  await page.locator('#downloads').waitFor({state: 'hidden'});
  expect(pick(voxelsOf(got))).toEqual(pick(voxelsOf(map))); // blocks of unknown voxels alone are left out
  const {occupied, free} = voxelsOf(map);
  expect(compared(got, map)).toMatchObject({voxels: occupied + free, same: occupied + free});
  await page.keyboard.press('d');
  const [ply] = await Promise.all([page.waitForEvent('download'), page.click('#get-ply')]);
  const points = join(folder, 'got.ply');
  await ply.saveAs(points);
  expect(readFileSync(points, 'latin1')).toContain(`element vertex ${voxelsOf(map).occupied}\n`);

  // Seen as it was downloaded, it has the same hash.
  const before = (await knowledge()).digest;
  await page.close(); // or it would say that the link is lost
  await program.end();
  const again = await start(['view', got, '--listen', '127.0.0.1:0']);
  await open(again.url);
  await confirmed(0);
  expect((await knowledge()).digest).toEqual(before);
});

it('says why there is no map file', async () => {
  const program = await start(['view', map, '--listen', '127.0.0.1:0']);
  await open(program.url);
  await confirmed(0);
  await program.end('SIGKILL');
  await page.keyboard.press('d');
  await page.click('#get-swl');
  await page.locator('#download-note', {hasText: 'No map file'}).waitFor();
  faults.length = 0; // the browser says that the connection failed
});

it('comes back by itself when the server does', async () => {
  const first = await start(['view', map, '--listen', '127.0.0.1:0']);
  await open(first.url);
  await confirmed(0);
  const before = await knowledge();
  await page.selectOption('#limit', '125000');
  const port = first.port;
  await first.end('SIGKILL');
  await page.locator('#banner[data-state=lost]').waitFor({state: 'visible'});
  expect((await knowledge()).digest).toEqual(before.digest); // it still shows what it knew
  await start(['view', map, '--listen', `127.0.0.1:${port}`]);
  await until((n) => window.swiftlet.link.checksums > n, before.checksums);
  expect((await knowledge()).digest).toEqual(before.digest);
  await until(() => window.swiftlet.world.status?.rateLimit === 125_000, 0); // remembered
  await page.locator('#banner').waitFor({state: 'hidden'});
  faults.length = 0; // the browser says that the connection failed
});

it('pauses and steps', async () => {
  const program = await start(['view', map, '--listen', '127.0.0.1:0']);
  await open(program.url);
  await confirmed(0);
  await page.keyboard.press(' ');
  await page.locator('#banner[data-state=paused]').waitFor({state: 'visible'});
  const {checksums} = await knowledge();
  await page.keyboard.press('.');
  await until((n) => window.swiftlet.link.checksums === n + 1, checksums);
  await page.keyboard.press(' ');
  await page.locator('#banner').waitFor({state: 'hidden'});
});

it('shows nothing to who has no token', async () => {
  const program = await start(['view', map, '--listen', '127.0.0.1:0', '--token', 'only-for-me']);
  expect(program.url).toContain('?token=only-for-me');
  await open(program.url.replace('only-for-me', 'only-for-you'));
  await page.locator('body', {hasText: 'token'}).waitFor(); // why, and what to do
  expect(await page.locator('canvas').count()).toBe(0);
  await expect.poll(() => faults.join(), {timeout: 10_000}).toContain('401');
  await page.close();
  expect(faults.splice(0).filter((fault) => !fault.includes('401'))).toEqual([]);
  await open(program.url);
  await confirmed(0);
});
