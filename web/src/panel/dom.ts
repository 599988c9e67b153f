// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

/// The element of that id. The page is ours: one that is missing is a fault in it.
export function element<T extends Element = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element #${id}`);
  return found as unknown as T;
}

/// Makes a canvas as sharp as the screen and clears it; null while it is hidden.
export function sharp(canvas: HTMLCanvasElement): {g: CanvasRenderingContext2D; width: number; height: number} | null {
  const {clientWidth: width, clientHeight: height} = canvas;
  const g = canvas.getContext('2d');
  if (!g || width === 0 || height === 0) return null;
  const ratio = Math.min(3, window.devicePixelRatio || 1);
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  return {g, width, height};
}

/// A colour of the style sheet.
export function css(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function download(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const kGroups = new Intl.NumberFormat('en', {useGrouping: true});
/// 12 690, with thin spaces.
export function grouped(value: number): string {
  return kGroups.format(value).replaceAll(',', '\u2009');
}
