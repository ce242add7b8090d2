// Shows at once what is being opened: name, size and progress.

export interface Loading {
  name: string;
  /** In bytes, where it is known. */
  size?: number;
  /** Of reading it; without, nobody knows. */
  fraction?: number;
  doing: string;
}

function sizeOf(bytes: number): string {
  return bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} KB` : `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB`;
}

export function showLoading(card: HTMLElement, loading: Loading | null): void {
  card.hidden = !loading;
  if (!loading) return;
  const { name, size, fraction, doing } = loading;
  card.querySelector('b')!.textContent = name;
  card.querySelector('span')!.textContent = [size === undefined ? '' : sizeOf(size), doing].filter(Boolean).join(' · ');
  const bar = card.querySelector('progress')!;
  if (fraction === undefined) bar.removeAttribute('value');
  else bar.value = fraction;
}

/** The browser has painted what was said, or is about to stand still without anybody looking. */
export function painted(): Promise<void> {
  return new Promise((done) => {
    setTimeout(done, 200);
    requestAnimationFrame(() => setTimeout(done));
  });
}
