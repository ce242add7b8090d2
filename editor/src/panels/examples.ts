// Shapes to try, by name: files of examples/, and what holds them where it is not just the boundary.

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
  { title: 'Figures of the paper', examples: [
    { title: 'Fig. 8(B): positions held', file: 'figure-8.obj' },
    { title: 'Fig. 8(C): normals too', file: 'figure-8.obj', constraints: 'smooth-ends.json' },
    { title: 'Fig. 9: from noise', file: 'figure-9.obj', constraints: 'level-ends.json' },
    { title: 'Fig. 10: three pipes', file: 'figure-10.obj', constraints: 'smooth-ends.json' },
    { title: 'Fig. 12: to points', file: 'figure-12.obj', points: 'figure-12.xyz' },
  ] },
];

export class Examples {
  private readonly all = groups.flatMap(({ examples }) => examples);

  /** open: addresses of a shape, of its constraints and of points. */
  constructor(private readonly menu: HTMLSelectElement, open: (file: string, constraints?: string, points?: string) => void) {
    let number = 0;
    for (const { title, examples } of groups) {
      const group = Object.assign(document.createElement('optgroup'), { label: title });
      group.append(...examples.map((example) => new Option(example.title, String(number++))));
      menu.append(group);
    }
    menu.addEventListener('change', () => {
      const { file, constraints, points } = this.all[Number(menu.value)];
      open(`examples/${file}`, constraints && `examples/${constraints}`, points && `examples/${points}`);
    });
  }

  /** A file of that name is open: the menu shows the example that it may be. */
  opened(name: string): void {
    if (this.all[Number(this.menu.value || -1)]?.file === name) return;
    const number = this.all.findIndex(({ file }) => file === name);
    this.menu.value = number < 0 ? '' : String(number);
  }
}
