// The state of the editor, and all that changes it.

import { CoreClient, Ended, Solver } from './client';
import * as holding from './constraints';
import type { Constraints, Edit, Held, Part, Vector } from './constraints';
import { Drags } from './drags';
import { FrameCounter } from './frames';
import { begun, done, redone, undone, type History } from './history';
import type { NamedBytes } from './files';
import type { Cloud, Fit, PointSource } from './points';
import type { Ask, FitJob, Job, Opened, Report, Solved } from './protocol';
import { restricted } from './region';
import { normalNear, nothing, shapeOf, type Shape } from './shape';
import { between } from './strength';

export interface EditorEvents {
  /** stays: where it is seen. */
  opened: (shape: Shape, stays: boolean) => void;
  /** Another shape is to be seen; settled: it is not one of many during a drag. */
  shape: (positions: Float64Array, settled: boolean) => void;
  /** Anything else that is shown has changed. */
  changed: () => void;
}

const cancelled: Report = { outcome: 'cancelled', iterations: 0, seconds: 0, threads: 1, expectedError: null, movingNodes: 0, warnings: [] };
/** What a shape was opened from: a file, or places that were clicked. */
export type Source = NamedBytes | Ask<'draw'>;

type FaultSource = 'file' | 'solver';

export class Editor {
  name = '';
  shape: Shape | null = null;
  report: Report | null = null;
  fileWarnings: string[] = [];
  fault: { message: string; source: FaultSource } | null = null;
  held: Held = { nodes: new Uint8Array(), unmarked: 0 };
  /** Normals that are held, of curves tangents, as the library takes them. */
  normals: Map<number, Vector> = new Map();
  picked: ReadonlySet<number> = new Set();
  hovered = -1;
  /** Whether the pointer is at the arrow of that node. */
  atArrow = false;
  busy = false;
  /** A file waits for its shape. */
  saving = false;
  fraction = 0;
  showsInput = false;
  /** Whether the curve was drawn here. */
  drawn = false;
  /** How far on the way from the input to the result that is which is seen and saved: 0 to 1. */
  strength = 1;
  history: History<Constraints> = begun(holding.initial);
  readonly frames = new FrameCounter();
  private positions: Float64Array = new Float64Array();
  seen: Float64Array = this.positions;
  private clouds = 0;
  source: Source | null = null;
  readonly client = new CoreClient((message) => this.setFault(message, 'file'));
  private readonly solver = new Solver(this.client, {
    solved: (solved, job) => this.solved(solved, job),
    failed: (message) => this.setFault(message, 'solver'),
    ended: () => { this.report = cancelled; },
    progress: (fraction) => this.set({ fraction }),
    busy: (busy) => this.set({ busy, fraction: 0 }),
  });

  readonly drags = new Drags(this, this.solver);

  constructor(private readonly events: EditorEvents) {}

  get constraints(): Constraints {
    return this.history.now.state;
  }

  get result(): Float64Array {
    return this.positions;
  }

  get dragging(): boolean {
    return this.drags.part !== null;
  }

  get canEnd(): boolean {
    return this.saving || (this.busy && !this.dragging);
  }

  set(state: Partial<Pick<Editor, 'atArrow' | 'busy' | 'fraction' | 'saving' | 'hovered' | 'picked' | 'fault'>>): void {
    Object.assign(this, state);
    this.events.changed();
  }

  setFault(message: string, source: FaultSource): void {
    this.set({ fault: { message, source } });
  }

  /** What the normal of a surface is to a curve: its tangent. */
  get direction(): Part {
    return this.shape?.curve ? 'tangent' : 'normal';
  }

  /** A shape or a constraints file. held: a constraints file for the shape. points: what it is drawn towards, with the weight of the paper's Fig. 12. What cannot be read leaves everything as it was. */
  async open(name: string, bytes: Uint8Array, held?: string, points?: NamedBytes): Promise<void> {
    try {
      if (name.toLowerCase().endsWith('.json')) await this.openConstraints(new TextDecoder().decode(bytes));
      else await this.openShape(name, bytes, held === undefined ? holding.initial : holding.fromFile(held), points);
      this.set({ fault: null });
    } catch (error) {
      this.setFault((error as Error).message, 'file');
    }
  }

  private async openShape(name: string, bytes: Uint8Array, constraints: Constraints, points?: NamedBytes): Promise<void> {
    this.solver.clear();
    const opened = await this.client.ask('open', { name, bytes, rules: holding.toFile(constraints) });
    const fit = points && { cloud: await this.cloudOf(points), kind: 'weight' as const, value: 0.01, outliers: 0 };
    this.take({ name, bytes }, opened, begun({ ...constraints, fit }));
  }

  /** As it was when the page was left. */
  async restore(source: Source, history: History<Constraints>, strength: number): Promise<void> {
    const file = 'bytes' in source;
    const opened = file ? await this.client.ask('open', { ...source, rules: holding.toFile(history.now.state) }) : await this.client.ask('draw', source);
    const clouds = new Set([...history.past, history.now, ...history.future].flatMap(({ state }) => state.fit?.cloud ?? []));
    for (const cloud of clouds) {
      const { number, name, bytes } = cloud;
      await this.client.ask('points', { number, name, bytes });
      this.clouds = Math.max(this.clouds, cloud.number);
    }
    this.take(source, opened, history);
    this.show({ strength }, true);
  }

  private take(source: Source, opened: Opened, history: History<Constraints>): void {
    const drawn = 'places' in source;
    const name = drawn ? 'curve.csv' : source.name;
    this.source = source;
    this.drags.drop();
    this.normals = new Map();
    this.history = history;
    this.shape = shapeOf(opened);
    this.positions = this.seen = opened.positions;
    Object.assign(this, { name, drawn, report: null, fault: null, showsInput: false, strength: 1, picked: new Set(), hovered: -1, fileWarnings: opened.warnings });
    this.events.opened(this.shape, drawn);
    this.settle();
  }

  /** Nothing is open. */
  close(): void {
    this.source = null;
    this.solver.clear();
    this.drags.drop();
    this.normals = new Map();
    this.history = begun(holding.initial);
    this.shape = null;
    this.positions = this.seen = new Float64Array();
    this.held = { nodes: new Uint8Array(), unmarked: 0 };
    Object.assign(this, { name: '', drawn: false, report: null, fault: null, showsInput: false, strength: 1, picked: new Set(), hovered: -1, fileWarnings: [] });
    this.events.opened(nothing, false);
    this.events.changed();
  }

  /** A curve through places, held there, with so many nodes a span. edit: what else holds at the place of that number. fit: what it is drawn towards. */
  async draw(places: readonly Vector[], closed: boolean, perSpan: number, edit: (place: number) => Edit = () => ({}), fit?: Fit): Promise<void> {
    this.solver.clear();
    try {
      const nodes = perSpan * (places.length - (closed ? 0 : 1)) + (closed ? 0 : 1);
      const source = { places: Float64Array.from(places.flat()), closed, nodes };
      const opened = await this.client.ask('draw', source);
      const kept = [...opened.from.keys()].filter((node) => opened.from[node] >= 0);
      const held = holding.edited(holding.initial, kept, (node) => ({ ...edit(opened.from[node]), position: places[opened.from[node]] }));
      this.take(source, opened, begun({ ...held, fit: fit && { ...fit, cloud: await this.cloudOf(fit.cloud) } }));
    } catch (error) {
      this.setFault((error as Error).message, 'file');
    }
  }

  /** The drawn curve through the nodes that are held, as they are now. */
  redraw(closed: boolean, perSpan: number): void {
    const held = [...this.shape!.curve!.runs.nodes].filter((node) => this.isDraggable(node));
    void this.draw(held.map((node) => this.placeOf(node)), closed, perSpan, (k) => this.constraints.edits[held[k]], this.constraints.fit);
  }

  private async openConstraints(text: string): Promise<void> {
    if (!this.shape) throw new Error('Open a shape first: constraints name its nodes');
    const constraints = holding.fromFile(text);
    await this.client.ask('hold', { rules: holding.toFile(constraints) });
    this.apply('Load constraints', { ...constraints, fit: this.constraints.fit });
  }

  async cloudOf({ name, bytes }: PointSource): Promise<Cloud> {
    const number = ++this.clouds;
    const { positions } = await this.client.ask('points', { number, name, bytes });
    return { number, name, bytes, positions };
  }

  toggleInput(): void {
    this.show({ showsInput: !this.showsInput }, true);
  }

  /** settled: the slider has been let go. */
  setStrength(strength: number, settled: boolean): void {
    this.show({ strength, showsInput: false }, settled);
  }

  /** As what is dragged has moved on. */
  showDrag(): void {
    this.show({}, false);
  }

  private show(state: Partial<Pick<Editor, 'showsInput' | 'strength'>>, settled: boolean): void {
    Object.assign(this, state);
    this.seen = this.drags.shape ?? between(this.shape!.input, this.positions, this.showsInput ? 0 : this.strength);
    this.events.shape(this.seen, settled);
    this.events.changed();
  }

  pick(node: number, add: boolean): void {
    const picked = new Set(add ? this.picked : []);
    if (node >= 0 && !(add && picked.delete(node))) picked.add(node);
    this.set({ picked });
  }

  setBoundary(part: Part, fixed: boolean): void {
    this.apply(`${fixed ? 'Fix' : 'Free'} boundary ${part}s`, holding.withBoundary(this.constraints, part, fixed));
  }

  setFairBoundary(first: boolean): void {
    this.apply(first ? 'Fair boundary loops' : 'Fix boundary positions', holding.withFairBoundary(this.constraints, first));
  }

  isBoundaryFixed(part: Part): boolean {
    return holding.boundaryFixed(this.constraints, part);
  }

  /** Positions are fixed where they are now seen; normals and tangents as in the input. */
  hold(part: Part, fixed: boolean): void {
    const change = (node: number): Edit => ({ [part]: !fixed ? 'free' : part === 'position' ? this.placeOf(node) : 'fixed' });
    this.apply(`${fixed ? 'Fix' : 'Free'} ${part} of ${this.picked.size} ${this.picked.size === 1 ? 'node' : 'nodes'}`,
      holding.edited(this.constraints, this.picked, change));
  }

  /** All other nodes are fixed, and what moves joins them smoothly. */
  async fairOnlyPicked(): Promise<void> {
    const { constraints } = this;
    try {
      const region = await this.client.ask('region', { rules: holding.toFile(constraints), nodes: Int32Array.from(this.picked) });
      if (constraints === this.constraints) this.apply(`Fair only ${this.picked.size} ${this.picked.size === 1 ? 'node' : 'nodes'}`, restricted(constraints, region));
    } catch (error) {
      this.setFault((error as Error).message, 'solver');
    }
  }

  isDraggable(node: number): boolean {
    return (this.held.nodes[node] & holding.heldPosition) !== 0;
  }

  /** The bytes of a file of that name, with what now holds. */
  async written(name: string): Promise<Uint8Array> {
    const ask = { name, strength: this.strength, ...this.holds };
    const bytes = await this.client.ask('write', ask, (fraction) => this.set({ saving: true, fraction })).catch((error: unknown) => {
      if (error instanceof Ended) return null;
      throw error;
    }).finally(() => this.set({ saving: false }));
    if (!bytes) throw new Error(`${name} is not saved, as its solution was cancelled`);
    return bytes;
  }

  private get holds(): { rules: string; fairBoundary: boolean; fit: FitJob | null } {
    const { fairBoundary, fit } = this.constraints;
    const job = fit ? { kind: fit.kind, value: fit.value, outliers: fit.outliers, points: fit.cloud.number } : null;
    return { rules: holding.toFile(this.constraints), fairBoundary: fairBoundary ?? false, fit: job };
  }

  undo(): void {
    this.travel(undone(this.history));
  }

  redo(): void {
    this.travel(redone(this.history));
  }

  dragBegun(now: number): void {
    this.show({ showsInput: false, strength: 1 }, false);
    this.frames.start(now);
  }

  /** What their arrows show until the library says what is held. */
  turnNormals(nodes: readonly number[], vectors: Float64Array): void {
    this.normals = new Map(this.normals);
    nodes.forEach((node, k) => this.normals.set(node, [...vectors.subarray(3 * k, 3 * k + 3)] as Vector));
    this.events.changed();
  }

  /** The one that is held, or else that of the shape now. */
  normalOf(node: number): Vector {
    const { normals, shape, positions } = this;
    return normals.get(node) ?? normalNear(shape!, positions, node);
  }

  placeOf(node: number): Vector {
    return [...this.seen.subarray(3 * node, 3 * node + 3)] as Vector;
  }

  apply(label: string, constraints: Constraints): void {
    this.travel(done(this.history, label, constraints));
  }

  private travel(history: History<Constraints>): void {
    this.history = history;
    this.settle();
  }

  settle(): void {
    if (!this.shape) return;
    this.held = holding.heldNodes(this.constraints, this.shape.boundary);
    this.solver.push(this.holds);
    this.events.changed();
  }

  private solved(solved: Solved, { drag }: Job): void {
    const { positions, report, normals } = solved;
    if (positions.length !== this.positions.length) return;
    if (drag && report.outcome === 'cancelled') return;
    if (drag && report.outcome === 'foreseen') {
      this.drags.solved(drag, solved);
      return;
    }
    this.positions = positions;
    this.report = report;
    if (this.fault?.source === 'solver') this.fault = null;
    if (drag) this.frames.solved(drag.time);
    if (drag) this.drags.solved(drag, solved);
    if (normals && this.drags.part !== this.direction) this.normals = new Map([...normals.nodes].map((node, k) => [node, [...normals.normals.subarray(3 * k, 3 * k + 3)] as Vector]));
    if (this.showsInput) this.events.changed();
    else this.show({}, !drag);
  }
}
