// Slots in the browser's storage: each file has its own, and a page writes only to its own slots.

import { createStore, delMany, get, getMany, keys, setMany } from 'idb-keyval';
import type { Constraints } from '../constraints/constraints';
import type { Source } from './editor';
import type { History } from './history';

export interface State {
  readonly history: History<Constraints>;
  readonly strength: number;
}

export interface About {
  /** Of this form; another one is not read. */
  readonly form: 2;
  readonly slot: string;
  readonly name: string;
  /** What was done last. */
  readonly step: string;
  /** When, as of Date.now(). */
  readonly time: number;
}

const storage = createStore('vspring-editor', 'kept');
const partsOf = (slot: string): [string, string, string] => [`about:${slot}`, `source:${slot}`, `state:${slot}`];

/** All that are kept, the newest first. */
export async function listSlots(): Promise<About[]> {
  const names = (await keys<string>(storage)).filter((key) => key.startsWith('about:'));
  const found = (await getMany(names, storage)) as (About | undefined)[];
  return found.flatMap((about) => (about?.form === 2 ? [about] : [])).sort((a, b) => b.time - a.time);
}

export async function readSlot(slot: string): Promise<{ source: Source; state: State } | null> {
  const [, source, state] = (await getMany(partsOf(slot), storage)) as [About | undefined, Source | undefined, State | undefined];
  return source && state ? { source, state } : null;
}

/** The bytes of a large file are written once, and again only where somebody has dropped them. */
export async function writeSlot(about: About, source: Source, state: State): Promise<void> {
  const [first, second, third] = partsOf(about.slot);
  const known = await get(first, storage);
  await setMany(known ? [[first, about], [third, state]] : [[first, about], [second, source], [third, state]], storage);
}

export function dropSlot(slot: string): Promise<void> {
  return delMany(partsOf(slot), storage);
}

/** What this page has: another page cannot have it meanwhile, and what is had ends with the page. */
const releases = new Map<string, () => void>();

/** patience: milliseconds to wait for a page that is about to be gone. Returns whether this page has it. Where the browser has no locks, all pages may have all. */
export function claimSlot(slot: string, patience = 0): Promise<boolean> {
  if (!('locks' in navigator) || releases.has(slot)) return Promise.resolve(true);
  return new Promise((told) => {
    const hold = (lock: Lock | null): Promise<void> | void => {
      told(lock !== null);
      return lock ? new Promise((release) => releases.set(slot, release)) : undefined;
    };
    const how: LockOptions = patience > 0 ? { signal: AbortSignal.timeout(patience) } : { ifAvailable: true };
    navigator.locks.request(`vspring-${slot}`, how, hold).catch(() => told(false));
  });
}

export function releaseSlot(slot: string): void {
  releases.get(slot)?.();
  releases.delete(slot);
}
