// Documents opened before, with all their steps: opening another one can be undone like any step.

import type { Constraints } from '../constraints/constraints';
import type { Source } from './editor';
import type { History } from './history';

export interface Document {
  readonly source: Source;
  readonly history: History<Constraints>;
  readonly strength: number;
}

/** As many are kept, with the bytes of their files. */
const most = 6;

export class Documents {
  private past: Document[] = [];
  private future: Document[] = [];

  /** Null: what is open has nothing that could be lost, and is forgotten. */
  opened(left: Document | null): void {
    if (left) this.past = [...this.past, left].slice(-most);
    this.future = [];
  }

  get before(): Document | undefined {
    return this.past.at(-1);
  }

  get after(): Document | undefined {
    return this.future[0];
  }

  /** now: what is open and is to be left. */
  back(now: Document | null): void {
    this.past.pop();
    if (now) this.future.unshift(now);
  }

  forward(now: Document | null): void {
    this.future.shift();
    if (now) this.past.push(now);
  }
}
