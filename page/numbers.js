// Numbers for people, and statistics of many of them.

// Four digits, as in the table on the terminal.
export function short(value, whole = false) {
  if (value === null || value === undefined) return '';
  if (whole) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return value.toExponential(3).replace(/\.?0+e/, 'e').replaceAll('-', '−');
  return String(Number(value.toPrecision(4))).replaceAll('-', '−');
}

export function quantiles(values, shares) {
  const sorted = Float64Array.from(values).sort();
  return shares.map((share) => sorted.length ? sorted[Math.round(share * (sorted.length - 1))] : 0);
}

// Round numbers within a range, for an axis.
export function ticksOf(low, high, wanted = 6) {
  const rough = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; ++k) ticks.push(k * step);
  return ticks;
}

// At most about eight powers of ten within a range.
export function powersOf(low, high) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first) / 7));
  return Array.from({length: Math.max(0, Math.floor((last - first) / step) + 1)}, (_, k) => 10 ** (first + k * step));
}
