// Files in and out of the page: by button, by drop, by address, and as downloads.

import type { Loading } from './loading';

export interface NamedBytes {
  name: string;
  bytes: Uint8Array;
}

/** The last part of an address. */
export function nameOf(address: string): string {
  const path = new URL(address, document.baseURI).pathname;
  return decodeURIComponent(path.slice(path.lastIndexOf('/') + 1));
}

/** The bytes of an answer, told as they come. */
async function bytesOf(response: Response, told: (fraction: number | undefined, size: number | undefined) => void): Promise<Uint8Array> {
  const length = response.headers.get('Content-Encoding') ? 0 : Number(response.headers.get('Content-Length'));
  const size = length > 0 ? length : undefined;
  if (!response.body) return new Uint8Array(await response.arrayBuffer());
  const parts: Uint8Array[] = [];
  let sum = 0;
  const reader = response.body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    sum += part.value.length;
    told(size && Math.min(1, sum / size), size);
  }
  const bytes = new Uint8Array(sum);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** told: how far that is. */
export async function fromAddress(address: string, told: (loading: Loading) => void = () => {}): Promise<NamedBytes> {
  const doing = 'reading';
  told({ name: nameOf(address), doing });
  const response = await fetch(new URL(address, document.baseURI)).catch(() => null);
  if (!response?.ok) throw new Error(`${address} cannot be read${response ? `: the server answers ${response.status}` : ''}`);
  const name = nameOf(response.url);
  return { name, bytes: await bytesOf(response, (fraction, size) => told({ name, doing, fraction, size })) };
}

async function fromFile(file: File, told: (loading: Loading) => void): Promise<NamedBytes> {
  told({ name: file.name, size: file.size, doing: 'reading' });
  return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
}

/** Asks for a file; accept: as of an input element. */
export function choose(accept: string, chosen: (file: NamedBytes) => void, told: (loading: Loading) => void = () => {}): void {
  const input = Object.assign(document.createElement('input'), { type: 'file', accept });
  input.addEventListener('change', () => {
    if (input.files?.[0]) void fromFile(input.files[0], told).then(chosen);
  });
  input.click();
}

/** Takes files that are dropped anywhere on the page; over: whether one hangs above it. */
export function acceptDrops(over: (hangs: boolean) => void, dropped: (file: NamedBytes, alt: boolean) => void, told: (loading: Loading) => void): void {
  addEventListener('dragover', (event) => {
    event.preventDefault();
    over(true);
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) over(false);
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    over(false);
    const file = event.dataTransfer?.files[0];
    if (file) void fromFile(file, told).then((named) => dropped(named, event.altKey));
  });
}

export function download(name: string, content: Uint8Array | string): void {
  const address = URL.createObjectURL(new Blob([content as BlobPart]));
  Object.assign(document.createElement('a'), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

export function stem(name: string): string {
  return name.replace(/\.[^.]*$/, '');
}
