// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {chromium, type Browser, type Page} from 'playwright-core';

export function openBrowser(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

/// Playwright's own waitForFunction() evaluates text, which the page's policy forbids.
export async function until<T>(page: Page, isTrue: (argument: T) => boolean, argument: T): Promise<void> {
  const end = Date.now() + 60_000;
  while (!(await page.evaluate(isTrue as never, argument))) {
    if (Date.now() > end) throw new Error(`a minute has passed, and not: ${isTrue.toString()}`);
    await page.waitForTimeout(50);
  }
}
