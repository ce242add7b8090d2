// Texts about the shape, its solution, and errors.

import { short } from '../../../page/numbers.js';
import { withUnit } from '../base/units';
import { counted, inEditorWords, isNote } from '../base/words';
import type { Shape } from '../shape/shape';
import { heldNormal, heldPosition, heldTangent, isUntouched } from '../constraints/constraints';
import type { Editor } from '../edit/editor';
import type { Field } from '../view/fields';

function part(id: string): HTMLElement {
  return document.getElementById(id)!;
}

/** Before there is an editor. */
export function sayItCannotDraw(): void {
  part('fault').firstElementChild!.textContent =
    'This browser has no WebGL 2, which the editor draws with. Switch hardware acceleration on in its settings, or take a newer browser; the program itself, vspring fair, needs none.';
  part('fault').hidden = false;
  part('fault').querySelector('button')!.hidden = true;
  part('status').textContent = 'Cannot draw';
  for (const controls of document.querySelectorAll<HTMLElement>('header, aside, .float, .card')) controls.inert = true;
}

const words: Record<string, string> = { converged: 'Done', cancelled: 'Stopped, the last shape stays', foreseen: 'Following', 'worse-than-input': 'Worse than it was, see the warnings' };

/** Whether it is done, and how far it has moved. */
function ofSolution({ report, dragging, busy, making, since, saved, showsInput, shape, moved, shown }: Editor): string {
  if (!shape) return 'Open a mesh or a curve, or drop one here';
  if (saved) return `Saved as ${saved}`;
  if (showsInput) return 'The input';
  if (making) return `${making} …`;
  if (busy && !dragging) return `Solving …${lasting(performance.now() - since)}`;
  if (isUntouched(shown) && moved === 0) return `As it is in the file${shown.curve ? ', with other nodes' : shown.filled ? ', with patches' : ''}`;
  if (!report) return '';
  const what = dragging ? 'Following' : (words[report.outcome] ?? 'Not settled');
  if (report.movingNodes === 0 && moved === 0 && report.outcome === 'converged') return 'Nothing moves: all of it is held';
  return `${what} · ${moved > 0 ? `${shape.curve ? 'the curve' : 'nodes'} moved at most ${withUnit(short(Number(moved.toPrecision(2))))} (${share(moved * shape.scale)})` : 'moved nothing'}`;
}

/** Of what takes so long that somebody may ask whether it goes on. */
function lasting(milliseconds: number): string {
  const seconds = Math.floor(milliseconds / 1000);
  return seconds > 0 ? ` ${seconds} s` : '';
}

function share(part: number): string {
  return `${short(Number((100 * part).toPrecision(2)))} % of the size`;
}

/** What somebody may want to know who looks after it. */
function detailsOf({ report, dragging, drags, frames, showsInput }: Editor): string {
  if (!report || showsInput) return '';
  const { outcome, iterations, expectedError, seconds, threads, warnings } = report;
  const error = expectedError === null || !Number.isFinite(expectedError) ? '' : ` · expected error ${short(Number((100 * expectedError).toPrecision(2)))} %`;
  const [solved, all] = frames.perSecond(performance.now()).map(Math.round);
  const rate = !dragging ? '' : drags.slow ? ` · ${all} frames/s, ${solved} solved` : ` · ${solved} frames/s`;
  return `${outcome} · ${counted(iterations, 'iteration')}${error} · ${Math.round(1000 * seconds)} ms${threads > 1 ? ` on ${threads} threads` : ''}${rate}${warnings.filter(isNote).map((note) => ` · ${note}`).join('')}`;
}

function ofNode({ atArrow, hovered, held, normals, shape }: Editor, field: Field | null): string {
  if (hovered < 0) return '';
  if (atArrow) return `${shape?.curve ? 'Tangent' : 'Normal'} of node ${hovered} · ${normals.get(hovered)?.map((part) => short(Number(part.toPrecision(3)))).join(', ') ?? ''}`;
  const bits = held.nodes[hovered];
  const what = [bits & heldPosition && 'position fixed', bits & heldNormal && 'normal fixed', bits & heldTangent && 'tangent fixed'].filter(Boolean);
  const value = field ? ` · ${field.name} ${short(field.values[hovered])}${radiusOf(field, hovered)}` : '';
  return `Node ${hovered} · ${what.join(', ') || 'free'}${value}`;
}

/** What a mean curvature is to a designer. */
function radiusOf({ name, values }: Field, node: number): string {
  return name === 'mean' && values[node] !== 0 ? `, radius ${withUnit(short(Number(Math.abs(1 / values[node]).toPrecision(3))))}` : '';
}

function ofParts({ faces, curve }: Shape): string {
  if (!curve) return counted(faces.begin.length - 1, 'face');
  const { closed } = curve;
  return closed.length === 1 ? `${closed[0] ? 'closed' : 'open'} curve` : counted(closed.length, 'chain');
}

/** Before the first word of how far it is, the bar only says that something goes on. */
function showProgress(bar: HTMLProgressElement, fraction: number): void {
  if (fraction > 0) bar.value = fraction;
  else bar.removeAttribute('value');
}

/** field: what colours show. */
export function describe(editor: Editor, field: Field | null): void {
  const { shape, fault, held, picked, fileWarnings, report, canEnd, fraction } = editor;
  part('name').textContent = editor.name;
  part('status').textContent = ofSolution(editor);
  part('status').title = detailsOf(editor);
  part('status').dataset.outcome = editor.showsInput ? 'input' : editor.busy ? 'solving' : (report?.outcome ?? '');
  part('status').classList.toggle('doubtful', !editor.showsInput && !editor.busy && report !== null && !['converged', 'foreseen'].includes(report.outcome));
  part('node').textContent = ofNode(editor, field);
  const strength = part('strength') as HTMLInputElement;
  strength.disabled = !shape;
  strength.value = String(Math.round(100 * editor.strength));
  part('share').textContent = `${strength.value} %`;
  part('size').textContent = shape ? `${counted(shape.input.length / 3, 'node')}, ${ofParts(shape)}` : '';
  part('picked').textContent = picked.size === 1 ? `Node ${[...picked][0]}` : picked.size ? `${picked.size} nodes` : 'No node picked';
  part('unmarked').hidden = held.unmarked === 0;
  part('unmarked').textContent = `${counted(held.unmarked, 'rule')} about groups or regions: what they hold is not marked.`;
  part('fault').hidden = !fault;
  const message = inEditorWords(fault?.message ?? '');
  if (part('fault').firstElementChild!.textContent !== message) part('fault').firstElementChild!.textContent = message;
  part('progress').hidden = !canEnd;
  document.querySelector<HTMLElement>('[data-command=go-on]')!.hidden = !editor.stopped;
  showProgress(part('progress').querySelector('progress')!, fraction);
  const warnings = [...fileWarnings, ...[...(editor.shown.filled?.warnings ?? []), ...(report?.warnings ?? [])].filter((warning) => !isNote(warning))].map(inEditorWords);
  part('warnings').hidden = warnings.length === 0;
  part('warnings').querySelector('ul')!.replaceChildren(...warnings.map((textContent) =>
    Object.assign(document.createElement('li'), { textContent })));
}
