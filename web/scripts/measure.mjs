// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// node scripts/measure.mjs URL
// What the page costs, in a browser without a screen: time until its map is the mapper's, voxel for voxel, draw calls,
// frames a second, and the memory of the tab; long_flight.mjs tells how that grows. The figures in the docs:
//     swiftlet map 'sim:apartment?rate=1' --set map.voxel_m=0.044 --set depth.max_range_m=6 -o big.swl
//     swiftlet view big.swl
//     node web/scripts/measure.mjs http://127.0.0.1:8080/

import {heapOf, openBrowser} from './browser.mjs';

const [url] = process.argv.slice(2);
const browser = await openBrowser();
const page = await browser.newPage({viewport: {width: 1280, height: 800}});
const devtools = await page.context().newCDPSession(page);

const known = () =>
  page.evaluate(() => {
    const {world, viewer} = window.swiftlet;
    const {occupied, blocks} = world.digest;
    return {voxels: occupied, blocks, drawn: viewer.occupied.count, calls: viewer.renderer.info.render.calls};
  });
async function memory_mb() {
  const {objects, arrays} = await heapOf(devtools);
  return Math.round(objects + arrays);
}

// Seen from within the page, as its own events come in.
await page.addInitScript(() => {
  const start_ms = performance.now();
  const timer = setInterval(() => {
    if (!(window.swiftlet?.world.confirmedFrame >= 0)) return;
    window.whole_ms = performance.now() - start_ms;
    clearInterval(timer);
  }, 5);
});
await page.goto(url);
let whole_ms;
while (!(whole_ms = await page.evaluate(() => window.whole_ms))) await page.waitForTimeout(100);
await page.waitForTimeout(3000);
const fps = await page.evaluate(
  () =>
    new Promise((resolve) => {
      const end_ms = performance.now() + 5000;
      let frames = 0;
      const count = () => (performance.now() < end_ms ? (++frames, requestAnimationFrame(count)) : resolve(frames / 5));
      requestAnimationFrame(count);
    }),
);
console.log(JSON.stringify({whole_ms: Math.round(whole_ms), ...(await known()), frames_per_s: fps, memory_mb: await memory_mb()}));
await browser.close();
