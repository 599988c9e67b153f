// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {execFileSync, spawn, type ChildProcess} from 'node:child_process';
import {fileURLToPath} from 'node:url';

export const program = process.env.SWIFTLET_PROGRAM ?? fileURLToPath(new URL('../../../build/release/src/swiftlet/swiftlet', import.meta.url));

/// `swiftlet map --view` or `swiftlet view`, running.
export class RunningProgram {
  #text = '';
  private constructor(private readonly process: ChildProcess) {}

  static async start(args: string[], folder: string): Promise<RunningProgram> {
    const child = spawn(program, args, {cwd: folder, stdio: ['ignore', 'pipe', 'pipe']});
    const running = new RunningProgram(child);
    const hear = (data: Buffer): void => {
      running.#text += data.toString();
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    await running.says(/ground station: \S+/);
    return running;
  }

  get url(): string {
    return /ground station: (\S+)/.exec(this.#text)![1]!;
  }
  get port(): number {
    return Number(new URL(this.url).port);
  }

  async says(what: RegExp): Promise<void> {
    while (!what.test(this.#text)) {
      if (this.process.exitCode !== null) throw new Error(`the program has ended: ${this.#text}`);
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  }
  /// Sends a signal and waits for the end.
  async end(signal: NodeJS.Signals = 'SIGINT'): Promise<number | null> {
    if (this.process.exitCode === null && this.process.signalCode === null) {
      const ended = new Promise((resolve) => this.process.once('exit', resolve));
      this.process.kill(signal);
      await ended;
    }
    return this.process.exitCode;
  }
}

/// What `swiftlet info` counts in a map file.
export function voxelsOf(map: string): {occupied: number; free: number} {
  return JSON.parse(execFileSync(program, ['info', map, '--json']).toString()).voxels;
}

/// What `swiftlet compare` counts: free and occupied voxels of both, and how many of them are the same.
export function compared(first: string, second: string): {voxels: number; same: number} {
  return JSON.parse(execFileSync(program, ['compare', first, second, '--json']).toString());
}
