// Between places in units of the file and points of the canvas.

import { Vector3, type Camera } from 'three';
import type { Vector } from '../base/vectors';
import type { Shape } from '../shape/shape';

interface Canvas {
  clientWidth: number;
  clientHeight: number;
}

type Frame = Pick<Shape, 'centre' | 'scale'>;

/** From the view towards whoever looks at it. */
export function towards(camera: Camera): Vector {
  camera.updateMatrixWorld();
  return new Vector3().setFromMatrixColumn(camera.matrixWorld, 2).toArray();
}

/** In the plane through the origin across the normal; null where that is seen from its edge. For cameras without perspective. */
export function placeAt(camera: Camera, canvas: Canvas, { centre, scale }: Frame, x: number, y: number, normal: Vector): Vector | null {
  const along = new Vector3(...towards(camera));
  const across = new Vector3(...normal);
  if (Math.abs(along.dot(across)) < 0.05) return null;
  const place = new Vector3((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight, 0).unproject(camera).divideScalar(scale).add(new Vector3(...centre));
  place.addScaledVector(along, -place.dot(across) / along.dot(across));
  return place.toArray().map((part, i) => (Math.abs(normal[i]) === 1 ? 0 : part)) as Vector;
}

export function pixelOf(camera: Camera, canvas: Canvas, { centre, scale }: Frame, place: Vector): [number, number] {
  camera.updateMatrixWorld();
  const { x, y } = new Vector3(...place).sub(new Vector3(...centre)).multiplyScalar(scale).project(camera);
  return [(x / 2 + 0.5) * canvas.clientWidth, (0.5 - y / 2) * canvas.clientHeight];
}
