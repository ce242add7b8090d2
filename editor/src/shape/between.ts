// Between the input and the result.

/** input + share (result - input); at the ends those themselves. */
export function between(input: Float64Array, result: Float64Array, share: number): Float64Array {
  if (share === 0) return input;
  return share === 1 ? result : result.map((end, k) => input[k] + share * (end - input[k]));
}

/** The greatest distance between nodes of the same number. */
export function furthest(a: Float64Array, b: Float64Array): number {
  let most = 0;
  for (let k = 0; k < a.length; k += 3) most = Math.max(most, (a[k] - b[k]) ** 2 + (a[k + 1] - b[k + 1]) ** 2 + (a[k + 2] - b[k + 2]) ** 2);
  return Math.sqrt(most);
}
