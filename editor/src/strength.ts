// Between the input and the result.

/** input + share (result - input); at the ends those themselves. */
export function between(input: Float64Array, result: Float64Array, share: number): Float64Array {
  if (share === 0) return input;
  return share === 1 ? result : result.map((end, k) => input[k] + share * (end - input[k]));
}

/** The slider goes from 0 to 100; settled: it has been let go. */
export function bindStrength(slider: HTMLInputElement, set: (share: number, settled: boolean) => void): void {
  slider.addEventListener('input', () => set(slider.valueAsNumber / 100, false));
  slider.addEventListener('change', () => set(slider.valueAsNumber / 100, true));
}
