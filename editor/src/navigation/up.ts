// Which way is up: as the shape seems to stand, or as chosen. The browser keeps the choice.

import type { Shape } from '../shape/shape';
import { guessedUp, ups, type Up } from '../shape/upright';

const key = 'vspring-up';

function kept(): string {
  try {
    return localStorage.getItem(key) ?? '';
  } catch {
    return '';  // if the browser stores nothing
  }
}

export class UpMenu {
  private guessed: Up = 'z';

  constructor(private readonly menu: HTMLSelectElement, chosen: (up: Up) => void) {
    menu.value = ups.find((up) => up === kept()) ?? '';
    menu.addEventListener('change', () => {
      try {
        localStorage.setItem(key, menu.value);
      } catch {
        // The choice then lasts as long as the page.
      }
      chosen(this.up);
    });
  }

  /** Another shape is open. Returns its up. */
  open(shape: Shape): Up {
    this.guessed = guessedUp(shape);
    this.menu.options[0].textContent = `seems ${this.guessed.toUpperCase()}`;
    return this.up;
  }

  get up(): Up {
    return ups.find((up) => up === this.menu.value) ?? this.guessed;
  }
}
