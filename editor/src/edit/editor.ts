// The state of the editor, and everything that changes it.

import type { NamedBytes } from '../base/files';
import type { Loading } from '../base/loading';
import type { Vector } from '../base/vectors';
import { counted } from '../base/words';
import { CoreClient, Ended, Solver } from '../library/client';
import type { Answer, Ask, CurveNodes, Job, Opened, Part, Report, Solved } from '../library/protocol';
import { between, furthest } from '../shape/between';
import { heldOn, loopsOf } from '../shape/loops';
import type { Mirror } from '../shape/mirror';
import { normalNear, nothing, shapeOf, type Shape } from '../shape/shape';
import { stayed } from '../shape/stays';
import type { Constraints, Edit, Held } from '../constraints/constraints';
import * as holding from '../constraints/constraints';
import { nodesOf, type Renumbered } from '../constraints/nodes';
import { withMore } from '../constraints/patches';
import type { Cloud, PointSource } from '../constraints/points';
import { keepingAdded, keepsSome, restricted } from '../constraints/region';
import { Drags } from '../pull/drags';
import { near, within } from '../pull/reach';
import { strayed } from '../shape/stays';
import { FrameCounter } from './frames';
import { begun, done, type History } from './history';
import { Symmetry } from './symmetry';
import { Trial, type Moved } from './trial';

export interface EditorEvents {
  /** inPlace: made of what was open. */
  opened: (shape: Shape, inPlace: boolean) => void;
  /** What is open has other nodes. */
  renumbered: (shape: Shape) => void;
  /** What is tried is to be kept, or given up, as something else begins. */
  leaving: () => void;
  /** Another shape is to be seen; settled: it is not one of many during a drag. */
  shape: (positions: Float64Array, settled: boolean) => void;
  /** Anything else that is shown has changed. */
  changed: () => void;
}

const cancelled: Report = { outcome: 'cancelled', usable: false, iterations: 0, seconds: 0, threads: 1, expectedError: null, movingNodes: 0, warnings: [] };
/** What a shape was opened from: a file, or places that were clicked. */
export type Source = NamedBytes | Ask<'draw'>;

export function nameOf(source: Source): string {
  return 'places' in source ? 'curve.csv' : source.name;
}

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
  /** Edges that stay sharp, two nodes each, as the library takes them. */
  sharp: Int32Array = new Int32Array();
  picked: ReadonlySet<number> = new Set();
  hovered = -1;
  /** Whether the pointer is at the arrow of that node. */
  atArrow = false;
  busy = false;
  /** When it became that, or rested. */
  since = 0;
  /** A file waits for its shape. */
  saving = false;
  /** What is being made, such as patches of holes; empty: nothing. */
  making = '';
  /** The name under which what is seen was saved. */
  saved: string | null = null;
  fraction = 0;
  showsInput = false;
  /** What is being opened. */
  loading: Loading | null = null;
  /** Whether the curve was drawn here. */
  drawn = false;
  /** How far on the way from the input to the result that is which is seen and saved: 0 to 1. */
  strength = 1;
  history: History<Constraints> = begun(holding.initial);
  private readonly trial = new Trial();
  private cancels = 0;
  /** Null: as is usual for what is open. */
  reach: number | null = null;
  readonly symmetry = new Symmetry(() => this.shape);
  readonly frames = new FrameCounter();
  private positions: Float64Array = new Float64Array();
  seen: Float64Array = this.positions;
  /** Whether that was shown for more than a moment. */
  private rests = true;
  /** Where the worker starts from; undefined: the input. */
  private started: Float64Array | undefined = undefined;
  /** Numbers of points that are known to the worker. */
  clouds = 0;
  /** Nodes that do not keep the coordinate that they are to keep, as the shape is too steep there. */
  steep = 0;
  source: Source | null = null;
  readonly client = new CoreClient((message) => this.setFault(message, 'file'));
  private readonly solver = new Solver(this.client, {
    solved: (solved, job) => this.solved(solved, job),
    failed: (message) => this.setFault(message, 'solver'),
    ended: () => { this.report = cancelled; },
    progress: (fraction) => this.set({ fraction }),
    busy: (busy) => {
      this.since = performance.now();
      this.set({ busy, fraction: 0 });
    },
  });

  readonly drags = new Drags(this, this.solver);

  constructor(private readonly events: EditorEvents) {}

  /** What holds by all steps. */
  get constraints(): Constraints {
    return this.history.now.state;
  }

  /** The same, or what is tried in its place. */
  get shown(): Constraints {
    return this.trial.constraints ?? this.constraints;
  }

  /** The positions from which all is solved. */
  get start(): Float64Array {
    return this.constraints.start ?? this.shape!.input;
  }

  /** How far what is tried moves a node, and how far along the shape. */
  get movedInTrial(): Moved {
    return this.trial.moved(this.shape!, this.positions);
  }

  /** How far what is seen is from the input: nodes of a surface from where they were, those of a curve from what it was. */
  get moved(): number {
    const { shape, seen } = this;
    if (!shape) return 0;
    return shape.curve ? strayed(shape.curve, shape.input, seen) : furthest(seen, shape.input);
  }

  get trying(): boolean {
    return this.trial.constraints !== null;
  }

  get result(): Float64Array {
    return this.positions;
  }

  get dragging(): boolean {
    return this.drags.part !== null;
  }

  /** Whether the shape is not what holds makes of it, as that was cancelled. */
  get stopped(): boolean {
    return this.report?.outcome === 'cancelled' && !this.busy && !this.dragging;
  }

  get canEnd(): boolean {
    return this.saving || this.making !== '' || (this.busy && !this.dragging);
  }

  set(state: Partial<Pick<Editor, 'atArrow' | 'busy' | 'fraction' | 'saving' | 'making' | 'saved' | 'hovered' | 'picked' | 'fault' | 'loading' | 'reach'>>): void {
    Object.assign(this, state);
    this.events.changed();
  }

  setFault(message: string, source: FaultSource): void {
    this.set({ fault: { message, source }, loading: null });
  }

  /** What the normal of a surface is to a curve: its tangent. */
  get direction(): Part {
    return this.shape?.curve ? 'tangent' : 'normal';
  }

  /** Ends what is solved, as another shape is to come. */
  halt(): void {
    this.solver.clear();
  }

  /** inPlace: it is made of what was open. */
  take(source: Source, opened: Opened, history: History<Constraints>, inPlace = false): void {
    const drawn = 'places' in source;
    const name = nameOf(source);
    this.source = source;
    this.drags.drop();
    this.normals = new Map();
    this.sharp = new Int32Array();
    this.history = history;
    this.trial.end();
    this.started = undefined;
    this.loading = null;
    this.shape = shapeOf(opened);
    this.positions = this.seen = opened.positions;
    Object.assign(this, { name, drawn, report: null, fault: null, showsInput: false, strength: 1, picked: new Set(), hovered: -1, fileWarnings: opened.warnings });
    this.rests = true;
    this.events.opened(this.shape, inPlace);
    this.settle();
  }

  /** Nothing is open. */
  close(): void {
    this.source = null;
    this.trial.end();
    this.solver.clear();
    this.drags.drop();
    this.normals = new Map();
    this.sharp = new Int32Array();
    this.history = begun(holding.initial);
    this.shape = null;
    this.positions = this.seen = new Float64Array();
    this.held = { nodes: new Uint8Array(), unmarked: 0 };
    Object.assign(this, { name: '', drawn: false, report: null, fault: null, showsInput: false, strength: 1, picked: new Set(), hovered: -1, fileWarnings: [] });
    this.events.opened(nothing, false);
    this.events.changed();
  }

  async cloudOf(from: PointSource): Promise<Cloud> {
    const number = ++this.clouds;
    const { positions } = await this.client.ask('points', { number, from });
    return { number, positions, ...('bytes' in from ? { name: from.name, bytes: from.bytes } : { name: '', bytes: null }) };
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

  show(state: Partial<Pick<Editor, 'showsInput' | 'strength'>>, settled: boolean): void {
    Object.assign(this, state);
    this.saved = null;
    this.seen = this.drags.shape ?? between(this.shape!.input, this.positions, this.showsInput ? 0 : this.strength);
    this.rests = settled;
    this.events.shape(this.seen, settled);
    this.events.changed();
  }

  get mirror(): Mirror | null {
    return this.symmetry.mirror;
  }

  setSymmetry(axis: number | null): void {
    this.symmetry.axis = axis;
    this.set({ picked: new Set(this.symmetry.with(this.picked)) });
  }

  pick(node: number, add: boolean): void {
    const picked = new Set(add ? this.picked : []);
    const takes = add && picked.has(node);
    for (const other of node < 0 ? [] : this.symmetry.with([node])) {
      if (takes) picked.delete(other);
      else picked.add(other);
    }
    this.set({ picked });
  }

  setBoundary(part: Part, fixed: boolean): void {
    this.apply(`${fixed ? 'Fix' : 'Free'} boundary ${part}s`, holding.withBoundary(this.constraints, part, fixed));
  }

  /** many: nodes to hold each loop by where nothing holds it and it has no corners. */
  setFairBoundary(first: boolean, many: number): void {
    const { constraints, shape } = this;
    const bare = holding.withFairBoundary(constraints, first, []);
    const held = holding.heldNodes({ ...bare, region: null }, shape!.boundary).nodes;
    const loose = first ? loopsOf(shape!).filter((loop) => !loop.some((node) => held[node] & holding.heldPosition)) : [];
    const nodes = loose.flatMap((loop) => heldOn(loop, shape!.input, many));
    this.apply(first ? `Fair boundary loops${nodes.length > 0 ? `, ${counted(nodes.length, 'node')} held` : ''}` : 'Fix boundary positions', holding.withFairBoundary(constraints, first, nodes));
  }

  /** Edges that turn by more than the angle where all starts stay sharp; null: none but those of a constraints file. */
  async setSharp(angle: number | null): Promise<void> {
    if (angle === null) {
      this.apply('Keep no edge sharp', { ...this.constraints, sharp: undefined });
      return;
    }
    const { history, shape } = this;
    this.startFrom(this.constraints.start);
    try {
      const { fit } = this.constraints;
      const found = await this.client.ask('sharp', { angle, noisy: fit !== undefined && !fit.cloud.bytes });
      if (history !== this.history || shape !== this.shape) return;
      this.apply(`Keep ${counted(found.edges.length / 2, 'edge')} sharp`, { ...this.constraints, sharp: { angle, rules: holding.sharpRules(found) } });
    } catch (error) {
      this.setFault((error as Error).message, 'solver');
    }
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

  /** What is seen, or was before something was tried, is what all is to start from, and holds until more is said. */
  async begun(): Promise<Constraints> {
    const seen = await this.settledShape();
    const { constraints, shape } = this;
    const isSeen = (start: Float64Array | undefined): boolean => furthest(start ?? shape!.input, seen) === 0;
    return holding.baked(constraints, isSeen(undefined) ? undefined : isSeen(constraints.start) ? constraints.start : seen);
  }

  private async settledShape(): Promise<Float64Array> {
    if (!this.trying) await this.solver.rest();
    const { positions, strength } = this.trying ? this.trial.before : { positions: this.positions, strength: this.strength };
    return between(this.shape!.input, positions, strength);
  }

  /** All nodes but these stay where they are seen, and what moves joins them smoothly. Null where something else has been done meanwhile. */
  async restrictedTo(nodes: ReadonlySet<number>, from?: Constraints): Promise<Constraints | null> {
    const seen = await this.settledShape();
    const { history, shape } = this;
    const constraints = from ?? history.now.state;
    this.startFrom(constraints.start);
    const rules = holding.toFile({ ...constraints, region: null });
    const region = await this.client.ask('region', { rules, nodes: Int32Array.from(nodes), positions: seen });
    return history === this.history && shape === this.shape ? restricted(constraints, nodes, region, constraints.start ?? shape!.input, seen) : null;
  }

  async fairOnlyPicked(): Promise<void> {
    try {
      const { picked } = this;
      this.try(null);
      const next = await this.restrictedTo(picked);
      if (!next) return;
      this.strength = 1;
      this.apply(`Fair only ${counted(picked.size, 'node')}`, next);
    } catch (error) {
      this.setFault((error as Error).message, 'solver');
    }
  }

  /** Shows what would come of these; null: what there was. */
  try(constraints: Constraints | null): void {
    if (constraints === this.trial.constraints) return;
    const { positions, strength, report } = this;
    if (!constraints) this.giveUp();
    else this.trial.begin(constraints, { positions, strength, report });
    this.show({ strength: constraints ? 1 : this.strength, showsInput: false }, true);
    this.settle();
  }

  private giveUp(): void {
    Object.assign(this, this.trial.end());
  }

  /** What is tried becomes a step, with the shape that it has. bakes: that is the one from which all starts from then on. */
  accept(label: string, bakes: boolean): void {
    const { constraints } = this.trial;
    if (!constraints) return;
    this.history = done(this.history, label, bakes ? holding.baked(constraints, this.positions) : constraints);
    this.trial.end();
    if (bakes) this.settle();
    else this.events.changed();
  }

  leaveTrial(): void {
    if (this.trying) this.events.leaving();
  }

  /** How much of the size around what is pulled goes with it; 1: all. */
  get reaches(): number {
    return this.reach ?? (this.constraints.region ? near : 1);
  }

  /** What holds for only what is near to go with these nodes; null where what holds already says what does. */
  nearby(nodes: readonly number[]): Promise<Constraints | null> | null {
    const { constraints, reaches, shape } = this;
    const whole = reaches >= 1;
    const kept = constraints.region && (holding.isUntouched(constraints) || keepsSome(constraints.region, nodes));
    if (!kept && (constraints.region || whole)) return null;
    return whole ? Promise.resolve({ ...constraints, region: null }) : this.restrictedTo(within(shape!, this.seen, nodes, reaches));
  }

  isDraggable(node: number): boolean {
    return (this.held.nodes[node] & holding.heldPosition) !== 0;
  }

  /** The bytes of a file of that name, with the shape that is seen, or that is on its way. */
  async written(name: string): Promise<Uint8Array> {
    const { cancels } = this;
    this.set({ saving: true });
    await this.solver.rest();
    this.set({ saving: false });
    if (cancels !== this.cancels) throw new Error(`${name} is not saved, as its solution was cancelled`);
    return this.client.ask('write', { name, positions: between(this.shape!.input, this.positions, this.strength) });
  }

  /** The solution that runs ends, and the last shape stays. */
  cancel(): void {
    ++this.cancels;
    this.solver.cancel();
  }

  private get holds(): Job {
    return this.jobOf(this.shown);
  }

  /** What is solved from now on starts there; undefined: at the input. */
  startFrom(start: Float64Array | undefined): void {
    if (start === this.started) return;
    this.started = start;
    this.client.ask('start', start ?? null).catch((error: Error) => this.setFault(error.message, 'solver'));
  }

  jobOf(constraints: Constraints): Job {
    const { fairBoundary, fit } = constraints;
    const job = fit ? { kind: fit.kind, value: fit.value, outliers: fit.outliers, points: fit.cloud.number } : null;
    return { rules: holding.toFile(constraints), fairBoundary: fairBoundary ?? false, fit: job };
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

  travel(history: History<Constraints>): void {
    const [before, now] = [this.history.now.state, history.now.state];
    const other = before.curve !== now.curve || before.filled !== now.filled;
    this.giveUp();
    this.history = history;
    if (other) void this.takeNodes();
    else this.settle();
  }

  /** Nodes of the curve as it is open. */
  get nodes(): CurveNodes {
    return nodesOf(this.shape!, this.history.now.state.curve);
  }

  /** The curve has other nodes, as a step; what holds by their numbers follows. picked: some of the new ones. */
  renumber(label: string, changed: Renumbered, picked: readonly number[]): void {
    this.try(null);
    const { history, positions, seen } = this;
    const { start } = history.now.state;
    const held = { ...holding.renumbered(history.now.state, changed.now), curve: changed.curve, start: start && changed.carried(start) };
    this.history = done(history, label, keepingAdded(held, changed, changed.carried(seen)));
    void this.takeNodes(changed.carried(positions), picked);
  }

  /** Fills the holes through those nodes of the boundary, outer rims too, or, of none, all holes but outer rims, as a step. The patches are picked. */
  async fillHoles(nodes: readonly number[]): Promise<void> {
    this.leaveTrial();
    const seen = await this.settledShape();
    const { history, shape } = this;
    const at = nodes.length > 0 ? Int32Array.from(nodes) : null;
    const found = await this.make('Filling holes', 'fill', { at, positions: seen });
    if (found && history === this.history && shape === this.shape) this.takePatches(found, seen);
  }

  /** The surface through the curves as they are seen; those of which every node is picked may be edges of it. Null where there is none, or something else has been done meanwhile. */
  async spanned(): Promise<Answer<'span'> | null> {
    this.leaveTrial();
    const { picked } = this;
    const seen = await this.settledShape();
    const { history, shape } = this;
    const { begin, nodes } = shape!.curve!.runs;
    const isPicked = (chain: number): boolean => nodes.subarray(begin[chain], begin[chain + 1]).every((node) => picked.has(node));
    const sharp = Int32Array.from(shape!.curve!.closed.keys()).filter(isPicked);
    const found = await this.make('Spanning the curves', 'span', { sharp, positions: seen });
    return history === this.history && shape === this.shape && found?.outcome !== 'cancelled' ? found : null;
  }

  /** Null where it was ended, or there is a fault. */
  private async make<K extends 'fill' | 'span'>(making: string, kind: K, ask: Ask<K>): Promise<Answer<K> | null> {
    this.set({ making, fraction: 0 });
    try {
      return await this.client.ask(kind, ask, (fraction) => this.set({ fraction }));
    } catch (error) {
      if (!(error instanceof Ended)) this.setFault((error as Error).message, 'file');
      return null;
    } finally {
      this.set({ making: '' });
    }
  }

  private takePatches({ report, patches, positions }: Answer<'fill'>, seen: Float64Array): void {
    if (report.outcome === 'cancelled') return;
    const filled = report.holes.filter(({ state }) => state === 'filled');
    if (filled.length === 0) {
      const rims = report.holes.filter(({ state }) => state === 'outer-rim').length;
      const left = rims > 0 ? `${rims === 1 ? 'Its rim stays' : `${counted(rims, 'rim')} stay`} open: pick a node of ${rims === 1 ? 'it' : 'one'} to fill that` : 'It has no hole';
      this.setFault(report.warnings.join('. ') || left, 'file');
      return;
    }
    const { constraints } = this;
    const start = constraints.start || furthest(seen, this.shape!.input) > 0 ? positions : undefined;
    const next = { ...holding.baked(constraints, start), filled: withMore(constraints.filled, { patches, warnings: report.warnings }) };
    this.strength = 1;
    this.history = done(this.history, `Fill ${counted(filled.length, 'hole')}`, next);
    const picked = filled.flatMap(({ firstNode, nodeCount }) => Array.from({ length: nodeCount }, (_, k) => firstNode + k));
    void this.takeNodes(positions, picked);
  }

  /** The nodes that now hold, in place of those that are open. positions: where they are until it is solved. */
  private async takeNodes(positions?: Float64Array, picked: readonly number[] = []): Promise<void> {
    const { source, history } = this;
    const { curve, filled, start } = history.now.state;
    this.solver.clear();
    this.drags.drop();
    this.set({ picked: new Set(), hovered: -1, atArrow: false });
    try {
      const asked: Promise<Opened> = this.shape!.curve ? this.client.ask('nodes', curve ?? null) : this.client.ask('patches', filled?.patches ?? null);
      this.started = undefined;
      const opened = await asked;
      // Other changes may have happened meanwhile.
      const { state } = this.history.now;
      if (source !== this.source || curve !== state.curve || filled !== state.filled) return;
      this.shape = shapeOf(opened);
      this.positions = positions ?? start ?? opened.positions;
      this.normals = new Map();
      this.sharp = new Int32Array();
      this.events.renumbered(this.shape);
      this.settle();
      this.set({ picked: new Set(picked) });
      this.show({ showsInput: false }, true);
    } catch (error) {
      this.setFault((error as Error).message, 'file');
    }
  }

  settle(): void {
    if (!this.shape) return;
    this.saved = null;
    this.held = holding.heldNodes(this.shown, this.shape.boundary);
    this.startFrom(this.shown.start);
    this.solver.push(this.holds);
    this.events.changed();
  }

  private solved(solved: Solved, { drag }: Job): void {
    const { report, normals, sharp } = solved;
    if (solved.positions.length !== this.positions.length) return;
    if (drag && report.outcome === 'cancelled') return;
    if (drag && report.outcome === 'foreseen') {
      this.drags.solved(drag, solved);
      return;
    }
    const positions = drag ? solved.positions : this.kept(solved.positions);
    // Drawing a large unchanged shape would take seconds.
    const same = this.rests && this.seen === this.positions && furthest(positions, this.positions) === 0;
    if (!same) this.positions = positions;
    this.report = report;
    if (this.fault?.source === 'solver') this.fault = null;
    if (drag) this.frames.solved(drag.time);
    if (drag) this.drags.solved(drag, solved);
    if (normals && this.drags.part !== this.direction) this.normals = new Map([...normals.nodes].map((node, k) => [node, [...normals.normals.subarray(3 * k, 3 * k + 3)] as Vector]));
    if (sharp) this.sharp = sharp;
    if (this.showsInput || same) this.events.changed();
    else this.show({}, !drag);
  }
  /** With nodes where they are to stay along the shape. */
  private kept(positions: Float64Array): Float64Array {
    const { shape, shown: { fit, start } } = this;
    if (!fit?.stay) return positions;
    const found = stayed(shape!, start ?? shape!.input, positions, fit.stay, fit.value);
    this.steep = found.steep;
    return found.positions;
  }
}
