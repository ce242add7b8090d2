// Input and result side by side: left of a line the view shows the input.

import type { Color, Object3D } from 'three';
import { placesOf, type Shape } from '../shape/shape';
import type { Lamps, Look } from './materials';
import { SurfaceLayer } from './surface_layer';

export class Wipe {
  private readonly layer: SurfaceLayer;
  private shape: Shape | null = null;
  /** Where the line is, as a share of the free part of the view; null where there is none. */
  share: number | null = null;

  /** line: drawn over the view. */
  constructor(software: boolean, private readonly line: HTMLElement) {
    this.layer = new SurfaceLayer(software);
    this.layer.object.visible = false;
  }

  get object(): Object3D {
    return this.layer.object;
  }

  /** The input is prepared when it is first asked for. */
  set(share: number | null, shape: Shape | null): void {
    this.share = shape && !shape.curve ? share : null;
    if (this.share === null || shape === this.shape) return;
    this.shape = shape;
    this.layer.open(shape!);
    this.layer.show(shape!, placesOf(shape!, shape!.input), true);
  }

  setLamps(lamps: Lamps): void {
    this.layer.setLamps(lamps);
  }

  /** Colours are those of the result, so the input is shaded beside them. */
  restyle(look: Look, edges: boolean, colour: (name: string) => Color): void {
    this.layer.setLook(look);
    this.layer.edges = edges;
    this.layer.restyle(colour);
  }

  /** Calls left, for the pixels left of the line, with the input in place of the result. width: of the free part of the view. */
  paint(result: Object3D, width: number, left: (pixels: number) => void): void {
    const at = (this.share ?? 0) * width;
    this.line.hidden = this.share === null;
    this.line.style.left = `${at}px`;
    if (this.share === null || at < 1) return;
    result.visible = false;
    this.layer.object.visible = true;
    left(at);
    result.visible = true;
    this.layer.object.visible = false;
  }
}
