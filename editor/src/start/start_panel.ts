// The panel of a file that is as it came: it offers what may be done, shows on the shape what would come of it, and makes it a step.

import { short } from '../../../page/numbers.js';
import type { Command } from '../base/commands';
import { withUnit } from '../base/units';
import { counted } from '../base/words';
import type { Shape } from '../shape/shape';
import { isUntouched } from '../constraints/constraints';
import type { Cloud } from '../constraints/points';
import type { Editor } from '../edit/editor';
import type { Tools } from '../pick/tools';
import { freed, isHeld, isNoisy, smoothed, suggestedTolerance, type Way } from './ways';

function rounded(length: number): string {
  return withUnit(short(Number(length.toPrecision(2))));
}

export interface StartEvents {
  /** Another way has been chosen, or none. */
  chosen: (way: Way | null) => void;
}

export class StartPanel {
  way: Way | null = null;
  private shape: Shape | null = null;
  private own: Cloud | null = null;
  private noise: number | null = null;
  /** The nodes that a repair has been tried for. */
  private painted: ReadonlySet<number> = new Set();
  private asking = 0;
  private readonly says = this.part('start-says');
  private readonly tolerance = this.part<HTMLInputElement>('tolerance');

  constructor(private readonly panel: HTMLElement, private readonly editor: Editor, private readonly tools: () => Tools, private readonly events: StartEvents) {
    this.tolerance.addEventListener('change', () => void this.smooth());
  }

  get commands(): Command[] {
    const choice = (way: Way, title: string, enabled = (): boolean => true): Command => ({
      id: `start-${way}`, title, keys: [], enabled: () => this.editor.shape !== null && enabled(), run: () => this.choose(way), pressed: () => this.way === way,
    });
    return [
      choice('smooth', 'Take its noise off, and move no node by more than a tolerance'),
      choice('repair', 'Paint a part; all else stays as it is'),
      choice('free', 'The fairest shape through what is held', () => isHeld(this.editor.held)),
      { id: 'start-apply', title: 'Keep what is shown', keys: [], run: () => this.apply(), enabled: () => this.editor.trying && !this.editor.busy },
      { id: 'start-dismiss', title: 'Take back what is shown', keys: [], run: () => void this.dismiss() },
    ];
  }

  refresh(): void {
    const { editor } = this;
    if (editor.shape !== this.shape) this.begin();
    const untouched = editor.shape !== null && isUntouched(editor.history.now.state);
    if (this.way && this.way !== 'repair' && !editor.trying && this.asking === 0) this.choose(null);
    if (this.way === 'repair' && editor.picked !== this.painted && !this.tools().busy) void this.repair();
    this.panel.hidden = !untouched && !this.way;
    this.part('start-title').textContent = untouched ? 'It is as in the file. What now?' : 'Repair a part';
    this.part('start-offers').hidden = !untouched;
    this.part('start-tolerance').hidden = this.way !== 'smooth';
    this.part('start-end').hidden = !this.way;
    this.part('start-free').textContent = isHeld(editor.held) ? (editor.shape?.curve ? 'between its ends' : 'between its boundaries') : 'needs a boundary or fixed nodes';
    document.querySelector('[data-command=start-dismiss]')!.textContent = untouched ? 'Not this' : 'Done';
    const said = this.said();
    if (this.says.textContent !== said) this.says.textContent = said;
    this.says.hidden = said === '';
  }

  /** Returns whether there was something to take back. */
  dismiss(): boolean {
    if (!this.way) return false;
    this.choose(null);
    this.editor.try(null);
    return true;
  }

  private part<Part extends HTMLElement>(id: string): Part {
    return document.getElementById(id) as Part;
  }

  private begin(): void {
    Object.assign(this, { shape: this.editor.shape, own: null, noise: null, painted: this.editor.picked });
    ++this.asking;
    this.asking = 0;
    if (this.way) this.choose(null);
  }

  private choose(way: Way | null): void {
    const { editor } = this;
    const before = this.way;
    if (way === before) return;
    this.way = way;
    if (before === 'repair') {
      this.tools().set('pick');
      editor.pick(-1, false);
    }
    if (way === 'repair') {
      editor.try(null);
      this.painted = editor.picked;
      this.tools().set('brush');
      if (editor.picked.size > 0) void this.repair();
    } else if (way === 'smooth') {
      void this.smooth();
    } else if (way === 'free') {
      editor.try(freed(editor.history.now.state));
    }
    this.events.chosen(way);
    editor.set({});
  }

  private async smooth(): Promise<void> {
    const { editor, shape } = this;
    await this.asked(async () => {
      if (this.noise === null) {
        this.noise = await editor.client.ask('noise', null);
        this.tolerance.value = String(suggestedTolerance(this.noise, 1 / shape!.scale));
      }
      this.own ??= await editor.cloudOf({ name: '', bytes: null });
      const tolerance = this.tolerance.valueAsNumber;
      this.tolerance.setAttribute('aria-invalid', String(!(tolerance > 0)));
      if (this.way === 'smooth' && tolerance > 0) editor.try(smoothed(editor.history.now.state, this.own, tolerance));
    });
  }

  private async repair(): Promise<void> {
    const { editor } = this;
    const nodes = (this.painted = editor.picked);
    if (nodes.size === 0) {
      editor.try(null);
      return;
    }
    await this.asked(async () => {
      const next = await editor.restrictedTo(nodes);
      if (next && nodes === editor.picked && this.way === 'repair') editor.try(next);
    });
  }

  /** What another file makes out of date is dropped. */
  private async asked(ask: () => Promise<void>): Promise<void> {
    ++this.asking;
    try {
      await ask();
    } catch (error) {
      this.editor.setFault((error as Error).message, 'solver');
    }
    --this.asking;
    this.editor.set({});
  }

  private apply(): void {
    const { editor, way } = this;
    const titles: Record<Way, string> = { smooth: `Smooth within ${short(this.tolerance.valueAsNumber)}`, repair: `Repair ${counted(editor.picked.size, 'node')}`, free: 'Free form' };
    editor.accept(titles[way!]);
    if (way !== 'repair') {
      this.choose(null);
      return;
    }
    editor.pick(-1, false);
  }

  private said(): string {
    const { editor, way } = this;
    if (!way) return '';
    if (way === 'repair' && editor.picked.size === 0) return 'Paint over what is to be repaired. With Alt the brush takes away.';
    if (!editor.trying || editor.busy) return 'Trying it …';
    const { report, shape } = editor;
    const size = 1 / shape!.scale;
    const why = way !== 'smooth' || this.noise === null ? '' : isNoisy(this.noise, size) ? ` Its noise seems to be ${rounded(this.noise)}.` : ' It has no noise to speak of.';
    if (report?.outcome === 'cancelled') return 'Stopped before it was done.';
    if (report?.movingNodes === 0) return `Nothing moves: all of it is held.${why}`;
    const far = way === 'smooth' && report?.fit ? `within ${rounded(report.fit.greatest)}` : `at most by ${rounded(editor.movedInTrial)}`;
    return `Moves ${counted(report?.movingNodes ?? 0, 'node')}, ${far}.${why}`;
  }
}
