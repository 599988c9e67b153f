// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {defineConfig} from 'vitest/config';

export default defineConfig({
  test: {
    include: ['tests/browser/**/*.test.ts'],
    testTimeout: 240_000,
    hookTimeout: 60_000,
    fileParallelism: false,
  },
});
