// Saves the open shape with all its steps: a reload, a crash, another file or another page loses nothing.

import type { Editor, Source } from './editor';
import type { History } from './history';
import type { Opening } from './opening';
import type { Constraints } from '../constraints/constraints';
import { claimSlot, dropSlot, listSlots, readSlot, releaseSlot, writeSlot, type About } from './slots';

/** As many files are kept. */
const most = 8;
/** Milliseconds to wait for what a page had. One that is reloaded lets go of it, on a busy machine late. */
const patienceOfReload = 20_000;
/** A page may also be a copy of another, which keeps it. */
const patience = 500;
/** Where the page keeps what it has: it comes back with the page, and another page has its own. */
const key = 'vspring-slot';

function own(): string | null {
  try {
    return sessionStorage.getItem(key);
  } catch {
    return null;  // if the browser stores nothing
  }
}

function setOwn(slot: string): void {
  try {
    sessionStorage.setItem(key, slot);
  } catch {
    // Then the newest one is restored.
  }
}

export class Autosave {
  /** What opened the shape that the page began with, which is kept only once something is done to it. */
  private first: Source | null = null;
  private kept: { source: Source | null; history: History<Constraints> | null; strength: number } = { source: null, history: null, strength: 1 };
  private slots = new WeakMap<Source, string>();
  private writing = false;
  private begun = false;
  private complained = false;

  /** listed: what may be brought back has changed. */
  constructor(private readonly editor: Editor, private readonly opening: Opening, private readonly notice: HTMLElement, private readonly listed: (recent: About[]) => void) {}

  /** What this page had comes back, or else the newest that no other page has. Returns whether something did. */
  async restore(): Promise<boolean> {
    try {
      const mine = own();
      const [navigation] = performance.getEntriesByType('navigation') as (PerformanceNavigationTiming | undefined)[];
      const mostWait = navigation?.type === 'reload' ? patienceOfReload : patience;
      const all = (await listSlots()).map(({ slot }) => slot);
      for (const slot of [...all.filter((slot) => slot === mine), ...all.filter((slot) => slot !== mine)]) {
        if (!(await claimSlot(slot, slot === mine ? mostWait : 0))) continue;
        if (await this.bringBack(slot)) return true;
        releaseSlot(slot);
      }
    } catch {
      // If saving is impossible, too, the first change shows a message.
    }
    return false;
  }

  /** In place of what is open, which opening it again is undone by. What another page has is brought back as another one. */
  async reopen(slot: string): Promise<void> {
    try {
      if (!(await this.bringBack(slot, await claimSlot(slot)))) throw new Error('That file is no longer kept: open it anew');
    } catch (error) {
      this.editor.setFault((error as Error).message, 'file');
    }
  }

  /** goesOn: what is done to it from then on is kept in its place. */
  private async bringBack(slot: string, goesOn = true): Promise<boolean> {
    const { editor } = this;
    const found = await readSlot(slot);
    if (!found) return false;
    const { source, state } = found;
    if (goesOn) this.slots.set(source, slot);
    this.writing = true;
    try {
      await this.opening.reopen({ source, ...state });
    } finally {
      this.writing = false;
    }
    if (goesOn) setOwn(slot);
    this.kept = { source, history: editor.history, strength: editor.strength };
    this.first = source;
    this.notice.hidden = false;
    this.notice.querySelector('span')!.textContent = `Restored ${editor.name}`;
    return true;
  }

  /** From now on all changes are kept. */
  begin(): void {
    this.begun = true;
    this.first = this.editor.source;
    this.changed();
    void this.list();
  }

  /** What is open is kept no longer, until begin(). */
  async forget(): Promise<void> {
    const { slot } = this;
    this.notice.hidden = true;
    this.begun = false;
    this.kept = { source: null, history: null, strength: 1 };
    this.slots = new WeakMap();
    try {
      if (slot) await dropSlot(slot);
    } catch (error) {
      this.complain(error);
    }
  }

  /** Only what is open, here or in another page, is kept. */
  async forgetOthers(): Promise<void> {
    try {
      for (const { slot } of await listSlots()) if (slot !== this.slot) await this.dropped(slot);
    } catch (error) {
      this.complain(error);
    }
    await this.list();
  }

  /** Of what is open. */
  private get slot(): string | undefined {
    const { source } = this.editor;
    return source ? this.slots.get(source) : undefined;
  }

  changed(): void {
    const { source, history, strength } = this.editor;
    if (source !== this.first) this.notice.hidden = true;
    const { kept } = this;
    if (!this.begun || this.writing || (kept.source === source && kept.history === history && kept.strength === strength)) return;
    if (!source || (!this.slots.has(source) && (source === this.first || !this.opening.isOwn) && history.past.length + history.future.length === 0)) return;
    void this.write(source);
  }

  private async write(source: Source): Promise<void> {
    const { history, strength, name } = this.editor;
    this.writing = true;
    const slot = this.slots.get(source) ?? `${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}`;
    this.slots.set(source, slot);
    setOwn(slot);
    try {
      await claimSlot(slot);
      await this.withRoom(slot, () => writeSlot({ form: 2, slot, name, step: history.now.label, time: Date.now() }, source, { history, strength }));
    } catch (error) {
      this.complain(error);
    }
    this.kept = { source, history, strength };
    this.writing = false;
    void this.list();
    this.changed();
  }

  /** The oldest others go where there are too many, or no room. */
  private async withRoom(slot: string, write: () => Promise<void>): Promise<void> {
    const others = async (): Promise<string[]> => (await listSlots()).map((about) => about.slot).filter((other) => other !== slot);
    try {
      await write();
    } catch (error) {
      const oldest = (await others()).at(-1);
      if (!oldest || !(await this.dropped(oldest))) throw error;
      await this.withRoom(slot, write);
    }
    for (const other of (await others()).slice(most - 1)) await this.dropped(other);
  }

  /** Unless another page has it. */
  private async dropped(slot: string): Promise<boolean> {
    const free = await claimSlot(slot);
    if (free) await dropSlot(slot);
    releaseSlot(slot);
    return free;
  }

  private async list(): Promise<void> {
    try {
      this.listed(await listSlots());
    } catch {
      // The message appears when something is to be saved.
    }
  }

  private complain(error: unknown): void {
    if (this.complained) return;
    this.complained = true;
    this.editor.setFault(`The browser keeps nothing for a reload: ${error instanceof Error ? error.message : error}. Save your work as files`, 'file');
  }
}
