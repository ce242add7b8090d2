// A PNG of before and after in the present view, with a legend, a scale and figures.

import { quantiles, short } from '../../../page/numbers.js';
import { marksOf } from '../../../page/surface_fields.js';
import { download, stem } from '../base/files';
import { unitOf, withUnit } from '../base/units';
import { counted } from '../base/words';
import { furthest } from '../shape/between';
import type { Editor } from '../edit/editor';
import type { Field, Fields } from '../view/fields';
import type { View } from '../view/view';

interface Side {
  title: string;
  picture: HTMLCanvasElement;
  field: Field | null;
}

const inPicture = { margin: 36, line: 44, ramp: 340, bar: 0.25 };
type Drawn = CanvasRenderingContext2D;

/** What can be shown to others of what is open. */
export class PictureOf {
  constructor(private readonly editor: Editor, private readonly view: View, private readonly fields: Fields) {}

  async save(): Promise<void> {
    const { editor } = this;
    const { showsInput } = editor;
    const sides = [await this.side('Before', true), await this.side('After', false)];
    editor.show({ showsInput }, true);
    const blob = await new Promise<Blob | null>((done) => this.composed(sides).toBlob(done, 'image/png'));
    const name = `${stem(editor.name)}-before-after.png`;
    download(name, new Uint8Array(await blob!.arrayBuffer()));
    editor.set({ saved: name });
  }

  private async side(title: string, showsInput: boolean): Promise<Side> {
    this.editor.show({ showsInput }, true);
    const field = await this.fields.rest();
    return { title, picture: await this.view.picture(), field };
  }

  private composed(sides: Side[]): HTMLCanvasElement {
    const { margin, line } = inPicture;
    const [{ picture: { width, height } }] = sides;
    const canvas = Object.assign(document.createElement('canvas'), { width: 2 * width + 3 * margin, height: height + 3 * margin + 5 * line });
    const context = canvas.getContext('2d')!;
    const style = getComputedStyle(document.body);
    const [ink, paper] = [style.color, style.backgroundColor];
    context.fillStyle = paper;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.fillStyle = ink;
    context.textBaseline = 'middle';
    const say = (text: string, x: number, y: number, weight = 400): void => {
      context.font = `${weight} ${0.62 * line}px system-ui, sans-serif`;
      context.fillText(text, x, y);
    };
    say(this.editor.name, margin, margin, 600);
    sides.forEach(({ title, picture, field }, k) => {
      const left = margin + k * (width + margin);
      context.drawImage(picture, left, margin + line);
      say(title, left, margin + 1.6 * line + height, 600);
      say(this.figuresOf(k > 0, field), left + 4 * line, margin + 1.6 * line + height);
    });
    const top = 2 * margin + 2 * line + height;
    this.drawScale(context, margin, top, say);
    const { field } = sides[1];
    if (field) this.drawLegend(context, field, 2 * margin + width, top, say);
    return canvas;
  }

  private figuresOf(after: boolean, field: Field | null): string {
    const { editor } = this;
    const { shape, result, strength } = editor;
    const moved = strength * furthest(result, shape!.input);
    const figures = after ? (moved > 0 ? `nodes moved at most ${withUnit(short(Number(moved.toPrecision(2))))}` : 'nothing has moved') : counted(shape!.input.length / 3, 'node');
    if (!field || field.name === 'deviation') return figures;
    const { share } = this.fields;
    const [low, high] = quantiles(field.values, [(1 - share) / 2, (1 + share) / 2]).map((value: number) => short(Number(value.toPrecision(3))));
    return `${figures} · ${Math.round(100 * share)} % of its nodes have ${low} to ${high}`;
  }

  /** A round length, as long as it is in the view. */
  private drawScale(context: Drawn, left: number, top: number, say: (text: string, x: number, y: number) => void): void {
    const { perUnit, width } = this.view.scaleOfPicture;
    const most = (inPicture.bar * width) / perUnit;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = power * [5, 2, 1].find((factor) => factor * power <= most)!;
    context.fillRect(left, top, length * perUnit, 4);
    for (const end of [0, length * perUnit - 2]) context.fillRect(left + end, top - 6, 2, 16);
    say(`${short(Number(length.toPrecision(1)))} ${unitOf() || 'units of the file'}`, left, top + inPicture.line);
  }

  private drawLegend(context: Drawn, { title, map, range }: Field, left: number, top: number, say: (text: string, x: number, y: number) => void): void {
    const { ramp, line } = inPicture;
    const colours = context.createLinearGradient(left, 0, left + 2 * ramp, 0);
    map.forEach((colour, k) => colours.addColorStop(k / (map.length - 1), `rgb(${colour.map((part) => Math.round(255 * part)).join(' ')})`));
    const { fillStyle } = context;
    say(title, left, top);
    context.fillStyle = colours;
    context.fillRect(left, top + 0.6 * line, 2 * ramp, 14);
    context.fillStyle = fillStyle;
    const marks = marksOf(range) as string[];
    marks.forEach((mark, k) => {
      context.textAlign = (['left', 'center', 'right'] as const)[k];
      say(mark, left + k * ramp, top + 1.7 * line);
    });
    context.textAlign = 'left';
  }
}
