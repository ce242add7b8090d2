// Finds visible nodes by drawing the triangles into a depth picture. Linear in the surface and in its pixels.

import type { Seen } from '../view/seen';

/** The least depth at every pixel, Infinity where there is none. */
function depths(screen: Float32Array, triangles: Uint32Array, width: number, height: number): Float32Array {
  const nearest = new Float32Array(width * height).fill(Infinity);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ax, ay, bx, by, cx, cy] = [screen[a], screen[a + 1], screen[b], screen[b + 1], screen[c], screen[c + 1]];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) continue;
    const alongX = ((screen[b + 2] - screen[a + 2]) * (cy - ay) - (screen[c + 2] - screen[a + 2]) * (by - ay)) / area;
    const alongY = ((screen[c + 2] - screen[a + 2]) * (bx - ax) - (screen[b + 2] - screen[a + 2]) * (cx - ax)) / area;
    const bottom = Math.min(height - 1, Math.floor(Math.max(ay, by, cy)));
    const right = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx)));
    const left = Math.max(0, Math.floor(Math.min(ax, bx, cx)));
    for (let row = Math.max(0, Math.floor(Math.min(ay, by, cy))); row <= bottom; ++row) {
      const y = row + 0.5;
      for (let column = left; column <= right; ++column) {
        const x = column + 0.5;
        const u = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area;
        const v = ((y - ay) * (bx - ax) - (x - ax) * (by - ay)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const depth = screen[a + 2] + (x - ax) * alongX + (y - ay) * alongY;
        const pixel = row * width + column;
        if (depth < nearest[pixel]) nearest[pixel] = depth;
      }
    }
  }
  return nearest;
}

/** 1 for nodes that are seen: at one of the pixels around, nothing lies clearly before them. screen: as projected. */
export function visibleNodes(screen: Float32Array, { triangles, width, height }: Pick<Seen, 'triangles' | 'width' | 'height'>): Uint8Array {
  const [columns, rows] = [Math.ceil(width), Math.ceil(height)];
  const nearest = depths(screen, triangles, columns, rows);
  const visible = new Uint8Array(screen.length / 3);
  for (let node = 0; node < visible.length; ++node) {
    const [column, row, depth] = [Math.floor(screen[3 * node]), Math.floor(screen[3 * node + 1]), screen[3 * node + 2] - 1e-4];
    for (let y = row - 1; y <= row + 1; ++y) {
      for (let x = column - 1; x <= column + 1; ++x) {
        if (x >= 0 && x < columns && y >= 0 && y < rows && nearest[y * columns + x] >= depth) visible[node] = 1;
      }
    }
  }
  return visible;
}
