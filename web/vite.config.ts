// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {defineConfig} from 'vitest/config';

export default defineConfig({
  base: './',
  // For work on the page: beside `swiftlet map ... --view --origin http://localhost:5173`.
  server: {proxy: {'/ws': {target: 'ws://127.0.0.1:8080', ws: true, changeOrigin: true}}},
  build: {
    target: 'es2022',
    modulePreload: {polyfill: false}, // an inline script, which the page's policy forbids
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1000,
  },
  test: {include: ['tests/unit/**/*.test.ts']},
});
