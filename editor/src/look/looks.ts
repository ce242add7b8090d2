// How the shape is shown: shaded, by lines or colours, with edges, and next to its input.

import type { Command } from '../base/commands';
import type { Shape } from '../shape/shape';
import type { Editor } from '../edit/editor';
import { fieldNames, type Fields } from '../view/fields';
import { looks, type Look } from '../view/materials';
import type { View } from '../view/view';
import { bindLamps } from './lamps';
import type { Marks } from './marks';

const titles: Record<Look, string> = { shaded: 'Shaded', wire: 'Wire', zebra: 'Zebra', mean: 'Mean curvature', gaussian: 'Gaussian curvature', deviation: 'Deviation from the input' };

export class Looks {
  look: Look = 'shaded';
  private edges = false;

  /** wipe, lamps: the sliders between input and result and of reflection lines, in their cards. line: between input and result, which can be dragged. changed: the buttons are to be brought up to date. */
  constructor(private readonly editor: Editor, private readonly view: View, private readonly fields: Fields, private readonly marks: Marks, private readonly wipe: HTMLElement, line: HTMLElement,
    private readonly lamps: HTMLElement, private readonly changed: () => void) {
    wipe.addEventListener('input', () => this.setWipe());
    line.addEventListener('pointerdown', (event) => line.setPointerCapture(event.pointerId));
    line.addEventListener('pointermove', (event) => {
      if (!line.hasPointerCapture(event.pointerId)) return;
      const { left } = line.parentElement!.getBoundingClientRect();
      wipe.querySelector('input')!.value = String((100 * (event.clientX - left)) / view.free);
      this.setWipe();
    });
    bindLamps(lamps, (set) => view.setLamps(set));
  }

  get commands(): Command[] {
    const { editor, marks, wipe } = this;
    const surface = (): boolean => editor.shape?.curve == null;
    const then = (act: () => void) => (): void => {
      act();
      this.changed();
    };
    return [
      ...looks.map((which) => ({ id: which, title: titles[which], keys: [String(['shaded', 'wire', 'zebra', ...fieldNames].indexOf(which) + 1)],
        run: () => this.set(which), pressed: () => this.look === which, enabled: surface })),
      { id: 'edges', title: 'Edges over what is shown', keys: ['7'], run: then(() => this.view.setEdges((this.edges = !this.edges))), pressed: () => this.edges, enabled: surface },
      { id: 'marks', title: 'Mark held nodes', keys: ['m'], run: then(() => marks.toggle()), enabled: () => editor.shape !== null, pressed: () => marks.visible },
      { id: 'wipe', title: 'Input and result side by side', keys: ['8'], run: then(() => { wipe.hidden = !wipe.hidden; this.setWipe(); }), pressed: () => !wipe.hidden,
        enabled: () => editor.shape !== null && surface() },
    ];
  }

  opened(shape: Shape): void {
    this.wipe.hidden ||= shape.curve !== null;
    this.setWipe();
    this.showLamps();
  }

  set(which: Look): void {
    this.look = which;
    this.view.setLook(which);
    this.showLamps();
    this.marks.refresh(which, false);
    this.fields.choose(fieldNames.find((name) => name === which) ?? null);
    this.changed();
  }

  private showLamps(): void {
    this.lamps.hidden = this.look !== 'zebra' || this.editor.shape?.curve != null;
  }

  private setWipe(): void {
    this.view.setWipe(this.wipe.hidden ? null : this.wipe.querySelector('input')!.valueAsNumber / 100);
  }
}
