// Opening: files, examples and drawn curves, and documents opened before.

import type { NamedBytes } from '../base/files';
import { painted } from '../base/loading';
import type { Vector } from '../base/vectors';
import { counted } from '../base/words';
import type { Constraints, Edit } from '../constraints/constraints';
import type { Opened } from '../library/protocol';
import * as holding from '../constraints/constraints';
import { sourceOf, type Fit } from '../constraints/points';
import { Documents, type Document } from './documents';
import { nameOf, type Editor } from './editor';
import { begun, redone, undone } from './history';

/** Bytes of a file from which on drawing it takes long enough to be said. */
const long = 3e6;

export class Opening {
  private readonly documents = new Documents();
  /** Whether what is open is nobody's own. */
  example = false;

  constructor(private readonly editor: Editor) {}

  /** Whether somebody would miss what is open. */
  get isOwn(): boolean {
    return this.editor.shape !== null && (!this.example || this.document !== null);
  }

  /** Nothing is open. */
  close(): void {
    this.leave();
    this.editor.close();
  }

  /** A shape, which stays as it is until more is said, or a constraints file. What cannot be read leaves everything as it was. */
  async open(name: string, bytes: Uint8Array): Promise<void> {
    try {
      if (name.toLowerCase().endsWith('.json')) await this.openConstraints(new TextDecoder().decode(bytes));
      else await this.openShape(name, bytes, holding.untouched, false);
      this.editor.set({ fault: null, loading: null });
    } catch (error) {
      this.editor.setFault((error as Error).message, 'file');
    }
  }

  /** A shape that is faired at once. held: a constraints file for it. points: what it is drawn towards, with the weight of the paper's Fig. 12. */
  async openFair(name: string, bytes: Uint8Array, held?: string, points?: NamedBytes): Promise<void> {
    try {
      await this.openShape(name, bytes, held === undefined ? holding.initial : holding.fromFile(held), true, points);
      this.editor.set({ fault: null });
    } catch (error) {
      this.editor.setFault((error as Error).message, 'file');
    }
  }

  /** The surface through the curves that are open, in their place and held on them; that can be undone. */
  async span(): Promise<void> {
    const { editor } = this;
    const found = await editor.spanned();
    if (!found) return;
    const { held, heldNormals, sharpEdges, surface, warnings } = found;
    const normals = Array.from(heldNormals.nodes, (_, k) => [...heldNormals.normals.subarray(3 * k, 3 * k + 3)]);
    const edges = Array.from({ length: sharpEdges.length / 2 }, (_, k) => ({ nodes: [...sharpEdges.subarray(2 * k, 2 * k + 2)], sharp: 'path' }));
    const rules = [{ nodes: [...held], position: 'fixed' }, ...(normals.length > 0 ? [{ nodes: [...heldNormals.nodes], normal: normals }] : []), ...edges];
    const { source, history, strength } = editor;
    const name = `${editor.name.replace(/\.[^.]*$/, '')}-surface.obj`;
    try {
      const opened = await editor.client.ask('open', { name, bytes: surface, rules: holding.toFile({ ...holding.untouched, rules }) });
      this.documents.opened({ source: source!, history, strength });
      this.example = false;
      editor.take({ name, bytes: surface }, { ...opened, warnings: [...opened.warnings, ...warnings] }, begun({ ...holding.untouched, rules }), true);
    } catch (error) {
      editor.setFault((error as Error).message, 'file');
    }
  }

  private async openShape(name: string, bytes: Uint8Array, constraints: Constraints, example: boolean, points?: NamedBytes): Promise<void> {
    this.editor.halt();
    const size = bytes.length;
    this.editor.set({ loading: { name, size, doing: 'reading its nodes and faces' } });
    const opened = await this.editor.client.ask('open', { name, bytes, rules: holding.toFile(constraints) });
    if (size > long) {
      this.editor.set({ loading: { name, size, doing: `${counted(opened.positions.length / 3, 'node')}, drawing` } });
      await painted();
    }
    const fit = points && { cloud: await this.editor.cloudOf(points), kind: 'weight' as const, value: 0.01, outliers: 0 };
    this.leave();
    this.example = example;
    this.editor.take({ name, bytes }, opened, begun({ ...constraints, fit }));
  }

  /** What was kept, in place of what is open. */
  async reopen(document: Document): Promise<void> {
    this.leave();
    await this.restore(document);
  }

  /** As it was when the page, or it for something else, was left. */
  private async restore({ source, history, strength }: Document): Promise<void> {
    this.editor.halt();
    const { client } = this.editor;
    const { state } = history.now;
    let opened: Opened = 'bytes' in source ? await client.ask('open', { ...source, rules: holding.toFile(state.curve || state.filled ? holding.initial : state) }) : await client.ask('draw', source);
    if (state.curve) opened = await client.ask('nodes', state.curve);
    if (state.filled) opened = await client.ask('patches', state.filled.patches);
    const clouds = new Set([...history.past, history.now, ...history.future].flatMap(({ state }) => state.fit?.cloud ?? []));
    for (const cloud of clouds) {
      const { number } = cloud;
      await client.ask('points', { number, from: sourceOf(cloud) });
      this.editor.clouds = Math.max(this.editor.clouds, number);
    }
    this.example = false;
    this.editor.take(source, opened, history);
    this.editor.show({ strength }, true);
  }

  /** What is open, if anything was done to it. */
  private get document(): Document | null {
    const { source, history, strength } = this.editor;
    return source && history.past.length + history.future.length > 0 ? { source, history, strength } : null;
  }

  private leave(): void {
    this.documents.opened(this.document);
  }

  /** A curve through places, held there, with so many nodes a span. edit: what else holds at the place of that number. fit: what it is drawn towards. */
  async draw(places: readonly Vector[], closed: boolean, perSpan: number, edit: (place: number) => Edit = () => ({}), fit?: Fit): Promise<void> {
    this.editor.halt();
    try {
      const nodes = perSpan * (places.length - (closed ? 0 : 1)) + (closed ? 0 : 1);
      const source = { places: Float64Array.from(places.flat()), closed, nodes };
      const opened = await this.editor.client.ask('draw', source);
      this.leave();
      this.example = false;
      const kept = [...opened.from.keys()].filter((node) => opened.from[node] >= 0);
      const held = holding.edited(holding.initial, kept, (node) => ({ ...edit(opened.from[node]), position: places[opened.from[node]] }));
      this.editor.take(source, opened, begun({ ...held, fit: fit && { ...fit, cloud: await this.editor.cloudOf(fit.cloud.bytes ? sourceOf(fit.cloud) : opened.positions) } }));
    } catch (error) {
      this.editor.setFault((error as Error).message, 'file');
    }
  }

  /** The drawn curve through the nodes that are held, as they are now. */
  redraw(closed: boolean, perSpan: number): void {
    const held = [...this.editor.shape!.curve!.runs.nodes].filter((node) => this.editor.isDraggable(node));
    void this.draw(held.map((node) => this.editor.placeOf(node)), closed, perSpan, (k) => this.editor.constraints.edits[held[k]], this.editor.constraints.fit);
  }

  private async openConstraints(text: string): Promise<void> {
    if (!this.editor.shape) throw new Error('Open a shape first: constraints name its nodes');
    const constraints = holding.fromFile(text);
    await this.editor.client.ask('hold', { rules: holding.toFile(constraints) });
    this.editor.apply('Load constraints', { ...constraints, region: null, fit: this.editor.constraints.fit, curve: this.editor.constraints.curve, filled: this.editor.constraints.filled });
  }

  /** What undo takes back, in words; null where there is nothing. */
  get undoes(): string | null {
    return this.editor.history.past.length > 0 ? this.editor.history.now.label : this.documents.before ? `Open ${this.editor.name || 'nothing'}` : null;
  }

  get redoes(): string | null {
    const { after } = this.documents;
    return this.editor.history.future[0]?.label ?? (after ? `Open ${nameOf(after.source)}` : null);
  }

  undo(): void {
    if (this.editor.history.past.length > 0) this.editor.travel(undone(this.editor.history));
    else void this.travel(this.documents.before, (now) => this.documents.back(now));
  }

  redo(): void {
    if (this.editor.history.future.length > 0) this.editor.travel(redone(this.editor.history));
    else void this.travel(this.documents.after, (now) => this.documents.forward(now));
  }

  private async travel(document: Document | undefined, move: (now: Document | null) => void): Promise<void> {
    if (!document) return;
    const { source, history, strength } = this.editor;
    move(source && { source, history, strength });
    try {
      await this.restore(document);
    } catch (error) {
      this.editor.setFault((error as Error).message, 'file');
    }
  }
}
