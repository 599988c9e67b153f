// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import inter from '@fontsource-variable/inter/files/inter-latin-wght-normal.woff2?url';

import {download, element} from './panel/dom';
import {Downloads} from './panel/downloads';
import {Inspector} from './panel/inspector';
import {keysToActions, type Actions} from './panel/keys';
import {drawProfile} from './panel/profile';
import {Slice} from './panel/slice';
import {StatusPanel} from './panel/status';
import {nextTheme, sceneTheme, startTheme} from './panel/theme';
import {Timeline} from './panel/timeline';
import {cssGradient, type Colouring} from './scene/colours';
import type {CameraMode} from './scene/cameras';
import {Viewer} from './scene/viewer';
import {EventLog} from './state/events';
import {World} from './state/world';
import {Link} from './wire/link';

document.fonts.add(new FontFace('Inter', `url(${inter})`, {weight: '100 900'}));
void document.fonts.load('16px Inter');
startTheme();

const world = new World();
const events = new EventLog();
const socket = new URL('ws' + location.search, location.href.replace(/^http/, 'ws').split('?')[0]);
const link = new Link(socket.href, {
  state: (state) => {
    if (state === 'lost') events.add('link', 'the link was lost');
  },
  hello: (hello) => {
    if (world.hello && world.hello.source !== hello.source) events.list = [];
    events.forget();
    world.start(hello);
  },
  message: (message) => {
    const {confirmed, isRight} = world.apply(message);
    if (confirmed) link.confirmed(isRight);
    if (message.type === 'frames' && world.hello) {
      status.framesCame(message.frames.length, performance.now());
      events.frames(message.frames, world.hello);
      viewer.refresh();
    } else if (message.type === 'course') {
      viewer.refresh();
    } else if (message.type === 'status' && world.hello) {
      events.status(message, world.hello, performance.now());
    }
  },
});
const viewer = new Viewer(element<HTMLCanvasElement>('view'), world, sceneTheme());
const slice = new Slice(world);
const inspector = new Inspector(world);
const timeline = new Timeline(world);
const status = new StatusPanel(world, link, events);
const downloads = new Downloads(world);

// ---- what the user can do

let colouring: Colouring = 'height';
function setColouring(next: Colouring): void {
  colouring = next;
  viewer.setColouring(next);
  element('colouring').textContent = next === 'height' ? 'Height' : 'Log-odds';
  element('ramp').style.background = cssGradient(next);
}
function setCamera(mode: CameraMode): void {
  viewer.setMode(mode);
  for (const button of document.querySelectorAll<HTMLElement>('[data-camera]')) {
    button.setAttribute('aria-checked', String(button.dataset.camera === mode));
  }
}
function toggle(what: keyof Viewer['show']): void {
  viewer.setShown(what, !viewer.show[what]);
  document.querySelector(`[data-show=${what}]`)?.setAttribute('aria-pressed', String(viewer.show[what]));
}
function setPaused(isPaused: boolean): void {
  link.setPace(isPaused ? 'hold' : 'flow');
  element('pause').setAttribute('aria-pressed', String(isPaused));
  element('pause').querySelector('use')!.setAttribute('href', isPaused ? '#i-play' : '#i-pause');
  element<HTMLButtonElement>('step').disabled = !isPaused;
}

const actions: Actions = {
  orbit: () => setCamera('orbit'),
  follow: () => setCamera('follow'),
  top: () => setCamera('top'),
  cut: () => toggle('cut'),
  free: () => toggle('free'),
  unknown: () => toggle('unknown'),
  boxes: () => toggle('boxes'),
  course: () => toggle('course'),
  colour: () => setColouring(colouring === 'height' ? 'logodds' : 'height'),
  pause: () => setPaused(link.pace !== 'hold'),
  step: () => link.pace === 'hold' && link.setPace('step'),
  higher: () => slice.moveBy(1),
  lower: () => slice.moveBy(-1),
  atCamera: () => {
    slice.followsCamera = !slice.followsCamera;
  },
  theme: () => {
    nextTheme();
    viewer.setTheme(sceneTheme());
  },
  screenshot: () => void viewer.picture().then((blob) => blob && download(blob, 'swiftlet.png')),
  save: () => downloads.open(),
  help: () => element<HTMLDialogElement>('keys').showModal(),
};
keysToActions(actions);

const clicks: [string, () => unknown][] = [
  ['pause', actions.pause], ['step', actions.step], ['shot', actions.screenshot], ['save', actions.save],
  ['theme', actions.theme], ['help', actions.help], ['colouring', actions.colour], ['slice-follow', actions.atCamera],
];
for (const [id, act] of clicks) element(id).addEventListener('click', () => act());
for (const button of document.querySelectorAll<HTMLElement>('[data-camera]')) {
  button.addEventListener('click', () => setCamera(button.dataset.camera as CameraMode));
}
for (const button of document.querySelectorAll<HTMLElement>('[data-show]')) {
  button.addEventListener('click', () => toggle(button.dataset.show as 'free'));
}
element('limit').addEventListener('change', (event) => link.setRate(Number((event.target as HTMLSelectElement).value)));

const canvas = element<HTMLCanvasElement>('view');
let pressed: [number, number] | null = null;
canvas.addEventListener('pointerdown', (event) => (pressed = [event.offsetX, event.offsetY]));
canvas.addEventListener('pointermove', (event) => {
  if (event.buttons === 0) inspector.point(viewer.pick(event.offsetX, event.offsetY), false);
});
canvas.addEventListener('click', (event) => {
  const isDrag = pressed && Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) > 5;
  if (!isDrag) inspector.point(viewer.pick(event.offsetX, event.offsetY), true);
});
slice.onPoint = (voxel, isKept) => inspector.point(voxel, isKept);

// ---- the page, drawn again and again

const isNarrow = window.matchMedia('(max-width: 820px)');
function layOut(): void {
  // In the strip that is swiped through, the timeline is one card among the others.
  const home = isNarrow.matches ? element('panels') : document.body;
  if (element('timeline-card').parentElement !== home) home.append(element('timeline-card'));
  const box = element('panels').getBoundingClientRect();
  const isBeside = box.height > window.innerHeight * 0.5;
  const timelineBox = element('timeline-card').getBoundingClientRect();
  const bottom = isBeside ? timelineBox.height + 12 : window.innerHeight - Math.min(box.top, element('controls').getBoundingClientRect().top);
  viewer.cameras.inset = {left: 0, right: isBeside ? box.width + 12 : 0, top: 64, bottom};
  viewer.resize();
}
new ResizeObserver(layOut).observe(document.body);
isNarrow.addEventListener('change', layOut); // at once: the observer waits for the next frame
window.addEventListener('load', layOut);

let panelsAt_ms = 0;
function drawAll(now_ms: number): void {
  requestAnimationFrame(drawAll);
  const frame = world.lastFrame;
  if (slice.followsCamera && frame) slice.moveTo(frame.position[2], false);
  if (viewer.sliceZ_m !== slice.z_m) {
    viewer.sliceZ_m = slice.z_m;
    viewer.refresh();
  }
  if (inspector.voxel !== viewer.picked) {
    viewer.picked = inspector.voxel;
    viewer.refresh();
  }
  viewer.draw(now_ms);
  // Figures and charts that change faster than this cannot be read.
  if (now_ms - panelsAt_ms < 80) return;
  panelsAt_ms = now_ms;
  element('show-course').hidden = !world.course;
  slice.draw();
  drawProfile(world);
  timeline.draw();
  inspector.draw();
  status.draw(now_ms);
  element('slice-z').textContent = `${slice.z_m.toFixed(2)} m`;
  element('slice-follow').setAttribute('aria-pressed', String(slice.followsCamera));
  const bounds = viewer.bounds;
  element('ramp-low').textContent = colouring === 'logodds' ? '0' : bounds ? `${bounds.low[2].toFixed(1)} m` : '';
  element('ramp-high').textContent = colouring === 'logodds' ? '255' : bounds ? `${bounds.high[2].toFixed(1)} m` : '';
}

setColouring('height');
layOut();
link.open();
requestAnimationFrame(drawAll);

// For the browser's console and the tests: what the page knows, to look at.
declare global {
  interface Window {
    swiftlet: {world: World; link: Link; viewer: Viewer; slice: Slice; events: EventLog};
  }
}
window.swiftlet = {world, link, viewer, slice, events};
