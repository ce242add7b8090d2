// The curvature of the open curve: its comb in the view, and its plot in the dock. Both follow the visible shape.

import { edge as chartEdge } from '../../../page/chart.js';
import { addCurveCharts } from '../../../page/charts.js';
import { chainsOf } from '../../../page/curve.js';
import type { Shape } from '../shape/shape';
import { combOf, toothOf, type Chain } from '../view/comb';
import type { CurveLayer } from '../view/curve_layer';

/** Of the arc length, the least that the plot shows. */
const least = 0.002;
const wide = (plot: HTMLElement): number => Math.max(1, plot.clientWidth - chartEdge.left - chartEdge.right);

export class CurvePanel {
  private shape: Shape | null = null;
  private input: Chain[] = [];
  private chains: Chain[] = [];
  private tooth = 0;
  private asked = false;
  /** A small screen has no room for it. */
  root = false;
  /** What the plot shows of the arc length, from and to, as shares of all. */
  private part: [number, number] = [0, 1];
  unfolded = innerWidth > 768;

  /** slider: how long hairs are, 1 as is good for most. clip: the share of the curve that is shown in full. dock: where the plot is, with its switch. drawn: has the view drawn. changed: the plot shows another part. */
  constructor(
    private readonly layer: CurveLayer,
    private readonly slider: HTMLInputElement,
    private readonly clip: HTMLInputElement,
    private readonly dock: HTMLElement,
    private readonly drawn: () => void,
    private readonly changed: () => void,
  ) {
    slider.addEventListener('input', () => this.refresh());
    clip.addEventListener('input', () => { this.scaleTeeth(); this.refresh(); });
    new ResizeObserver(() => this.refresh()).observe(dock);
    this.bindPlot(dock.querySelector('#plot')!);
  }

  /** The wheel zooms along the curve at the pointer, a drag moves. */
  private bindPlot(plot: HTMLElement): void {
    plot.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(2 ** (event.deltaY / 400), (event.clientX - plot.getBoundingClientRect().left - chartEdge.left) / wide(plot));
    }, { passive: false });
    plot.addEventListener('pointerdown', (event) => plot.setPointerCapture(event.pointerId));
    plot.addEventListener('pointermove', (event) => {
      if (!plot.hasPointerCapture(event.pointerId)) return;
      const [from, to] = this.part;
      this.setPart(from - (event.movementX / wide(plot)) * (to - from), to - from);
    });
    plot.addEventListener('dblclick', () => this.setPart(0, 1));
  }

  /** at: what stays where it is, as a share of what is shown. */
  zoom(factor: number, at = 0.5): void {
    const [from, to] = this.part;
    const length = Math.min(1, Math.max(least, factor * (to - from)));
    this.setPart(from + at * (to - from - length), length);
  }

  get zoomed(): boolean {
    return this.part[1] - this.part[0] < 1;
  }

  private setPart(from: number, length: number): void {
    const begin = Math.min(1 - length, Math.max(0, from));
    this.part = [begin, begin + length];
    this.changed();
    this.refresh();
  }

  get comb(): boolean {
    return Number(this.slider.value) > 0;
  }

  fold(): void {
    this.unfolded = !this.unfolded;
    this.dock.hidden = !this.unfolded;
    this.refresh();
  }

  toggleComb(): void {
    this.slider.value = this.comb ? '0' : '1';
    this.refresh();
  }

  open(shape: Shape): void {
    this.shape = shape.curve && shape;
    this.dock.hidden = !this.shape || !this.unfolded;
    this.part = [0, 1];
    this.input = this.chainsAt(shape.input);
    this.show(shape.input, true);
  }

  /** settled: hairs get the length that is good for this shape; in a drag they keep theirs, to be compared. */
  show(positions: Float64Array, settled: boolean): void {
    if (!this.shape) return;
    this.chains = this.chainsAt(positions);
    if (settled || this.tooth === 0) this.scaleTeeth();
    this.refresh();
  }

  /** What is sharper than this share of the curve has hairs that are cut off, so that the rest is seen. */
  private scaleTeeth(): void {
    const share = Number(this.clip.value) / 100;
    this.clip.parentElement!.querySelector('output')!.textContent = share < 1 ? `${this.clip.value} %` : 'off';
    if (this.shape) this.tooth = toothOf(this.chains, 1 / this.shape.scale, share);
  }

  toggleRoot(): void {
    this.root = !this.root;
    this.refresh();
  }

  private chainsAt(positions: Float64Array): Chain[] {
    const curve = this.shape?.curve;
    return curve ? chainsOf({ positions, runs: curve.runs, closed: curve.closed }, { planar: curve.plane !== null, towards: curve.plane }) as Chain[] : [];
  }

  /** Many changes, one picture. */
  private refresh(): void {
    if (!this.shape || this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      if (!this.shape) return;
      this.drawComb(this.shape);
      if (this.unfolded) this.drawPlot(this.shape);
    });
  }

  private drawComb({ centre, scale }: Shape): void {
    const tooth = this.tooth * Number(this.slider.value);
    const { hairs, envelope } = combOf(tooth > 0 ? this.chains : [], tooth, 1 / scale, (point) => point.map((part, i) => (part - centre[i]) * scale) as typeof point, this.root);
    this.layer.setComb(hairs, envelope);
    this.drawn();
  }

  private drawPlot({ curve, input }: Shape): void {
    const plot = this.dock.querySelector<HTMLElement>('#plot')!;
    const { clientWidth: width, clientHeight: height } = plot;
    if (width === 0) return;
    const shapes = [{ title: 'input', chains: this.input }, { title: 'shown', chains: this.chains }];
    plot.replaceChildren();
    if (input.length === 0) return;
    addCurveCharts(plot, shapes, { unit: 1, leading: 1, planar: curve!.plane !== null, share: Number(this.clip.value) / 100, part: this.part, pixels: { width, height } }, {});
  }
}
