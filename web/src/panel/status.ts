// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {FrameRate, median, words, type EventLog} from '../state/events';
import type {World} from '../state/world';
import type {Link} from '../wire/link';
import {element, grouped} from './dom';

const kQuiet_ms = 1500;
const kSilent_ms = 6000;

/// The bar, the banner and what stands in the middle of an empty page.
export class StatusPanel {
  readonly rate = new FrameRate();
  #lastFrameAt_ms = 0;
  #bytes = 0;
  #bytesAt_ms = 0;
  #eventsShown = '';

  constructor(
    private readonly world: World,
    private readonly link: Link,
    private readonly events: EventLog,
  ) {}

  framesCame(count: number, now_ms: number): void {
    this.#lastFrameAt_ms = now_ms;
    this.rate.add(count, now_ms);
  }

  draw(now_ms: number): void {
    this.#figures(now_ms);
    this.#sync();
    const state = this.#state(now_ms);
    // A saved map has neither frames nor a camera: the page leaves out what would stay empty.
    document.body.dataset.flight = this.world.status?.state ?? 'none';
    const pill = element('state');
    pill.dataset.state = state;
    pill.querySelector('span')!.textContent = kStateNames[state];
    this.#banner(state, now_ms);
    this.#overlay(state, now_ms);
    this.#reasons();
  }

  #state(now_ms: number): PageState {
    const {world, link} = this;
    if (link.state === 'lost') return 'lost';
    if (link.state === 'connecting' || !world.hello) return 'connecting';
    if (link.pace === 'hold') return 'paused';
    if (now_ms - link.heardAt_ms > kSilent_ms) return 'silent';
    const flight = world.status?.state ?? 'waiting';
    if (flight === 'saved') return 'saved';
    if (flight === 'over') return 'over';
    if (flight === 'waiting') return 'waiting';
    if (this.#isPoseLost(now_ms)) return 'pose';
    return now_ms - this.#lastFrameAt_ms > kQuiet_ms ? 'quiet' : 'flying';
  }

  #isPoseLost(now_ms: number): boolean {
    return now_ms - this.events.poseLostAt_ms < kQuiet_ms;
  }

  #figures(now_ms: number): void {
    const {world, link} = this;
    const rate = this.rate.at(now_ms);
    element('fps').textContent = rate === null ? '–' : rate.toFixed(rate < 10 ? 1 : 0);
    const latency = median(world.frames.slice(-60).map((f) => f.stages_ms.reduce((a, b) => a + b, 0)));
    element('latency').textContent = latency === null ? '–' : latency.toFixed(1);
    element('voxels').textContent = grouped(world.digest.occupied);
    element('frames').textContent = world.status ? grouped(world.status.frame) : '–';
    if (now_ms - this.#bytesAt_ms > 1000) {
      const perSecond = (link.bytes - this.#bytes) / ((now_ms - this.#bytesAt_ms) / 1000);
      element('rate').textContent = (perSecond / 1000).toFixed(perSecond < 10_000 ? 1 : 0);
      this.#bytes = link.bytes;
      this.#bytesAt_ms = now_ms;
    }
    const source = world.hello ? `${world.hello.source} · ${(100 * world.hello.voxel_m).toFixed(0)} cm voxels` : '';
    if (element('source').textContent !== source) element('source').textContent = source;
  }

  #sync(): void {
    const out = element('sync');
    const pending = this.world.status?.pending ?? 0;
    const isConfirmed = this.world.confirmedFrame >= 0 && pending === 0;
    if (this.link.state !== 'open') {
      out.dataset.sync = 'behind';
      out.textContent = this.world.hello ? `as of frame ${grouped(this.world.status?.frame ?? 0)}` : '–';
      return;
    }
    out.dataset.sync = isConfirmed ? 'equal' : 'behind';
    const whole = this.world.status?.state === 'saved' ? 'equals the saved file' : 'equals the mapper’s';
    out.textContent = isConfirmed ? whole : `${grouped(pending)} blocks behind`;
  }

  #banner(state: PageState, now_ms: number): void {
    const banner = element('banner');
    const seconds = Math.max(0, (this.link.retryAt_ms - now_ms) / 1000);
    const text: Partial<Record<PageState, string>> = {
      lost: `Link lost. The map is as it was; ${seconds > 0.1 ? `trying again in ${Math.ceil(seconds)} s` : 'trying again'}`,
      pose: 'Pose lost: images come without a pose that can be trusted, and are not mapped',
      silent: `Nothing heard for ${((now_ms - this.link.heardAt_ms) / 1000).toFixed(0)} s: the link is weak, or the program stands still`,
      quiet: `No frames for ${((now_ms - this.#lastFrameAt_ms) / 1000).toFixed(0)} s`,
      paused: 'Paused. The server keeps what changes; go on with space, step with .',
    };
    const shown = this.world.hello ? text[state] : undefined;
    banner.hidden = !shown;
    banner.dataset.state = state;
    if (shown && banner.textContent !== shown) banner.textContent = shown;
  }

  #overlay(state: PageState, now_ms: number): void {
    const overlay = element('overlay');
    const isEmpty = this.world.blocks.size === 0;
    const texts: Partial<Record<PageState, [string, string]>> = {
      connecting: ['Connecting', 'Looking for the mapper on this address.'],
      lost: ['No mapper here', 'Start one with  swiftlet map SOURCE --view  and leave this page open: it connects by itself.'],
      waiting: this.#isPoseLost(now_ms)
        ? ['Waiting for the first pose', 'Images come, but none with a pose that can be trusted. Nothing has been mapped yet.']
        : ['Waiting for the first frame', 'The mapper is ready. Nothing has been mapped yet.'],
      saved: ['An empty map', 'This map file holds no voxels.'],
      over: ['The flight is over', 'Nothing was mapped.'],
    };
    const text = isEmpty ? texts[state] : undefined;
    overlay.hidden = !text;
    if (!text) return;
    overlay.dataset.state = state;
    element('overlay-title').textContent = text[0];
    element('overlay-text').textContent = text[1];
  }

  #reasons(): void {
    const {hello, status} = this.world;
    const parts: string[] = [];
    if (hello && status) {
      status.verdicts.forEach((n, i) => {
        if (i > 0 && n > 0) parts.push(`${grouped(n)} ${words(hello.verdicts[i])}`);
      });
      status.losses.forEach((n, i) => {
        if (n > 0) parts.push(`${grouped(n)} ${words(hello.losses[i])}`);
      });
    }
    const text = parts.length > 0 ? `refused or lost: ${parts.join(' · ')}` : hello?.live ? 'none refused' : '';
    element('reasons').textContent = text;
    const list = this.events.list.slice(0, 5);
    const shown = list.map((e) => `${e.text}×${e.count}`).join('|');
    if (shown === this.#eventsShown) return;
    this.#eventsShown = shown;
    element('events').replaceChildren(
      ...list.map((event) => {
        const item = document.createElement('li');
        item.dataset.kind = event.kind;
        const time = document.createElement('time');
        time.textContent = event.at.toLocaleTimeString('en-GB');
        item.append(time, event.count > 1 ? `${event.text} × ${grouped(event.count)}` : event.text);
        return item;
      }),
    );
  }
}

type PageState = 'connecting' | 'lost' | 'silent' | 'waiting' | 'flying' | 'quiet' | 'pose' | 'paused' | 'over' | 'saved';

const kStateNames: Record<PageState, string> = {
  connecting: 'Connecting',
  lost: 'Link lost',
  silent: 'Silence',
  waiting: 'No data yet',
  flying: 'Flying',
  quiet: 'No frames',
  pose: 'Pose lost',
  paused: 'Paused',
  over: 'Flight over',
  saved: 'Saved map',
};
