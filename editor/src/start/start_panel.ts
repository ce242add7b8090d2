// The panel of ways to fair the shape: it shows the result of each way, and makes it a step. The next way starts from
// that result.

import { short } from '../../../page/numbers.js';
import type { Command } from '../base/commands';
import { Entry } from '../base/entry';
import { withUnit } from '../base/units';
import { counted } from '../base/words';
import type { Shape } from '../shape/shape';
import { sharpNodes } from '../shape/sharp';
import type { Stay } from '../shape/stays';
import { isUntouched, type Constraints } from '../constraints/constraints';
import type { Cloud } from '../constraints/points';
import type { Editor } from '../edit/editor';
import { begun, done, redone, undone, type History } from '../edit/history';
import type { Tools } from '../pick/tools';
import { freed, isFree, isHeld, isNoisy, smoothed, suggestedTolerance, type Way } from './ways';

function rounded(length: number): string {
  return withUnit(short(Number(length.toPrecision(2))));
}

export interface StartEvents {
  /** Another way has been chosen, or none. */
  chosen: () => void;
}

const none: ReadonlySet<number> = new Set();
/** Degrees by which nothing turns. */
const flat = 180;

/** What a way is tried with: anything newer makes it out of date. */
type Attempt = Pick<Editor, 'history' | 'picked'>;

export class StartPanel {
  way: Way | null = null;
  private shape: Shape | null = null;
  /** Of the shape as it starts there; undefined: of the input. */
  private known: { start: Float64Array | undefined; noise: number; own: Cloud } | null = null;
  private latest: Attempt | null = null;
  /** Nodes at sharp edges that stay. */
  private held: readonly number[] = [];
  private asking = false;
  /** What was painted, stroke by stroke. */
  private strokes: History<ReadonlySet<number>> = begun(none);
  private readonly says = this.part('start-says');
  private readonly tolerance = new Entry(this.part('tolerance'), () => ({ words: 'a length above 0, such as 0.02 or 5 mm', takes: (value) => value > 0 && value < Infinity, isLength: true }), () => void this.attempt());

  private readonly stay = this.part<HTMLSelectElement>('stay');
  private readonly sharp = this.part<HTMLInputElement>('sharp');

  constructor(private readonly panel: HTMLElement, private readonly editor: Editor, private readonly tools: () => Tools, private readonly events: StartEvents) {
    this.stay.addEventListener('change', () => void this.attempt());
    this.sharp.addEventListener('input', () => this.showAngle());
    this.sharp.addEventListener('change', () => void this.attempt());
    this.showAngle();
  }

  private showAngle(): void {
    this.sharp.parentElement!.querySelector('output')!.textContent = this.angle < flat ? `${this.angle}°` : 'none';
  }

  private get angle(): number {
    return this.sharp.valueAsNumber;
  }

  get commands(): Command[] {
    const { editor } = this;
    const opened = (): boolean => editor.shape !== null;
    const choice = (way: Way, title: string, keys: string[], enabled = (): boolean => true): Command => ({
      id: `start-${way}`, title, keys, enabled: () => opened() && enabled(), run: () => this.choose(way), pressed: () => this.way === way,
    });
    return [
      choice('smooth', 'Smooth it: take its noise off; the shape goes no further from any of its nodes than a tolerance', ['s']),
      choice('repair', 'Repair a part that you paint; all else stays as it is', ['j']),
      { id: 'start-pull', title: 'Pull a node; what is near goes along', keys: ['u'], enabled: opened, run: () => this.pull(), pressed: () => !this.way && this.tools().tool === 'pick' },
      choice('free', 'The fairest shape through what is held', [], () => isHeld(editor.held) && (this.way === 'free' || !isFree(editor.constraints))),
      { id: 'start-apply', title: 'Keep what is shown', keys: [], run: () => this.apply(), enabled: () => this.ready },
      { id: 'start-dismiss', title: 'Take back what is shown', keys: [], run: () => void this.dismiss() },
    ];
  }

  refresh(): void {
    const { editor } = this;
    if (editor.shape !== this.shape) this.begin();
    if (this.way && this.outOfDate) void this.attempt();
    this.panel.hidden = editor.shape === null;
    this.part('start-title').textContent = isUntouched(editor.constraints) && !editor.constraints.start && !editor.constraints.filled ? 'It is as in the file. What now?' : 'What now?';
    this.part('start-smooth').hidden = this.way !== 'smooth';
    if (this.known) this.tolerance.show(this.tolerance.value);
    this.part('start-end').hidden = !this.way;
    this.part('start-free').textContent = this.freeSays;
    document.querySelector('[data-command=start-dismiss]')!.textContent = this.way === 'repair' && editor.picked.size === 0 ? 'Done' : 'Not this';
    const said = this.said();
    if (this.says.textContent !== said) this.says.textContent = said;
    this.says.hidden = said === '';
  }

  /** Returns whether there was something to take back. */
  dismiss(): boolean {
    if (!this.way) return false;
    this.choose(null);
    return true;
  }

  /** What undo takes back before any step, in words; null: there is nothing of that kind. */
  get undoes(): string | null {
    if (this.way === 'repair') return this.strokes.past.length > 0 ? 'stroke' : null;
    return this.way && 'what is tried';
  }

  get redoes(): string | null {
    return this.way === 'repair' && this.strokes.future.length > 0 ? 'stroke' : null;
  }

  undo(): void {
    if (this.way === 'repair') this.paintAs(undone(this.strokes));
    else this.dismiss();
  }

  redo(): void {
    this.paintAs(redone(this.strokes));
  }

  private paintAs(strokes: History<ReadonlySet<number>>): void {
    this.strokes = strokes;
    this.editor.set({ picked: strokes.now.state });
  }

  /** As something else begins with what is seen: what is done is kept. */
  leave(): void {
    if (this.ready) this.apply();
    this.dismiss();
  }

  private part<Part extends HTMLElement>(id: string): Part {
    return document.getElementById(id) as Part;
  }

  private get ready(): boolean {
    return this.editor.trying && !this.asking && !this.editor.busy && !this.editor.stopped;
  }

  private get freeSays(): string {
    const { constraints, held, shape } = this.editor;
    if (!isHeld(held)) return 'needs a boundary or fixed nodes';
    return isFree(constraints) ? 'as it is now' : shape?.curve ? 'between its ends' : 'between its boundaries';
  }

  private begin(): void {
    Object.assign(this, { shape: this.editor.shape, known: null });
    if (this.way) this.choose(null);
  }

  private choose(way: Way | null): void {
    const { editor } = this;
    const before = this.way;
    if (way === before) return;
    editor.try(null);
    this.turnTo(way);
    if (before === 'repair') {
      this.tools().set('pick');
      editor.pick(-1, false);
    }
    if (way === 'repair') this.tools().set('brush');
    this.events.chosen();
  }

  private turnTo(way: Way | null): void {
    Object.assign(this, { way, latest: null, asking: false, strokes: begun(this.editor.picked) });
  }

  private pull(): void {
    this.dismiss();
    this.tools().set('pick');
    this.events.chosen();
  }

  private get outOfDate(): boolean {
    const { history, picked } = this.editor;
    if (history !== this.latest?.history) return true;
    return this.way === 'repair' && picked !== this.latest.picked && !this.tools().busy;
  }

  private async attempt(): Promise<void> {
    const { editor, way } = this;
    const { history, picked } = editor;
    const attempt = (this.latest = { history, picked });
    if (way === 'repair' && picked !== this.strokes.now.state) this.strokes = done(this.strokes, '', picked);
    this.asking = true;
    try {
      const found = way === 'free' ? freed(editor.constraints) : await this.tried();
      if (attempt === this.latest) editor.try(found);
      // Its request may be of a shape with another start.
      else if (!this.way) editor.settle();
    } catch (error) {
      editor.setFault((error as Error).message, 'solver');
    }
    if (attempt === this.latest) this.asking = false;
    editor.set({});
  }

  /** What holds for it; null: there is nothing to try. */
  private async tried(): Promise<Constraints | null> {
    const { editor } = this;
    if (this.way === 'smooth') return this.smoothing(await editor.begun());
    return editor.picked.size > 0 ? editor.restrictedTo(editor.picked, await editor.begun()) : null;
  }

  private async smoothing(begun: Constraints): Promise<Constraints | null> {
    const { editor, shape } = this;
    const { start } = begun;
    if (this.known?.start !== start || !this.known) {
      editor.startFrom(start);
      const noise = await editor.client.ask('noise', null);
      this.known = { start, noise, own: await editor.cloudOf(start ?? shape!.input) };
      this.tolerance.show(suggestedTolerance(noise, 1 / shape!.scale));
    }
    if (this.tolerance.wrong) return null;
    const sharp = this.angle < flat ? sharpNodes(shape!, start ?? shape!.input, this.angle) : [];
    return smoothed(begun, this.known.own, this.tolerance.value, this.stay.value as Stay, (this.held = sharp), shape!.curve !== null);
  }

  private apply(): void {
    const { editor, way } = this;
    const titles: Record<Way, string> = { smooth: `Smooth within ${short(this.tolerance.value)}`, repair: `Repair ${counted(editor.picked.size, 'node')}`, free: 'Free form' };
    const title = titles[way!];
    if (way === 'repair') this.paintAs(begun(none));
    else this.turnTo(null);
    editor.accept(title, way !== 'free');
    this.events.chosen();
  }

  private said(): string {
    const { editor, way } = this;
    if (!way) return '';
    if (way === 'repair' && editor.picked.size === 0) return 'Paint over what is to be repaired; what is hidden goes with what is painted around it. Erase, or Alt, takes away.';
    if (this.asking || editor.busy) return 'Trying it …';
    if (!editor.trying) return '';
    const { report, shape, movedInTrial: { all, along }, steep } = editor;
    const size = 1 / shape!.scale;
    const noise = way === 'smooth' ? this.known!.noise : null;
    const why = noise === null ? '' : isNoisy(noise, size) ? ` Its noise seems to be ${rounded(noise)}.` : ' It has no noise to speak of.';
    if (editor.stopped) return 'Stopped before it was done. Go on, or take something else.';
    if (report?.movingNodes === 0) return `Nothing moves: all of it is held.${why}`;
    if (all === 0) return 'Nothing that is better was found: see the warnings.';
    const many = counted(report?.movingNodes ?? 0, 'node');
    if (way !== 'smooth' || !report?.fit) return `Moves ${many}, at most by ${rounded(all)}.`;
    const stay = this.stay.value;
    const ways = stay === 'normal' ? `none by more than ${rounded(all)}, and none along the shape`
      : `the shape by at most ${rounded(report.fit.greatest)}, ${stay ? `and each keeps its ${stay}${steep > 0 ? ` but ${steep}, where it is too steep` : ''}` : `nodes along it by up to ${rounded(along)}`}`;
    const kept = this.held.length > 0 ? ` Keeps ${counted(this.held.length, 'node')} at ${shape!.curve ? 'corners' : 'sharp edges'}.` : '';
    return `Moves ${many}: ${ways}.${kept}${why}`;
  }
}
