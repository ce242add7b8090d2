// Files in and out of the page: by button, by drop, by address, and as downloads.

export interface NamedBytes {
  name: string;
  bytes: Uint8Array;
}

/** The last part of an address. */
export function nameOf(address: string): string {
  const path = new URL(address, document.baseURI).pathname;
  return decodeURIComponent(path.slice(path.lastIndexOf('/') + 1));
}

export async function fromAddress(address: string): Promise<NamedBytes> {
  const response = await fetch(new URL(address, document.baseURI)).catch(() => null);
  if (!response?.ok) throw new Error(`${address} cannot be read${response ? `: the server answers ${response.status}` : ''}`);
  return { name: nameOf(response.url), bytes: new Uint8Array(await response.arrayBuffer()) };
}

async function fromFile(file: File): Promise<NamedBytes> {
  return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
}

/** Asks for a file; accept: as of an input element. */
export function choose(accept: string, chosen: (file: NamedBytes) => void): void {
  const input = Object.assign(document.createElement('input'), { type: 'file', accept });
  input.addEventListener('change', () => {
    if (input.files?.[0]) void fromFile(input.files[0]).then(chosen);
  });
  input.click();
}

/** Takes files that are dropped anywhere on the page; over: whether one hangs above it. */
export function acceptDrops(over: (hangs: boolean) => void, dropped: (file: NamedBytes, alt: boolean) => void): void {
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
    if (file) void fromFile(file).then((named) => dropped(named, event.altKey));
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
