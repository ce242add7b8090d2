// What is held and goes with the pointer: positions of nodes, or their normals or tangents, which turn. The shape follows; on release it is faired anew.

import type { Solver } from './client';
import { placed, type Part, type Vector } from './constraints';
import type { Editor } from './editor';
import type { Drag, Solved } from './protocol';
import { Pull } from './pull';
import { turned } from './turning';

export class Drags {
  private pull: Pull | null = null;
  /** The one that the pointer has taken. */
  node = -1;

  constructor(private readonly editor: Editor, private readonly solver: Solver) {}

  get part(): Part | null {
    return this.pull?.part ?? null;
  }

  /** Takes the node, and with it all picked ones that are held if it is one of them. */
  begin(part: Part, node: number, now: number): void {
    const { editor } = this;
    if (!editor.picked.has(node)) editor.pick(node, false);
    const turns = part !== 'position';
    const nodes = [...editor.picked].filter((other) => (turns ? editor.normals.has(other) : editor.isDraggable(other)));
    const start = Float64Array.from(nodes.flatMap((other) => (turns ? editor.normals.get(other)! : editor.placeOf(other))));
    const at = (way: Vector): Float64Array => (turns ? turned(start, way) : start.map((place, k) => place + way[k % 3]));
    this.node = node;
    this.pull = new Pull(part, nodes, at, turns ? Math.PI : 1 / editor.shape!.scale, !editor.shape!.curve);
    editor.dragBegun(now);
  }

  /** way: from where the drag began; of normals a turn. */
  by(way: Vector, time: number): void {
    if (!this.pull) return;
    this.pull.aim(way, time);
    if (this.pull.part !== 'position') this.editor.turnNormals(this.pull.nodes, this.pull.vectors);
    this.solver.push({ drag: this.pull.step() });
  }

  end(keep: boolean): void {
    if (!this.pull) return;
    const { part, nodes, vectors } = this.pull;
    this.pull = null;
    if (keep) this.editor.apply(labelOf(part, nodes), placed(this.editor.constraints, nodes, vectors, part));
    else this.editor.settle();
  }

  drop(): void {
    this.pull = null;
  }

  solved(drag: Drag, { report }: Solved): void {
    if (!this.pull) return;
    // A fit starts from the input, however long the step.
    this.pull.solved(drag, report.fit ? 0 : report.iterations);
    if (!this.pull.arrived) this.solver.push({ drag: this.pull.step() });
  }
}

export function labelOf(part: Part, nodes: readonly number[]): string {
  const what = nodes.length === 1 ? `node ${nodes[0]}` : `${nodes.length} nodes`;
  return part === 'position' ? `Move ${what}` : `Tilt ${part}${nodes.length === 1 ? '' : 's'} of ${what}`;
}
