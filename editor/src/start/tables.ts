// Files of numbers in rows: a curve in order, or scattered points.

/** Rows with at least two numbers; other lines are names and notes. */
export function rowsOf(text: string): number[][] {
  return text.split('\n').map((line) => line.trim().split(/[\s,;]+/).map(Number)).filter((row) => row.length >= 2 && row.slice(0, 2).every(Number.isFinite));
}

const median = (values: number[]): number => values.sort((a, b) => a - b)[values.length >> 1];
/** As many rows are looked at, spread over all. */
const sampled = 200;
/** Of scattered points the next row is so many times as far away as the nearest one. */
const far = 3;

export function areScattered(rows: readonly number[][]): boolean {
  if (rows.length < 8) return false;
  const distance = (a: number, b: number): number => Math.hypot(...rows[a].map((part, i) => part - (rows[b][i] ?? 0)));
  const every = Math.max(1, Math.floor(rows.length / sampled));
  const some = [...rows.keys()].filter((k) => k % every === 0 && k + 1 < rows.length);
  const step = median(some.map((k) => distance(k, k + 1)));
  const nearest = median(some.map((k) => rows.reduce((least, _, other) => (other === k ? least : Math.min(least, distance(k, other))), Infinity)));
  return step > far * nearest;
}
