// Scattered points, coloured by their distance from the shape.

import { BufferAttribute, BufferGeometry, Points, type Color } from 'three';
import { sequential } from '../../../page/colours.js';
import { markerMaterial } from './materials';

const most = 200_000;
/** Of more than these, rims would be all that is seen. */
const few = 5_000;

export class Dots {
  readonly object = new Points(new BufferGeometry(), markerMaterial(true));
  private plain: number[] = [0.5, 0.5, 0.5];
  private outside: number[] = [1, 0, 0];
  private shown: { places: Float32Array; distances: Float64Array | null; limit: number } | null = null;

  constructor() {
    this.object.renderOrder = -1;  // marks of nodes are seen upon them
  }

  /** distances: of all, in the units of the limit, which is where the colours end; points beyond it stand out. */
  set(places: Float32Array, distances: Float64Array | null, limit: number): void {
    this.shown = { places, distances, limit };
    this.object.visible = places.length > 0;
    const step = Math.max(1, Math.ceil(places.length / 3 / most));
    const count = Math.ceil(places.length / 3 / step);
    const [position, colour] = [new Float32Array(3 * count), new Float32Array(3 * count)];
    for (let k = 0; k < count; ++k) {
      position.set(places.subarray(3 * k * step, 3 * k * step + 3), 3 * k);
      colour.set(this.colourOf(distances ? distances[k * step] / limit : NaN), 3 * k);
    }
    this.object.material.uniforms.rimWidth.value = count > few ? 0 : 0.3;
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(position, 3)).setAttribute('color', new BufferAttribute(colour, 3));
  }

  restyle(colour: (name: string) => Color): void {
    this.plain = colour('--quiet').toArray();
    this.object.material.uniforms.rim.value = colour('--quiet');
    this.outside = colour('--alert').toArray();
    if (this.shown) this.set(this.shown.places, this.shown.distances, this.shown.limit);
  }

  /** ratio: of pixels of the picture to those of the page. */
  scale(ratio: number): void {
    this.object.material.uniforms.size.value = (this.object.material.uniforms.rimWidth.value > 0 ? 7 : 5) * ratio;
  }

  private colourOf(share: number): number[] {
    if (!(share >= 0)) return this.plain;
    if (share > 1 + 1e-6) return this.outside;
    const at = Math.min(7.999, 8 * share);
    const [low, high] = [sequential[Math.floor(at)], sequential[Math.floor(at) + 1]];
    return low.map((part: number, i: number) => part + (at % 1) * (high[i] - part));
  }
}
