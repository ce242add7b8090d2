// Nodes of the open curve: a double click on it adds one there; keys add nodes between picked ones, or delete these.

import type { Command } from '../base/commands';
import { counted } from '../base/words';
import { gapsBetween, inserted, without, type Gap } from '../constraints/nodes';
import type { Editor } from '../edit/editor';
import { projected, type Seen } from '../view/seen';

/** Pixels from the curve, and to its nodes, which are not meant to get another one where they are. */
const reach = 8;
const apart = 5;

export class Nodes {
  /** To be made after the tool that draws, which has clicks to itself. active: whether clicks pick. */
  constructor(canvas: HTMLCanvasElement, private readonly editor: Editor, seen: () => Seen | null, active: () => boolean) {
    canvas.addEventListener('click', ({ offsetX, offsetY, detail }) => {
      if (detail !== 2 || !active() || !editor.shape?.curve) return;
      const gap = this.gapAt(seen()!, offsetX, offsetY);
      if (gap) this.insert([gap]);
    });
  }

  get commands(): Command[] {
    const enabled = (): boolean => this.editor.shape?.curve != null && this.editor.picked.size > 0;
    return [
      { id: 'insert', title: 'Insert nodes between picked ones, or behind one', keys: ['a'], enabled, run: () => this.insert(gapsBetween(this.editor.nodes, this.editor.picked)) },
      { id: 'delete', title: 'Delete picked nodes of a curve', keys: ['delete', 'backspace'], enabled, run: () => this.delete() },
    ];
  }

  private insert(gaps: readonly Gap[]): void {
    if (gaps.length === 0) return;
    const changed = inserted(this.editor.nodes, gaps);
    this.editor.renumber(`Insert ${counted(gaps.length, 'node')}`, changed, changed.added.map(({ node }) => node));
  }

  private delete(): void {
    const { editor } = this;
    try {
      editor.renumber(`Delete ${counted(editor.picked.size, 'node')}`, without(editor.nodes, editor.picked), []);
    } catch (error) {
      editor.setFault((error as Error).message, 'file');
    }
  }

  /** Where the curve passes within reach, seen from whoever looks at it. */
  private gapAt(seen: Seen, x: number, y: number): Gap | null {
    const { chainBegin, chainNodes, closed } = this.editor.nodes;
    const screen = projected(seen);
    const pixel = (node: number): [number, number] => [screen[3 * node], screen[3 * node + 1]];
    let found: Gap | null = null;
    let nearest = reach;
    closed.forEach((loop, chain) => {
      const nodes = chainNodes.subarray(chainBegin[chain], chainBegin[chain + 1]);
      for (let at = 0; at + (loop ? 0 : 1) < nodes.length; ++at) {
        const [ax, ay] = pixel(nodes[at]);
        const [bx, by] = pixel(nodes[(at + 1) % nodes.length]);
        const [dx, dy] = [bx - ax, by - ay];
        const length = Math.hypot(dx, dy);
        const along = ((x - ax) * dx + (y - ay) * dy) / length;
        const aside = Math.abs((x - ax) * dy - (y - ay) * dx) / length;
        if (!(along > apart && along < length - apart && aside < nearest)) continue;
        nearest = aside;
        found = { chain, at, share: along / length };
      }
    });
    return found;
  }
}
