// Drags: held positions follow the pointer, or normals or tangents turn with it. The shape follows; on release it is
// faired anew.

import { turned } from '../base/turning';
import type { Vector } from '../base/vectors';
import type { Solver } from '../library/client';
import type { Drag, Job, Part, Report, Solved } from '../library/protocol';
import type { Mirror } from '../shape/mirror';
import type { Shape } from '../shape/shape';
import { placed, type Constraints } from '../constraints/constraints';
import { Ahead } from './ahead';
import { Pull } from './pull';

/** Moving nodes from which on the library is taken to be slower than the pointer; and seconds in which it is not. */
const many = 30_000;
const quick = 0.1;
/** Of the size, the first step: of many nodes a short one, as what is known of the way is soon to be better. */
const firstStep = 0.02;
const firstOfMany = 0.005;
/** Milliseconds between pictures of what is ahead: drawing takes from the library's time. */
const pause = 70;

/** What a drag knows of the shape, and tells whoever has it. */
export interface Pulled {
  readonly shape: Shape | null;
  /** The newest shape that is solved, without what the drag is ahead of it. */
  readonly result: Float64Array;
  readonly report: Report | null;
  readonly busy: boolean;
  readonly constraints: Constraints;
  /** Picked nodes go as their mirror images do. */
  readonly mirror: Mirror | null;
  readonly picked: ReadonlySet<number>;
  readonly normals: ReadonlyMap<number, Vector>;
  isDraggable(node: number): boolean;
  placeOf(node: number): Vector;
  pick(node: number, add: boolean): void;
  /** What holds for only what is near to go along; null where what holds already says what does. */
  nearby(nodes: readonly number[]): Promise<Constraints | null> | null;
  jobOf(constraints: Constraints): Job;
  dragBegun(now: number): void;
  showDrag(): void;
  turnNormals(nodes: readonly number[], vectors: Float64Array): void;
  /** The drag is a step. */
  apply(label: string, constraints: Constraints): void;
  /** It was none. */
  settle(): void;
  leaveTrial(): void;
  setFault(message: string, source: 'solver'): void;
}

export class Drags {
  private pull: Pull | null = null;
  private ahead: Ahead | null = null;
  /** Whether pictures show what is ahead of the library. */
  slow = false;
  private foresees = false;
  private shown = true;
  private asked = false;
  /** What holds while only what is near goes along, once that is known. */
  private near: Promise<Constraints | null> | null = null;
  private base: Constraints | null = null;
  private waits = false;
  /** The one that the pointer has taken. */
  node = -1;

  constructor(private readonly editor: Pulled, private readonly solver: Solver) {}

  get part(): Part | null {
    return this.pull?.part ?? null;
  }

  /** Takes the node, and with it the picked ones if it is one of them: of a node that is held those that are, of a free one all. */
  begin(part: Part, node: number, now: number): void {
    const { editor } = this;
    editor.leaveTrial();
    if (!editor.picked.has(node)) editor.pick(node, false);
    const turns = part !== 'position';
    const nodes = [...editor.picked].filter((other) => (turns ? editor.normals.has(other) : editor.isDraggable(other) || !editor.isDraggable(node)));
    const start = Float64Array.from(nodes.flatMap((other) => (turns ? editor.normals.get(other)! : editor.placeOf(other))));
    const { mirror } = editor;
    const each = (way: Vector, k: number): Vector => mirror?.mirrored(way, node, nodes[k], turns) ?? way;
    const at = (way: Vector): Float64Array => Float64Array.from(nodes.flatMap((_, k) => {
      const [from, to] = [start.subarray(3 * k, 3 * k + 3), each(way, k)];
      return turns ? [...turned(from, to)] : to.map((part, i) => from[i] + part);
    }));
    this.node = node;
    const { report, shape } = editor;
    this.ahead = shape!.curve ? null : new Ahead(editor.busy ? null : editor.result);
    this.slow = this.ahead !== null && (report?.movingNodes ?? 0) > many;
    const first = shape!.curve ? Infinity : this.slow ? firstOfMany : firstStep;
    this.pull = new Pull(part, nodes, at, turns ? Math.PI : 1 / shape!.scale, first);
    editor.dragBegun(now);
    this.foresees = this.slow;
    this.base = null;
    this.near = turns ? null : editor.nearby(nodes);
    this.waits = this.near !== null;
    if (this.near) void this.wait(this.pull, this.near);
  }

  /** The pointer goes on meanwhile. */
  private async wait(pull: Pull, near: Promise<Constraints | null>): Promise<void> {
    const base = await near.catch(() => null);
    if (pull !== this.pull) return;
    this.base = base;
    this.waits = false;
    this.solver.push({ ...(base && this.editor.jobOf(base)), drag: pull.step() });
  }

  /** The shape where the pointer is, as far as that is known before it is solved; null where it is soon enough solved. */
  get shape(): Float64Array | null {
    return this.pull && this.slow ? this.ahead!.at(this.pull.way) : null;
  }

  /** way: from where the drag began; of normals a turn. */
  by(way: Vector, time: number): void {
    if (!this.pull) return;
    this.pull.aim(way, time);
    if (this.waits) return;
    if (this.pull.part !== 'position') this.editor.turnNormals(this.pull.nodes, this.pull.vectors);
    if (this.foresees) this.solver.push({ drag: { ...this.pull.whole(), rough: true } });
    this.foresees = false;
    this.solver.push({ drag: this.pull.step() });
    if (this.slow) this.show();
  }

  /** At most once for each picture. */
  private show(): void {
    this.shown = false;
    if (this.asked) return;
    this.asked = this.shown = true;
    this.editor.showDrag();
    setTimeout(() => {
      this.asked = false;
      if (this.pull && !this.shown) this.show();
    }, pause);
  }

  end(keep: boolean): void {
    if (!this.pull) return;
    const { editor, waits, near } = this;
    const { part, nodes, vectors } = this.pull;
    const apply = (base: Constraints | null): void => editor.apply(labelOf(part, nodes), placed(base ?? editor.constraints, nodes, vectors, part));
    const { base } = this;
    this.drop();
    if (!keep) editor.settle();
    else if (waits) void near!.then(apply, (error: Error) => editor.setFault(error.message, 'solver'));
    else apply(base);
  }

  drop(): void {
    this.pull = this.ahead = this.near = this.base = null;
    this.waits = false;
  }

  solved(drag: Drag, { positions, report }: Solved): void {
    if (!this.pull || this.waits) return;
    const rough = report.outcome === 'foreseen';
    this.ahead?.add(drag.way, positions, rough);
    if (rough) {
      this.show();
      return;
    }
    this.slow = this.ahead !== null && report.seconds > quick;
    // A fit starts from the input, however long the step.
    this.pull.solved(drag, report.fit ? 0 : report.iterations);
    if (!this.pull.arrived) this.solver.push({ drag: this.pull.step() });
  }
}

export function labelOf(part: Part, nodes: readonly number[]): string {
  const what = nodes.length === 1 ? `node ${nodes[0]}` : `${nodes.length} nodes`;
  return part === 'position' ? `Move ${what}` : `Tilt ${part}${nodes.length === 1 ? '' : 's'} of ${what}`;
}
