// A slider from the input to the result.

/** The slider goes from 0 to 100; settled: it has been let go. */
export function bindStrength(slider: HTMLInputElement, set: (share: number, settled: boolean) => void): void {
  slider.addEventListener('input', () => set(slider.valueAsNumber / 100, false));
  slider.addEventListener('change', () => set(slider.valueAsNumber / 100, true));
}
