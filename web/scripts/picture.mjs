// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// node scripts/picture.mjs URL OUT.png [SECONDS [KEYS]]
// A picture of the ground station as it is after some seconds, by a browser without a screen. The one in the docs:
//     swiftlet map sim:apartment --set map.voxel_m=0.1 --view --stay
//     node web/scripts/picture.mjs http://127.0.0.1:8080/ docs/pictures/ground_station.png 60

import {openBrowser} from './browser.mjs';

const [url, out, seconds = '10', keys = ''] = process.argv.slice(2);
const browser = await openBrowser();
const page = await browser.newPage({viewport: {width: 1280, height: 800}, colorScheme: 'dark'});
await page.goto(url);
await page.waitForTimeout(1000 * Number(seconds));
for (const key of keys) await page.keyboard.press(key);
await page.waitForTimeout(2000);
await page.screenshot({path: out});
await browser.close();
