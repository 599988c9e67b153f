// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {defineConfig} from 'vitest/config';

export default defineConfig({
  base: './',
  build: {
    target: 'es2022',
    modulePreload: {polyfill: false}, // an inline script, which the page's policy forbids
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1000,
  },
  test: {include: ['tests/unit/**/*.test.ts']},
});
