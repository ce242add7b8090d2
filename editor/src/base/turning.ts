// Turns as vectors: along the axis, as long as the angle.

import { cross, dot, type Vector } from './vectors';

/** The least turn from one unit vector to another that is not opposite. */
export function turnBetween(from: ArrayLike<number>, to: ArrayLike<number>): Vector {
  const axis = cross(from, to);
  const sine = Math.hypot(...axis);
  const angle = Math.atan2(sine, dot(from, to));
  return axis.map((part) => (sine > 0 ? (part / sine) * angle : 0)) as Vector;
}

/** Vectors, three numbers each, all turned alike. */
export function turned(vectors: Float64Array, turn: Vector): Float64Array {
  const angle = Math.hypot(...turn);
  if (angle === 0) return vectors.slice();
  const axis = turn.map((part) => part / angle);
  const result = new Float64Array(vectors.length);
  for (let k = 0; k < vectors.length; k += 3) {
    const vector = vectors.subarray(k, k + 3);
    const across = cross(axis, vector);
    const along = dot(axis, vector) * (1 - Math.cos(angle));
    for (let i = 0; i < 3; ++i) result[k + i] = Math.cos(angle) * vector[i] + Math.sin(angle) * across[i] + along * axis[i];
  }
  return result;
}

/** Where a unit vector points once the tip of its arrow has moved on the screen by parts of its length. frame: right, up and towards the eye. */
export function tilted(vector: ArrayLike<number>, frame: readonly Vector[], right: number, up: number): Vector {
  const [x, y, z] = frame.map((axis) => dot(axis, vector));
  const [tipX, tipY] = [x + right, y + up];
  const reach = Math.max(1, Math.hypot(tipX, tipY));
  const parts = [tipX / reach, tipY / reach, 0];
  parts[2] = Math.sqrt(Math.max(0, 1 - parts[0] ** 2 - parts[1] ** 2)) * (z < 0 ? -1 : 1);
  return [0, 1, 2].map((i) => parts.reduce((sum, part, k) => sum + part * frame[k][i], 0)) as Vector;
}

/** The same of a vector that stays in a plane, whose unit normal is given. */
export function tiltedWithin(plane: Vector, vector: ArrayLike<number>, frame: readonly Vector[], right: number, up: number): Vector {
  const tip = [0, 1, 2].map((i) => vector[i] + right * frame[0][i] + up * frame[1][i]);
  const out = dot(tip, plane);
  const within = tip.map((part, i) => part - out * plane[i]);
  const length = Math.hypot(...within);
  return (length > 0 ? within.map((part) => part / length) : [...Array.from(vector)]) as Vector;
}
