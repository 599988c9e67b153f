// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// node scripts/long_flight.mjs SWIFTLET [MINUTES]
// The memory of the tab over a long flight: along the corridor and back, again and again, thirty frames a second in
// real time, as a Markdown table with a row every half minute. Writes nothing but to a folder of its own in /tmp.

import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {heapOf, openBrowser, startProgram} from './browser.mjs';

const kLoop_s = 90; // the scene's flight; a little less than it takes
const kRow_s = 30;
const [program = '../build/release/src/swiftlet/swiftlet', minutes = '10'] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'swiftlet-long-'));

/// The built-in corridor, flown over and over, with images small enough to be simulated beside a browser.
function longScene() {
  const scene = readFileSync(new URL('../../src/swiftlet/sim/scenes/corridor_loop.yaml', import.meta.url), 'utf8')
    .replace('camera: { max_range_m: 20 }', 'camera: { max_range_m: 20, width_px: 212, height_px: 120 }');
  const [head, waypoints] = scene.split('  waypoints:\n');
  const loops = Math.ceil((60 * Number(minutes)) / kLoop_s) + 1;
  return `${head}  waypoints:\n${waypoints.repeat(loops)}`;
}

/// In the page, before its own scripts: counts what WebGL is asked to keep in buffers.
function countBuffers() {
  const sizes = new WeakMap();
  const gl = WebGL2RenderingContext.prototype;
  const {bufferData, deleteBuffer} = gl;
  window.gpu = {bytes: 0, buffers: 0};
  const bindings = {34962: 34964, 34963: 34965}; // ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER
  const forget = (buffer) => {
    if (!sizes.has(buffer)) return;
    window.gpu.bytes -= sizes.get(buffer);
    --window.gpu.buffers;
    sizes.delete(buffer);
  };
  gl.bufferData = function (target, data, ...more) {
    const buffer = this.getParameter(bindings[target]);
    forget(buffer);
    const size = typeof data === 'number' ? data : data.byteLength;
    sizes.set(buffer, size);
    window.gpu.bytes += size;
    ++window.gpu.buffers;
    return bufferData.call(this, target, data, ...more);
  };
  gl.deleteBuffer = function (buffer) {
    forget(buffer);
    return deleteBuffer.call(this, buffer);
  };
}

const scene = join(folder, 'long.yaml');
writeFileSync(scene, longScene());
const flight = await startProgram(program, [
  'map', `sim:${scene}`, '--set', 'map.voxel_m=0.1', '--realtime', '-o', join(folder, 'long.swl'), '--view', '--stay',
  '--listen', '127.0.0.1:0']);
const browser = await openBrowser();
try {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}});
  await page.addInitScript(countBuffers);
  const devtools = await page.context().newCDPSession(page);
  await page.goto(flight.url);
  console.log('| minute | frames seen | blocks | occupied voxels | objects [MB] | arrays [MB] | GPU buffers [MB] | nodes of the page | events | path points |');
  console.log('|---|---|---|---|---|---|---|---|---|---|');
  for (let second = kRow_s; second <= 60 * Number(minutes); second += kRow_s) {
    await page.waitForTimeout(1000 * kRow_s);
    const heap = await heapOf(devtools);
    const known = await page.evaluate(() => {
      const {world, events} = window.swiftlet;
      return {
        frames: world.lastFrame?.number ?? 0, ...world.digest, gpu: window.gpu.bytes / 1e6,
        nodes: document.getElementsByTagName('*').length, events: events.list.length, track: world.track.length,
      };
    });
    console.log(`| ${second / 60} | ${known.frames} | ${known.blocks} | ${known.occupied} | ${heap.objects.toFixed(1)} | ` +
      `${heap.arrays.toFixed(1)} | ${known.gpu.toFixed(1)} | ${known.nodes} | ${known.events} | ${known.track} |`);
  }
} finally {
  await browser.close();
  await flight.end();
  rmSync(folder, {recursive: true, force: true});
}
