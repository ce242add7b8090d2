// The file of `vspring edit`, named in the page's address: ?file= is read, ?save= receives the result on request.

import type { Command } from '../base/commands';
import { nameOf } from '../base/files';
import type { Constraints } from '../constraints/constraints';
import type { Editor, Source } from '../edit/editor';

export class ServedFile {
  private readonly name: string;
  private readonly button = Object.assign(document.createElement('button'), { type: 'button' });
  /** What it was opened from; the shape may get other nodes. */
  private source: Source | null = null;
  private saved: { constraints: Constraints; strength: number } | null = null;

  /** Null where nothing may be saved. before: what the button comes before. */
  static of(address: string, editor: Editor, before: Element): ServedFile | null {
    const query = new URL(address).searchParams;
    const [file, save] = [query.get('file'), query.get('save')];
    return file && save ? new ServedFile(file, save, editor, before) : null;
  }

  private constructor(private readonly file: string, private readonly address: string, private readonly editor: Editor, before: Element) {
    this.name = nameOf(address);
    this.button.dataset.command = 'save-back';
    const spoken = Object.assign(document.createElement('span'), { ariaLive: 'polite' });
    spoken.append(this.button);
    before.before(spoken);
    this.tell();
  }

  get command(): Command {
    return { id: 'save-back', title: `Save the result to ${this.name}`, keys: ['ctrl+s'], run: () => void this.save(), enabled: () => this.tell() };
  }

  /** What that address has is open. */
  opened(address: string): void {
    if (address !== this.file) return;
    this.source = this.editor.source;
    this.saved = null;
    this.editor.set({});
  }

  /** Whether there is something to save. Another surface, opened since, does not go into the file. */
  private tell(): boolean {
    const open = this.source !== null && this.source === this.editor.source;
    const { shown: constraints, strength } = this.editor;
    const saved = open && this.saved?.constraints === constraints && this.saved.strength === strength;
    const text = `${saved ? 'Saved' : 'Save'} to ${this.name}`;
    if (this.button.textContent !== text) this.button.textContent = text;
    return open && !saved;
  }

  private async save(): Promise<void> {
    const { shown: constraints, strength } = this.editor;
    try {
      const body = await this.editor.written(this.name);
      const response = await fetch(new URL(this.address, document.baseURI), { method: 'PUT', body: body as Uint8Array<ArrayBuffer> }).catch(() => null);
      if (!response) throw new Error(`${this.name} is not saved: vspring edit does not answer; start it again, or use Save as`);
      if (!response.ok) throw new Error(`${this.name} is not saved: ${await response.text()}`);
      this.saved = { constraints, strength };
      this.editor.set({ fault: null });
    } catch (error) {
      this.editor.setFault((error as Error).message, 'file');
    }
  }
}
