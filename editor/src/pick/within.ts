// Finds the nodes in an outline on the screen. screen: pixels across and down and a depth for each node. Linear in
// their number.

type Point = readonly [number, number];

function where(screen: Float32Array, inside: (x: number, y: number) => boolean): number[] {
  const nodes: number[] = [];
  for (let k = 0; k < screen.length; k += 3) if (inside(screen[k], screen[k + 1])) nodes.push(k / 3);
  return nodes;
}

export function inBox(screen: Float32Array, [ax, ay]: Point, [bx, by]: Point): number[] {
  const [left, right, top, bottom] = [Math.min(ax, bx), Math.max(ax, bx), Math.min(ay, by), Math.max(ay, by)];
  return where(screen, (x, y) => x >= left && x <= right && y >= top && y <= bottom);
}

/** Within a loop, whatever its form; to half a pixel. */
export function inLoop(screen: Float32Array, loop: readonly Point[]): number[] {
  // The outline's crossings with each row of pixels, so a node needs only its own row.
  const crossings = new Map<number, number[]>();
  loop.forEach(([ax, ay], k) => {
    const [bx, by] = loop[(k + 1) % loop.length];
    for (let row = Math.ceil(Math.min(ay, by)); row < Math.max(ay, by); ++row) {
      const x = ax + ((row - ay) * (bx - ax)) / (by - ay);
      const list = crossings.get(row);
      if (list) list.push(x);
      else crossings.set(row, [x]);
    }
  });
  return where(screen, (x, y) => (crossings.get(Math.round(y)) ?? []).filter((crossing) => crossing < x).length % 2 === 1);
}

/** Nodes by squares of the screen, so that many short strokes each look at few of them. Those off the screen are left out. */
export class Squares {
  private readonly begin: Int32Array;
  private readonly nodes: Int32Array;
  private readonly columns: number;
  private readonly rows: number;

  constructor(private readonly screen: Float32Array, width: number, height: number, private readonly side = 16) {
    this.columns = Math.ceil(width / side);
    this.rows = Math.ceil(height / side);
    this.begin = new Int32Array(this.columns * this.rows + 1);
    const squares = Int32Array.from({ length: screen.length / 3 }, (_, node) => this.squareAt(screen[3 * node], screen[3 * node + 1]));
    for (const square of squares) if (square >= 0) ++this.begin[square + 1];
    for (let square = 0; square + 1 < this.begin.length; ++square) this.begin[square + 1] += this.begin[square];
    this.nodes = new Int32Array(this.begin[this.begin.length - 1]);
    const next = this.begin.slice();
    squares.forEach((square, node) => { if (square >= 0) this.nodes[next[square]++] = node; });
  }

  /** Within a distance of the way from a to b. */
  inStroke([ax, ay]: Point, [bx, by]: Point, radius: number): number[] {
    const [dx, dy] = [bx - ax, by - ay];
    const length = dx * dx + dy * dy;
    const found: number[] = [];
    const last = (end: number, count: number): number => Math.min(count - 1, Math.floor((end + radius) / this.side));
    const first = (end: number): number => Math.max(0, Math.floor((end - radius) / this.side));
    for (let row = first(Math.min(ay, by)); row <= last(Math.max(ay, by), this.rows); ++row) {
      for (let column = first(Math.min(ax, bx)); column <= last(Math.max(ax, bx), this.columns); ++column) {
        const square = row * this.columns + column;
        for (const node of this.nodes.subarray(this.begin[square], this.begin[square + 1])) {
          const [x, y] = [this.screen[3 * node] - ax, this.screen[3 * node + 1] - ay];
          const share = length > 0 ? Math.min(1, Math.max(0, (x * dx + y * dy) / length)) : 0;
          if ((x - share * dx) ** 2 + (y - share * dy) ** 2 <= radius * radius) found.push(node);
        }
      }
    }
    return found;
  }

  private squareAt(x: number, y: number): number {
    const [column, row] = [Math.floor(x / this.side), Math.floor(y / this.side)];
    return column >= 0 && column < this.columns && row >= 0 && row < this.rows ? row * this.columns + column : -1;
  }
}
