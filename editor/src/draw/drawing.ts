// Drawing curves: the tool, and its texts in the page.

import type { Command } from '../base/commands';
import { Entry, wholeNumber } from '../base/entry';
import type { Vector } from '../base/vectors';
import type { Editor } from '../edit/editor';
import type { Opening } from '../edit/opening';
import type { View } from '../view/view';
import { DrawTool } from './draw';
import { Preview } from './preview';

export class Drawing {
  private normal: Vector = [0, 0, 1];
  private readonly hint = document.getElementById('hint')!;
  private readonly perSpan: Entry;
  private readonly tool: DrawTool;
  private sketched: readonly Vector[] = [];
  private readonly preview: Preview;

  /** To be made before all else that listens to the canvas. refresh: brings the buttons up to date. */
  constructor(canvas: HTMLCanvasElement, private readonly editor: Editor, private readonly opening: Opening, private readonly view: () => View, private readonly refresh: () => void) {
    this.preview = new Preview((curve) => editor.client.ask('sketch', curve), (curve) => view().showSketch(this.sketched, curve));
    this.tool = new DrawTool(canvas, {
      placeAt: (x, y) => view().placeAt(x, y, this.normal),
      pixelOf: (place) => view().pixelOf(place),
      changed: (nodes, next) => {
        const closes = next !== null && next === nodes[0];
        this.sketched = next && !closes ? [...nodes, next] : [...nodes];
        this.preview.through(this.sketched, closes, this.nodesPerSpan);
      },
      ended: (nodes, closed) => {
        this.tell();
        if (nodes.length > 0) void opening.draw(nodes, closed, this.nodesPerSpan);
      },
    });
    this.perSpan = new Entry(document.getElementById('per-span') as HTMLInputElement, () => wholeNumber(1, 1000), (nodes) => {
      if (nodes !== null && editor.drawn) opening.redraw(this.closed, nodes);
    });
  }

  get commands(): Command[] {
    return [
      { id: 'new-curve', title: 'New curve in an empty plane', keys: [], run: () => this.begin(true) },
      { id: 'draw', title: 'Draw a curve in the plane of the view', keys: ['d'], run: () => (this.tool.draws ? this.tool.end(false) : this.begin(false)), pressed: () => this.tool.draws },
      { id: 'closed', title: 'Close or open the drawn curve', keys: [], run: () => this.opening.redraw(!this.closed, this.nodesPerSpan),
        enabled: () => this.editor.drawn, pressed: () => this.closed },
    ];
  }

  private get closed(): boolean {
    return this.editor.shape?.curve?.closed[0] ?? false;
  }

  private get nodesPerSpan(): number {
    return this.perSpan.value;
  }

  /** Where nothing is open, in the plane z = 0, seen from above; else in the plane of the view through the origin. */
  private begin(empty: boolean): void {
    if (empty) this.opening.close();
    this.normal = this.editor.shape ? this.view().towards : [0, 0, 1];
    this.tool.start();
    this.tell();
  }

  private tell(): void {
    this.hint.hidden = !this.tool.draws;
    this.refresh();
  }
}
