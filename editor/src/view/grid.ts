// A grid in units of the file in the plane z = 0, to draw on.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from 'three';
import { nothing } from '../shape/shape';

const lines = 30;  // on either side of the origin

export function gridOfUnits(): LineSegments<BufferGeometry, LineBasicMaterial> {
  const ends: number[] = [];
  for (let k = -lines; k <= lines; ++k) ends.push(k, -lines, 0, k, lines, 0, -lines, k, 0, lines, k, 0);
  const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(ends, (end) => end * nothing.scale), 3));
  return new LineSegments(geometry, new LineBasicMaterial());
}
