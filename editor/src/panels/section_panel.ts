// Sections of the surface across an axis with their curvature combs: one at the place of a slider or number, or several
// at even steps. They follow the visible shape.

import type { Command } from '../base/commands';
import { Entry, wholeNumber } from '../base/entry';
import { sectionOf } from '../shape/section';
import { placesOf, type Shape } from '../shape/shape';
import { verticesOf, type Vertices } from '../shape/vertices';
import { combOf, combedSection, toothOf } from '../view/comb';
import type { CurveLayer } from '../view/curve_layer';

/** Of the section, how much of it has hairs in full: what is next to an edge may turn by much more than the rest. */
const share = 0.98;

export class SectionPanel {
  private shape: Shape | null = null;
  private positions: Float64Array = new Float64Array();
  private vertices: Vertices | null = null;
  private tooth = 0;
  private shown = false;
  private readonly axis = document.getElementById('section-axis') as HTMLSelectElement;
  private readonly at = document.getElementById('section-at') as HTMLInputElement;
  /** In units of the file. */
  private readonly value = new Entry(document.getElementById('section-value') as HTMLInputElement, () => ({ words: 'a place within the shape, such as 0.5 or 5 mm', takes: (value) => value >= this.ends[0] && value <= this.ends[1], isLength: true }), (value) => { if (value !== null) this.moveTo(value); });
  private readonly count = new Entry(document.getElementById('section-count') as HTMLInputElement, () => wholeNumber(1, 100), (count) => { if (count !== null) this.rescale(); });
  private readonly comb = document.getElementById('section-comb') as HTMLInputElement;

  /** drawn: has the view drawn. */
  constructor(private readonly layer: CurveLayer, private readonly drawn: () => void) {
    this.axis.addEventListener('change', () => this.rescale());
    this.at.addEventListener('input', () => this.draw());
    this.at.addEventListener('change', () => this.rescale());
    this.comb.addEventListener('input', () => this.draw());
  }

  get command(): Command {
    return { id: 'section', title: 'Section across X, Y, Z or none', keys: ['v'], enabled: () => this.shape !== null, run: () => {
      this.axis.selectedIndex = (this.axis.selectedIndex + 1) % this.axis.length;
      this.rescale();
    } };
  }

  open(shape: Shape): void {
    this.shape = shape.curve ? null : shape;
    this.show(shape.input, true);
  }

  /** settled: what is sharp is looked for anew, and hairs get a length that is good; in a drag they keep theirs, to be compared. */
  show(positions: Float64Array, settled: boolean): void {
    this.positions = positions;
    if (settled) this.vertices = null;
    if (settled) this.rescale();
    else this.draw();
  }

  private rescale(): void {
    this.tooth = 0;
    this.draw();
  }

  private draw(): void {
    const { shape, positions, axis } = this;
    const chosen = 'xyz'.indexOf(axis.value || '-');
    for (const field of document.querySelectorAll<HTMLElement>('#section .field:has(input)')) field.hidden = chosen < 0;
    for (const id of ['section-at', 'section-value']) document.getElementById(id)!.closest<HTMLElement>('.field')!.hidden = chosen < 0 || this.count.value > 1;
    // Without a section no other picture needs drawing.
    const draws = shape !== null && chosen >= 0;
    if (!draws && !this.shown) return;
    this.shown = draws;
    const runs = draws ? this.runsAt(shape, positions, chosen) : [];
    const chains = runs.map((run) => combedSection(run, shape!.spacing));
    if (this.tooth === 0) this.tooth = toothOf(chains, 1, share);
    const tooth = this.tooth * this.comb.valueAsNumber;
    const { hairs, envelope } = combOf(tooth > 0 ? chains : [], tooth, 1, (place) => place);
    const ends: number[] = [];
    let count = 0;
    for (const { points, closed } of runs) {
      points.forEach((_, k) => { if (k + 1 < points.length || closed) ends.push(count + k, count + ((k + 1) % points.length)); });
      count += points.length;
    }
    this.layer.show(Float32Array.from(runs.flatMap(({ points }) => points.flat())), ends);
    this.layer.setComb(hairs, envelope);
    this.drawn();
  }

  private runsAt(shape: Shape, positions: Float64Array, axis: number): ReturnType<typeof sectionOf> {
    const places = placesOf(shape, positions);
    this.vertices ??= verticesOf(shape.faces, places, shape.edges);
    const { vertices } = this;
    return this.valuesAcross(this.ends).flatMap((value) => sectionOf(shape, places, vertices, axis, (value - shape.centre[axis]) * shape.scale));
  }

  private valuesAcross([low, high]: [number, number]): number[] {
    const { count: { value: many }, at } = this;
    if (many > 1) return Array.from({ length: many }, (_, k) => low + ((k + 0.5) / many) * (high - low));
    const value = low + (at.valueAsNumber / Number(at.max)) * (high - low);
    this.value.show(Number(value.toPrecision(4)));
    return [value];
  }

  private moveTo(value: number): void {
    const [low, high] = this.ends;
    this.at.value = String(((value - low) / (high - low)) * Number(this.at.max));
    this.rescale();
  }

  /** Of the input along the axis. */
  private get ends(): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    const { shape, axis } = this;
    const chosen = 'xyz'.indexOf(axis.value || '-');
    if (!shape || chosen < 0) return [low, high];
    for (let k = chosen; k < shape.input.length; k += 3) [low, high] = [Math.min(low, shape.input[k]), Math.max(high, shape.input[k])];
    return [low, high];
  }
}
