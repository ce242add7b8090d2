// The curvature of the open curve: its comb in the view, and its plot in the dock. Both follow the shape that is seen.

import { addCurveCharts } from '../../../page/charts.js';
import { chainsOf } from '../../../page/curve.js';
import type { Shape } from '../shape/shape';
import { combOf, toothOf, type Chain } from '../view/comb';
import type { CurveLayer } from '../view/curve_layer';

export class CurvePanel {
  private shape: Shape | null = null;
  private input: Chain[] = [];
  private chains: Chain[] = [];
  private tooth = 0;
  private asked = false;
  /** A small screen has no room for it. */
  root = false;
  unfolded = innerWidth > 768;

  /** slider: how long hairs are, 1 as is good for most. clip: the share of the curve that is shown in full. dock: where the plot is, with its switch. drawn: has the view drawn. */
  constructor(
    private readonly layer: CurveLayer,
    private readonly slider: HTMLInputElement,
    private readonly clip: HTMLInputElement,
    private readonly dock: HTMLElement,
    private readonly drawn: () => void,
  ) {
    slider.addEventListener('input', () => this.refresh());
    clip.addEventListener('input', () => { this.scaleTeeth(); this.refresh(); });
    new ResizeObserver(() => this.refresh()).observe(dock);
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
    addCurveCharts(plot, shapes, { unit: 1, leading: 1, planar: curve!.plane !== null, pixels: { width, height } }, {});
  }
}
