// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the scripts of this folder share: a browser without a screen, and the program that it looks at.

import {spawn} from 'node:child_process';
import {once} from 'node:events';

import {chromium} from 'playwright-core';

export function openBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

/// Starts the program; `url` is where its ground station is.
export async function startProgram(program, args) {
  const child = spawn(program, args, {stdio: ['ignore', 'pipe', 'pipe']});
  let said = '';
  const found = new Promise((resolve, reject) => {
    const hear = (data) => {
      said += data;
      const match = /ground station: (\S+)/.exec(said);
      if (match) resolve(match[1]);
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    child.once('error', reject);
    child.once('exit', () => reject(new Error(`${program} ${args.join(' ')} has ended:\n${said}`)));
  });
  const url = await found;
  return {
    url,
    said: () => said,
    hasEnded: () => child.exitCode !== null || child.signalCode !== null,
    end: async () => {
      if (child.exitCode !== null || child.signalCode !== null) return;
      const ended = once(child, 'exit');
      child.kill('SIGKILL');
      await ended;
    },
  };
}

/// What the tab's JavaScript holds after a collection [MB]: objects, and the bytes of arrays.
export async function heapOf(devtools) {
  await devtools.send('HeapProfiler.collectGarbage');
  const {usedSize, embedderHeapUsedSize = 0, backingStorageSize = 0} = await devtools.send('Runtime.getHeapUsage');
  return {objects: (usedSize + embedderHeapUsedSize) / 1e6, arrays: backingStorageSize / 1e6};
}
