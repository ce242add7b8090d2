// Which buttons turn and move the view: the editor's own, or those of other programs. The browser keeps the choice.

import { MOUSE } from 'three';

export const presets = ['vspring', 'blender', 'rhino', 'trackpad'] as const;
export type Preset = (typeof presets)[number];

export interface Buttons {
  /** Null: it is not the view's. With Shift what turns moves, and the other way round. */
  left: MOUSE | null;
  middle: MOUSE;
  right: MOUSE;
  /** Whether the wheel, or two fingers, turn the view; pinching zooms then. */
  wheelTurns: boolean;
}

export const buttonsOf: Record<Preset, Buttons> = {
  vspring: { left: MOUSE.ROTATE, middle: MOUSE.PAN, right: MOUSE.PAN, wheelTurns: false },
  blender: { left: null, middle: MOUSE.ROTATE, right: MOUSE.PAN, wheelTurns: false },
  rhino: { left: null, middle: MOUSE.PAN, right: MOUSE.ROTATE, wheelTurns: false },
  trackpad: { left: MOUSE.ROTATE, middle: MOUSE.PAN, right: MOUSE.PAN, wheelTurns: true },
};

const key = 'vspring-mouse';

export function keptPreset(): Preset {
  try {
    return presets.find((preset) => preset === localStorage.getItem(key)) ?? 'vspring';
  } catch {
    return 'vspring';  // if the browser stores nothing
  }
}

function keepPreset(preset: Preset): void {
  try {
    localStorage.setItem(key, preset);
  } catch {
    // The choice then lasts as long as the page.
  }
}

export function bindPresets(menu: HTMLSelectElement, chosen: (preset: Preset) => void): void {
  menu.value = keptPreset();
  menu.addEventListener('change', () => {
    const preset = menu.value as Preset;
    keepPreset(preset);
    chosen(preset);
  });
}
