// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {decode, decodeHello} from './decode';
import {encode, type Pace} from './encode';
import type {Hello, ServerMessage} from './messages';

export type LinkState = 'connecting' | 'open' | 'lost';

export interface LinkEvents {
  state: (state: LinkState) => void;
  hello: (hello: Hello) => void;
  message: (message: ServerMessage) => void;
}

const kFirstRetry_ms = 500;
const kLastRetry_ms = 5000;
const kHealingPatience_ms = 3000;
/// A link that has gone without a word is open for minutes, as far as the browser can tell. The server speaks five
/// times a second, and at the tightest cap that the page offers once in four seconds.
const kSilence_ms = 15_000;

/// The connection to the server: comes back when it was lost, notices missing messages by their numbers and asks for
/// them again.
export class Link {
  state: LinkState = 'connecting';
  bytes = 0;
  gaps = 0;
  checksums = 0;
  retryAt_ms = 0;
  error = '';
  heardAt_ms = 0; // when the last message came, or the connection was begun
  #socket: WebSocket | null = null;
  #expected = 0;
  #world = 0;
  #retry_ms = kFirstRetry_ms;
  #dropNext = 0;
  #wrongSince_ms = 0;
  #pace: Pace = 'flow';
  #rate = 0;
  #watch: ReturnType<typeof setInterval> | null = null;

  constructor(
    private readonly url: string,
    private readonly events: LinkEvents,
  ) {}

  open(): void {
    this.#watch ??= setInterval(() => this.#breakSilence(), 1000);
    this.#set('connecting');
    this.heardAt_ms = performance.now();
    const socket = new WebSocket(this.url, 'swiftlet.v1');
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (socket === this.#socket) this.#receive(event.data);
    };
    socket.onclose = () => this.#lost(socket);
    this.#socket = socket;
  }

  get pace(): Pace {
    return this.#pace;
  }
  setPace(pace: Pace): void {
    this.heardAt_ms = performance.now(); // a server that is held says nothing
    this.#pace = pace === 'step' ? 'hold' : pace;
    this.#send(encode.pace(pace));
  }
  /// 0: no limit.
  setRate(bytesPerSecond: number): void {
    this.#rate = bytesPerSecond;
    this.#send(encode.rate(bytesPerSecond));
  }

  /// The map here is (not) what the last checksum says. What is being sent again gets some time to arrive.
  confirmed(isRight: boolean): void {
    if (isRight) {
      ++this.checksums;
      this.#wrongSince_ms = 0;
      return;
    }
    const now = performance.now();
    if (this.#wrongSince_ms === 0) this.#wrongSince_ms = now;
    if (now - this.#wrongSince_ms > kHealingPatience_ms) {
      this.#wrongSince_ms = 0;
      this.#send(encode.sendAll());
    }
  }

  /// Throws away the next messages as a bad radio link would; for tests.
  dropNext(count: number): void {
    this.#dropNext = count;
  }

  #breakSilence(): void {
    const socket = this.#socket;
    if (!socket || this.#pace === 'hold' || performance.now() - this.heardAt_ms < kSilence_ms) return;
    this.#lost(socket);
    socket.close(); // it would wait for an answer
  }

  #receive(data: string | ArrayBuffer): void {
    this.heardAt_ms = performance.now();
    if (typeof data === 'string') {
      const hello = decodeHello(data);
      if (!hello) return;
      this.#world = hello.world;
      this.#retry_ms = kFirstRetry_ms;
      this.#set('open');
      this.events.hello(hello);
      return;
    }
    this.bytes += data.byteLength;
    if (this.#dropNext > 0) {
      --this.#dropNext;
      return;
    }
    let message: ServerMessage | null;
    try {
      message = decode(data);
    } catch (error) {
      this.error = String(error);
      this.#socket?.close();
      return;
    }
    if (!message || message.sequence < this.#expected) return; // late: its blocks were asked for again
    if (message.sequence > this.#expected) {
      ++this.gaps;
      this.#send(encode.resend(this.#expected, message.sequence - 1));
    }
    this.#expected = message.sequence + 1;
    if (message.world === this.#world) this.events.message(message);
  }

  #lost(socket: WebSocket): void {
    if (socket !== this.#socket) return;
    this.#socket = null;
    this.#expected = 0;
    this.#set('lost');
    this.retryAt_ms = performance.now() + this.#retry_ms;
    setTimeout(() => this.open(), this.#retry_ms);
    this.#retry_ms = Math.min(this.#retry_ms * 1.6, kLastRetry_ms);
  }

  #set(state: LinkState): void {
    // While it tries again, a lost link stays lost.
    if (state !== 'open' && this.state === 'lost') return;
    this.state = state;
    if (state === 'open') {
      if (this.#pace !== 'flow') this.#send(encode.pace(this.#pace));
      if (this.#rate > 0) this.#send(encode.rate(this.#rate));
    }
    this.events.state(state);
  }

  #send(data: ArrayBuffer): void {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(data);
  }
}
