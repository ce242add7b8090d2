// Documents to open by name: recent ones, and shapes to try. The latter are files of examples/, with their constraints
// unless only the boundary is held.

import type { About } from '../edit/slots';

interface Example {
  title: string;
  file: string;
  /** A constraints file. */
  constraints?: string;
  /** What it is drawn towards, with the weight of the paper's figure. */
  points?: string;
}

const groups: { title: string; examples: Example[] }[] = [
  { title: 'Surfaces', examples: [
    { title: 'Annulus', file: 'annulus.obj' },
    { title: 'Pipe blend', file: 'pipe-blend.obj' },
    { title: 'Noisy saddle', file: 'saddle.ply' },
    { title: 'Spot without horns', file: 'spot.obj', constraints: 'spot-horns.json' },
  ] },
  { title: 'Curves', examples: [
    { title: 'Aerofoil NACA 2412', file: 'naca-2412.dat', constraints: 'naca-2412.json' },
    { title: 'Noisy wave', file: 'wave.csv', constraints: 'wave.json' },
    { title: 'Noisy trefoil knot', file: 'trefoil.obj', constraints: 'trefoil.json' },
  ] },
  { title: 'Lines to span with a surface', examples: [
    { title: 'Hull', file: 'hull-lines.obj', constraints: 'all-held.json' },
    { title: 'Bonnet', file: 'bonnet-lines.obj', constraints: 'all-held.json' },
    { title: 'Bottle', file: 'bottle-lines.obj', constraints: 'all-held.json' },
  ] },
  { title: 'Figures of the paper', examples: [
    { title: 'Fig. 8(B): positions held', file: 'figure-8.obj' },
    { title: 'Fig. 8(C): normals too', file: 'figure-8.obj', constraints: 'smooth-ends.json' },
    { title: 'Fig. 9: from noise', file: 'figure-9.obj', constraints: 'level-ends.json' },
    { title: 'Fig. 10: three pipes', file: 'figure-10.obj', constraints: 'smooth-ends.json' },
    { title: 'Fig. 12: to points', file: 'figure-12.obj', points: 'figure-12.xyz' },
  ] },
];

export interface ExampleEvents {
  /** Addresses of a shape, of its constraints and of points. */
  open: (file: string, constraints?: string, points?: string) => void;
  reopen: (slot: string) => void;
  /** All that is kept but what is open. */
  forget: () => void;
}

const forget = 'forget';

function saidOf({ name, step, time }: About): string {
  return [name, step, new Date(time).toLocaleString('en', { day: 'numeric', month: 'short', hour: '2-digit', minute: '2-digit', hour12: false })].filter(Boolean).join(' · ');
}

export class Examples {
  private readonly all = groups.flatMap(({ examples }) => examples);
  private readonly recent = Object.assign(document.createElement('optgroup'), { label: 'Recent', hidden: true });

  constructor(private readonly menu: HTMLSelectElement, events: ExampleEvents) {
    menu.append(this.recent);
    let number = 0;
    for (const { title, examples } of groups) {
      const group = Object.assign(document.createElement('optgroup'), { label: title });
      group.append(...examples.map((example) => new Option(example.title, String(number++))));
      menu.append(group);
    }
    menu.addEventListener('change', () => {
      const example = this.all[Number(menu.value)];
      if (!example) {
        if (menu.value === forget) events.forget();
        else events.reopen(menu.value);
        menu.value = '';
        return;
      }
      const { file, constraints, points } = example;
      events.open(`examples/${file}`, constraints && `examples/${constraints}`, points && `examples/${points}`);
    });
  }

  /** What is kept, the newest first. */
  list(recent: readonly About[]): void {
    const { value } = this.menu;
    const options = recent.map((about) => new Option(saidOf(about), about.slot));
    this.recent.hidden = recent.length === 0;
    this.recent.replaceChildren(...options, ...(options.length > 0 ? [new Option('Forget those that are not open', forget)] : []));
    this.menu.value = value;
  }

  /** name: of the example that is open; null: what is open is none. */
  opened(name: string | null): void {
    if (name !== null && this.all[Number(this.menu.value || -1)]?.file === name) return;
    const number = this.all.findIndex(({ file }) => file === name);
    this.menu.value = number < 0 ? '' : String(number);
  }
}
