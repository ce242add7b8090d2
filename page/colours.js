// Perceptually uniform colour maps, safe for the colour-blind, as nine points each.

const hex = (text) => text.split(' ').map((code) => [0, 2, 4].map((i) => parseInt(code.slice(i, i + 2), 16) / 255));

// viridis, Stéfan van der Walt and Nathaniel Smith 2015 (matplotlib, CC0).
export const sequential = hex('440154 472d7b 3b528b 2c728e 21908c 27ad81 5dc863 aadc32 fde725');

// PuOr, Cynthia Brewer (colorbrewer2.org, Apache 2), reversed: violet below, orange above.
export const diverging = hex('542788 8073ac b2abd2 d8daeb f7f7f7 fee0b6 fdb863 e08214 b35806');

export function gradientOf(map) {
  const css = map.map((colour) => `rgb(${colour.map((part) => Math.round(255 * part)).join(' ')})`);
  return `linear-gradient(to right, ${css.join(', ')})`;
}

// A named colour of the style sheet, as three parts.
export function styleColour(name) {
  return hex(getComputedStyle(document.documentElement).getPropertyValue(name).trim().slice(1))[0];
}
