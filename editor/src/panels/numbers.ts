// Positions and normals, or tangents, of picked nodes as numbers; Enter applies them.

import type { Vector } from '../base/vectors';
import type { Part } from '../library/protocol';
import { placed } from '../constraints/constraints';
import { labelOf } from '../pull/drags';
import type { Editor } from '../edit/editor';

/** null: not three numbers. An empty field counts as zero if another one is filled. */
export function vectorOf(texts: readonly string[]): Vector | null {
  if (texts.every((text) => text.trim() === '')) return null;
  const numbers = texts.map((text) => Number(text.trim().replace('−', '-').replace(',', '.')));
  return numbers.every(Number.isFinite) ? (numbers as Vector) : null;
}

function shown(number: number): string {
  return String(Number(number.toPrecision(6)));
}

class Fields {
  private readonly inputs: HTMLInputElement[];
  private texts = '';

  constructor(readonly form: HTMLFormElement, private readonly applied: (vector: Vector) => void) {
    this.inputs = [...form.querySelectorAll('input')];
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const vector = vectorOf(this.inputs.map(({ value }) => value));
      for (const input of this.inputs) input.setAttribute('aria-invalid', String(!vector));
      if (!vector) return;
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
    const texts = JSON.stringify([label, vector]);
    if (texts === this.texts) return;
    this.texts = texts;
    this.form.querySelector('span')!.textContent = label;
    this.inputs.forEach((input, i) => {
      input.value = vector ? shown(vector[i]) : '';
      input.setAttribute('aria-invalid', 'false');
      input.setAttribute('aria-label', `${label} ${'xyz'[i]}`);
    });
  }
}

export class Numbers {
  private readonly position: Fields;
  private readonly normal: Fields;

  constructor(private readonly section: HTMLElement, private readonly editor: Editor) {
    const fields = (which: string, part: () => Part): Fields => new Fields(section.querySelector(`[data-part=${which}]`)!, (vector) => this.apply(part(), vector));
    this.position = fields('position', () => 'position');
    this.normal = fields('normal', () => editor.direction);
  }

  refresh(): void {
    const { picked, normals } = this.editor;
    this.section.hidden = picked.size === 0;
    if (picked.size === 0) return;
    const [first] = picked;
    const shared = normals.get(first);
    const alike = shared && [...picked].every((node) => normals.get(node)?.every((part, i) => part === shared[i]));
    if (picked.size === 1) this.position.show('Position', this.editor.placeOf(first));
    else this.position.show('Move by', null);
    const name = this.editor.shape?.curve ? 'Tangent' : 'Normal';
    this.normal.show(picked.size === 1 ? name : `${name}s`, alike ? shared : null);
  }

  /** What is picked is held there. Of the one node the fields have its place, of several how far they go. */
  private apply(part: Part, vector: Vector): void {
    const nodes = [...this.editor.picked];
    if (part !== 'position' && !vector.some(Boolean)) {
      this.editor.setFault('A normal or tangent has a direction: not all three numbers may be 0', 'file');
      return;
    }
    const { mirror } = this.editor;
    const vectors = nodes.flatMap((node) => {
      const own = mirror?.mirrored(vector, nodes[0], node, false) ?? vector;
      return part !== 'position' || nodes.length === 1 ? own : this.editor.placeOf(node).map((place, i) => place + own[i]);
    });
    this.editor.apply(labelOf(part, nodes), placed(this.editor.constraints, nodes, Float64Array.from(vectors), part));
  }
}
