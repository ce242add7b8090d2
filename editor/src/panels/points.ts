// The panel of scattered points: how the shape is fitted to them, and their distances from it.

import { short } from '../../../page/numbers.js';
import type { Command } from '../base/commands';
import { Entry, type Wanted } from '../base/entry';
import { choose } from '../base/files';
import type { FitKind, FitSettings, Report } from '../library/protocol';
import type { Cloud, Fit, PointSource } from '../constraints/points';
import type { Editor } from '../edit/editor';

const formats = '.xyz,.csv,.ply,.obj,.off,.stl,.dat';
/** Least and most of the slider; lengths in diagonals of the shape. */
const ranges: Record<FitKind, [number, number]> = { smoothingLength: [1e-3, 1], within: [1e-4, 0.3], rms: [1e-4, 0.3], weight: [1e-8, 10] };
const usual: Record<FitKind, number> = { smoothingLength: 0.05, within: 0.02, rms: 0.01, weight: 0.01 };
const titles: Record<FitKind, string> = { smoothingLength: 'Smoothing length', within: 'Tolerance', rms: 'Root mean square', weight: 'Weight' };
const takes = (value: number): boolean => value > 0 && value < Infinity;
const weight: Wanted = { words: 'a number above 0, such as 0.01', takes };
const length: Wanted = { words: 'a length above 0, such as 0.02 or 5 mm', takes, isLength: true };
const share: Wanted = { words: 'a number of per cent from 0 to 99', takes: (value) => value >= 0 && value <= 99 };

export class PointsPanel {
  private readonly kind = this.part<HTMLSelectElement>('fit-kind');
  private readonly slider = this.part<HTMLInputElement>('fit-slider');
  private readonly value = new Entry(this.part('fit-value'), () => this.wanted, (value) => value !== null && this.change({ value }));
  private readonly outliers = new Entry(this.part('fit-outliers'), () => share, (percent) => percent !== null && this.change({ outliers: percent / 100 }));

  constructor(private readonly editor: Editor) {
    this.kind.addEventListener('change', () => this.change({ kind: this.kind.value as FitKind, value: this.start(this.kind.value as FitKind) }));
    this.slider.addEventListener('input', () => { this.value.show(this.fromSlider()); });
    this.slider.addEventListener('change', () => this.change({ value: this.fromSlider() }));
  }

  get commands(): Command[] {
    const { editor } = this;
    return [
      { id: 'load-points', title: 'Load scattered points', keys: [], run: () => choose(formats, (file) => void this.load(file)), enabled: () => editor.shape !== null },
      { id: 'own-nodes', title: 'Fit to its own nodes', keys: [], run: () => void this.load(editor.start), enabled: () => editor.shape !== null && this.fit?.cloud.bytes !== null },
      { id: 'remove-points', title: 'Remove the points', keys: [], run: () => editor.apply('Remove points', { ...editor.constraints, fit: undefined }), enabled: () => this.fit !== undefined },
    ];
  }

  async load(source: PointSource): Promise<void> {
    const { editor } = this;
    const { shape } = editor;
    try {
      const cloud = await editor.cloudOf(source);
      if (shape !== editor.shape) return;
      const { kind, value, outliers } = this.fit ?? { kind: 'smoothingLength' as const, value: this.start('smoothingLength'), outliers: 0 };
      editor.apply('bytes' in source ? `Load points ${source.name}` : 'Fit to its own nodes', { ...editor.constraints, fit: { cloud, kind, value, outliers } });
      editor.set({ fault: null });
    } catch (error) {
      editor.setFault((error as Error).message, 'file');
    }
  }

  refresh(): void {
    const { fit } = this;
    const box = document.getElementById('fit')!;
    // Trials have their own panel.
    box.hidden = !fit || this.editor.trying;
    if (!fit) return;
    const { kind, value, outliers, cloud } = fit;
    const [least, most] = this.range(kind);
    this.kind.value = kind;
    if (document.activeElement !== this.slider) this.slider.valueAsNumber = (1000 * Math.log(value / least)) / Math.log(most / least);
    this.value.show(value);
    this.outliers.show(Number((100 * outliers).toPrecision(6)));
    this.part('fit-value').setAttribute('aria-label', `${titles[kind]}${kind === 'weight' ? '' : ', units of the file'}`);
    document.getElementById('fit-figures')!.textContent = figures(cloud, this.editor.report, fit);
  }

  private part<Part extends HTMLElement>(id: string): Part {
    return document.getElementById(id) as Part;
  }

  private get fit(): Fit | undefined {
    return this.editor.constraints.fit;
  }

  private get unit(): number {
    return 1 / (this.editor.shape?.scale ?? 1);
  }

  private start(kind: FitKind): number {
    return Number((usual[kind] * (kind === 'weight' ? 1 : this.unit)).toPrecision(3));
  }

  private range(kind: FitKind): number[] {
    return ranges[kind].map((end) => end * (kind === 'weight' ? 1 : this.unit));
  }

  private fromSlider(): number {
    const [least, most] = this.range(this.fit!.kind);
    return Number((least * (most / least) ** (this.slider.valueAsNumber / 1000)).toPrecision(3));
  }

  private get wanted(): Wanted {
    return this.kind.value === 'weight' ? weight : length;
  }

  private change(settings: Partial<FitSettings>): void {
    const { fit, editor } = this;
    if (!fit) return;
    const next = { ...fit, ...settings };
    editor.apply(`${titles[next.kind]} ${short(next.value)}`, { ...editor.constraints, fit: next });
  }
}

function figures({ name, bytes, positions }: Cloud, report: Report | null, { kind, value, outliers }: Fit): string {
  const count = positions.length / 3;
  const said = [bytes ? `${name}: ${count.toLocaleString('en')} points` : `Its own ${count.toLocaleString('en')} nodes`];
  if (report?.fit) said.push(`at most ${short(report.fit.greatest)} away, root mean square ${short(report.fit.rms)}`);
  if (report?.fit?.smoothingLength && kind !== 'smoothingLength') said.push(`smoothing length ${short(report.fit.smoothingLength)}`);
  if (report?.distances && kind === 'within') said.push(`${short((100 * report.distances.filter((distance) => distance > value).length) / count)} % outside`);
  else if (report?.fit && outliers > 0) said.push(`${report.fit.outliers.toLocaleString('en')} left out`);
  return said.join(' · ');
}
