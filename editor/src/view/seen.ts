// Nodes in the view: where each is on the screen, and whether a triangle hides it.

/** What is seen: places in the units of the view, and how they come to the screen, by columns as in three.js. */
export interface Seen {
  places: Float32Array;
  triangles: Uint32Array;
  /** From places to the cube of the view. */
  matrix: ArrayLike<number>;
  width: number;
  height: number;
}

/** Pixels across and down, and the depth in the cube of the view. */
export function projected({ places, matrix: m, width, height }: Seen): Float32Array {
  const screen = new Float32Array(places.length);
  for (let k = 0; k < places.length; k += 3) {
    const [x, y, z] = [places[k], places[k + 1], places[k + 2]];
    screen[k] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) / 2 + 0.5) * width;
    screen[k + 1] = (0.5 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / 2) * height;
    screen[k + 2] = m[2] * x + m[6] * y + m[10] * z + m[14];
  }
  return screen;
}

/** Whether a triangle that does not have the node lies before a place. */
export function hides(screen: Float32Array, triangles: Uint32Array, [x, y, z]: Float32Array, node: number, slack: number): boolean {
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    if (a === node || b === node || c === node) continue;
    const [ax, ay] = [screen[3 * a] - x, screen[3 * a + 1] - y];
    const [bx, by] = [screen[3 * b] - x, screen[3 * b + 1] - y];
    const [cx, cy] = [screen[3 * c] - x, screen[3 * c + 1] - y];
    const [wa, wb, wc] = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    const sum = wa + wb + wc;
    if (sum === 0 || wa * sum < 0 || wb * sum < 0 || wc * sum < 0) continue;
    if ((wa * screen[3 * a + 2] + wb * screen[3 * b + 2] + wc * screen[3 * c + 2]) / sum < z - slack) return true;
  }
  return false;
}
