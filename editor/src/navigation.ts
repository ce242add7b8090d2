// How buttons, wheel and fingers move the camera.

import { MOUSE, TOUCH } from 'three';
import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';

/** taken: a tool has the left button and the single finger; the right button then turns. Two fingers always move and zoom. */
export function assignButtons(controls: OrbitControls, taken: boolean): void {
  controls.mouseButtons = { LEFT: taken ? null : MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: taken ? MOUSE.ROTATE : MOUSE.PAN };
  controls.touches = { ONE: taken ? null : TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN };
}

/** With Shift the wheel, or two fingers on a touchpad, move the view; without, the camera's controls zoom, as they do for a pinch. */
export function moveByWheel(canvas: HTMLCanvasElement, move: (across: number, down: number) => void): void {
  canvas.addEventListener('wheel', (event) => {
    if (!event.shiftKey || event.ctrlKey) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    const pixels = [1, 16, canvas.clientHeight][event.deltaMode];
    move(-pixels * event.deltaX, -pixels * event.deltaY);
  }, { capture: true, passive: false });
}
