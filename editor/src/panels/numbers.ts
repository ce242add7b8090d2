// Positions and normals, or tangents, of picked nodes as numbers; Enter applies them.

import { numberIn, shownNumber, type Wanted } from '../base/entry';
import { unitOf } from '../base/units';
import type { Vector } from '../base/vectors';
import type { Part } from '../library/protocol';
import { placed } from '../constraints/constraints';
import { labelOf } from '../pull/drags';
import type { Editor } from '../edit/editor';

const direction: Wanted = { words: 'numbers such as 0.5 or −2; what is empty counts as 0', takes: Number.isFinite };
const place: Wanted = { words: 'numbers such as 0.5 or 5 mm; what is empty counts as 0', takes: Number.isFinite, isLength: true };

/** In words what is to be done where these are no numbers. An empty field counts as zero if another one is filled. */
export function vectorOf(texts: readonly string[], wanted: Wanted): Vector | string {
  if (texts.every((text) => text.trim() === '')) return `Give ${wanted.words}`;
  const numbers = texts.map((text) => (text.trim() === '' ? 0 : numberIn(text, wanted)));
  return numbers.find((number) => typeof number === 'string') ?? (numbers as Vector);
}

class Fields {
  private readonly inputs: HTMLInputElement[];
  private readonly note = Object.assign(document.createElement('p'), { className: 'wrong', role: 'alert' });
  private texts = '';

  constructor(readonly form: HTMLFormElement, private readonly wanted: Wanted, private readonly applied: (vector: Vector) => void) {
    this.inputs = [...form.querySelectorAll('input')];
    form.append(this.note);
    this.say('');
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const vector = vectorOf(this.inputs.map(({ value }) => value), wanted);
      this.say(typeof vector === 'string' ? vector : '');
      if (typeof vector === 'string') return;
      this.texts = '';
      this.applied(vector);
    });
    form.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      this.texts = '';
      (event.target as HTMLElement).blur();
    });
  }

  /** What is being typed stays. */
  show(label: string, vector: Vector | null): void {
    const said = this.wanted.isLength && unitOf() ? `${label}, ${unitOf()}` : label;
    const texts = JSON.stringify([said, vector]);
    if (texts === this.texts) return;
    this.texts = texts;
    this.form.querySelector('span')!.textContent = said;
    this.say('');
    this.inputs.forEach((input, i) => {
      input.value = vector ? shownNumber(vector[i]) : '';
      input.setAttribute('aria-label', `${label} ${'xyz'[i]}`);
    });
  }

  private say(problem: string): void {
    this.note.textContent = problem;
    this.note.hidden = problem === '';
    for (const input of this.inputs) input.setAttribute('aria-invalid', String(problem !== ''));
  }
}

export class Numbers {
  private readonly position: Fields;
  private readonly normal: Fields;

  constructor(private readonly section: HTMLElement, private readonly editor: Editor) {
    const fields = (which: string, wanted: Wanted, part: () => Part): Fields => new Fields(section.querySelector(`[data-part=${which}]`)!, wanted, (vector) => void this.apply(part(), vector));
    this.position = fields('position', place, () => 'position');
    this.normal = fields('normal', direction, () => editor.direction);
  }

  refresh(): void {
    const { picked, normals } = this.editor;
    this.section.hidden = picked.size === 0;
    if (picked.size === 0) return;
    const [first] = picked;
    const shared = normals.get(first);
    const alike = shared && [...picked].every((node) => normals.get(node)?.every((part, i) => part === shared[i]));
    if (this.isOne) this.position.show('Position', this.editor.placeOf(first));
    else this.position.show('Move by', null);
    const name = this.editor.shape?.curve ? 'Tangent' : 'Normal';
    this.normal.show(this.isOne ? name : `${name}s`, alike ? shared : null);
  }

  /** Whether it is one node, or one with its mirror image. */
  private get isOne(): boolean {
    const { picked, mirror } = this.editor;
    const [first] = picked;
    return picked.size === 1 || (mirror !== null && picked.size === 2 && mirror.with([first]).length === 2 && mirror.with([first]).every((node) => picked.has(node)));
  }

  /** What is picked is held there, and what is near goes along as with a pull. Of the one node the fields have its place, of several how far they go. */
  private async apply(part: Part, vector: Vector): Promise<void> {
    const nodes = [...this.editor.picked];
    if (part !== 'position' && !vector.some(Boolean)) {
      this.editor.setFault('A normal or tangent has a direction: not all three numbers may be 0', 'file');
      return;
    }
    const { mirror } = this.editor;
    const { isOne } = this;
    const vectors = nodes.flatMap((node) => {
      const own = mirror?.mirrored(vector, nodes[0], node, false) ?? vector;
      return part !== 'position' || isOne ? own : this.editor.placeOf(node).map((place, i) => place + own[i]);
    });
    const near = part === 'position' ? await this.editor.nearby(nodes)?.catch(() => null) : null;
    this.editor.apply(labelOf(part, nodes), placed(near ?? this.editor.constraints, nodes, Float64Array.from(vectors), part));
  }
}
