// What is open, and all that was done to it, outlives the page: a reload or a crash loses nothing.

import { createStore, delMany, getMany, setMany } from 'idb-keyval';
import type { Constraints } from '../constraints/constraints';
import type { Editor, Source } from './editor';
import type { History } from './history';
import type { Opening } from './opening';

interface State {
  /** Of this form; another one is not read. */
  form: 1;
  history: History<Constraints>;
  strength: number;
}

const storage = createStore('vspring-editor', 'kept');

export class Autosave {
  /** What opened the shape that the page began with, which is kept only once something is done to it. */
  private first: Source | null = null;
  private kept: { source: Source | null; history: History<Constraints> | null; strength: number } = { source: null, history: null, strength: 1 };
  private writing = false;
  private begun = false;
  private complained = false;

  constructor(private readonly editor: Editor, private readonly opening: Opening, private readonly notice: HTMLElement) {}

  /** What was kept comes back. Returns whether something did. */
  async restore(): Promise<boolean> {
    const { editor } = this;
    try {
      const [source, state] = (await getMany(['source', 'state'], storage)) as [Source | undefined, State | undefined];
      if (!source || state?.form !== 1) return false;
      await this.opening.restore({ source, history: state.history, strength: state.strength });
      this.kept = { source, history: editor.history, strength: editor.strength };
      this.notice.hidden = false;
      this.notice.querySelector('span')!.textContent = `Restored ${editor.name}`;
      return true;
    } catch {
      return false;  // if nothing can be kept either, that is said at the first change
    }
  }

  /** From now on all changes are kept. */
  begin(): void {
    this.begun = true;
    this.first = this.editor.source;
    this.changed();
  }

  async forget(): Promise<void> {
    this.notice.hidden = true;
    this.begun = false;
    this.kept = { source: null, history: null, strength: 1 };
    try {
      await delMany(['source', 'state'], storage);
    } catch (error) {
      this.complain(error);
    }
  }

  changed(): void {
    const { source, history, strength } = this.editor;
    if (source !== this.first) this.notice.hidden = true;
    const { kept } = this;
    if (!this.begun || this.writing || (kept.source === source && kept.history === history && kept.strength === strength)) return;
    if (!source || (source === this.first && history.past.length + history.future.length === 0)) return;
    void this.write();
  }

  private async write(): Promise<void> {
    const { source, history, strength } = this.editor;
    const state: State = { form: 1, history, strength };
    this.writing = true;
    try {
      // The bytes of a large file are written once.
      await setMany(Object.entries(source === this.kept.source ? { state } : { source, state }), storage);
    } catch (error) {
      this.complain(error);
    }
    this.kept = { source, history, strength };
    this.writing = false;
    this.changed();
  }

  private complain(error: unknown): void {
    if (this.complained) return;
    this.complained = true;
    this.editor.setFault(`The browser keeps nothing for a reload: ${error instanceof Error ? error.message : error}. Save your work as files`, 'file');
  }
}
