// A dropped file is opened, or becomes points that the open shape is fitted to. If it could be either, the page asks.

import type { NamedBytes } from '../base/files';
import { counted } from '../base/words';
import type { Editor } from '../edit/editor';
import type { Opening } from '../edit/opening';
import { areScattered, rowsOf } from './tables';

export interface DropEvents {
  open: (file: NamedBytes) => void;
  points: (file: NamedBytes) => void;
}

export class Dropped {
  private file: NamedBytes | null = null;

  constructor(private readonly dialog: HTMLDialogElement, private readonly editor: Editor, private readonly opening: Opening, private readonly events: DropEvents) {
    // Not as the dialog says that it has closed: that comes later, and on a busy machine after the next file was dropped.
    dialog.addEventListener('submit', ({ submitter }) => {
      const { value } = submitter as HTMLButtonElement;
      if (value === 'open') events.open(this.file!);
      else if (value === 'points') events.points(this.file!);
    });
  }

  /** alt: it is said to be points. */
  take(file: NamedBytes, alt: boolean): void {
    const { editor, events } = this;
    if (!editor.shape || !(alt || /\.(xyz|csv)$/i.test(file.name))) {
      events.open(file);
      return;
    }
    if (alt) {
      events.points(file);
      return;
    }
    const rows = rowsOf(new TextDecoder().decode(file.bytes));
    if (!this.opening.isOwn && !areScattered(rows)) events.open(file);
    else this.ask(file, rows.length);
  }

  private ask(file: NamedBytes, rows: number): void {
    this.file = file;
    const part = (name: string): HTMLElement => this.dialog.querySelector(`[data-part=${name}]`)!;
    part('file').textContent = `What is ${file.name}?`;
    part('open').textContent = `A curve through its ${counted(rows, 'row')}`;
    part('points').textContent = `Points for ${this.editor.name}`;
    this.dialog.showModal();
  }
}
