// How buttons, wheel and fingers move the camera.

import { MOUSE, TOUCH } from 'three';
import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { buttonsOf, type Preset } from './presets';

/** taken: a tool has the left button and the single finger; where no other button turns then, the right one does. Two fingers always move and zoom. */
export function assignButtons(controls: OrbitControls, taken: boolean, preset: Preset): void {
  const { left, middle, right } = buttonsOf[preset];
  controls.mouseButtons = { LEFT: taken ? null : left, MIDDLE: middle, RIGHT: taken && left === MOUSE.ROTATE ? MOUSE.ROTATE : right };
  controls.touches = { ONE: taken ? null : TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN };
}

export interface WheelEvents {
  move: (across: number, down: number) => void;
  turn: (across: number, down: number) => void;
  /** Whether the wheel turns; else the camera's controls zoom, as they do for a pinch. */
  turns: () => boolean;
}

/** With Shift the wheel, or two fingers on a touchpad, move the view. */
export function bindWheel(canvas: HTMLCanvasElement, { move, turn, turns }: WheelEvents): void {
  canvas.addEventListener('wheel', (event) => {
    if (event.ctrlKey || !(event.shiftKey || turns())) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    const pixels = [1, 16, canvas.clientHeight][event.deltaMode];
    (event.shiftKey ? move : turn)(-pixels * event.deltaX, -pixels * event.deltaY);
  }, { capture: true, passive: false });
}

const step = 40;
const ways: Record<string, [number, number]> = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };

/** Arrow keys turn the view, with Shift they move it, while the canvas has the focus. */
export function bindArrows(canvas: HTMLCanvasElement, { move, turn }: Pick<WheelEvents, 'move' | 'turn'>): void {
  canvas.addEventListener('keydown', (event) => {
    const way = ways[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    (event.shiftKey ? move : turn)(...way);
  });
}
