// Discs at nodes: held ones, picked ones, and the one under the pointer.

import { BufferAttribute, BufferGeometry, Points, type Color } from 'three';
import { markerMaterial } from './materials';

class Group {
  readonly points = new Points(new BufferGeometry(), markerMaterial());
  private nodes: ArrayLike<number> = [];

  constructor(private readonly size: number, rimWidth: number, lift: number) {
    const { uniforms } = this.points.material;
    uniforms.rimWidth.value = rimWidth;
    uniforms.lift.value = lift;
    this.set([], new Float32Array());
  }

  set(nodes: ArrayLike<number>, places: Float32Array): void {
    this.nodes = nodes;
    this.points.geometry.dispose();
    this.points.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(3 * nodes.length), 3));
    this.points.visible = nodes.length > 0;
    this.move(places);
  }

  move(places: Float32Array): void {
    const at = this.points.geometry.getAttribute('position');
    for (let k = 0; k < this.nodes.length; ++k) {
      const node = 3 * this.nodes[k];
      at.setXYZ(k, places[node], places[node + 1], places[node + 2]);
    }
    at.needsUpdate = true;
  }

  scale(ratio: number, spacing: number): void {
    const size = this.nodes.length > 50 ? Math.max(3, Math.min(this.size, 0.7 * spacing)) : this.size;
    this.points.material.uniforms.size.value = size * ratio;
  }

  colours(inside: Color, rim: Color): void {
    this.points.material.uniforms.inside.value = inside;
    this.points.material.uniforms.rim.value = rim;
  }
}

export type MarkerKind = 'held' | 'picked' | 'hovered';

export class Markers {
  private readonly groups: Record<MarkerKind, Group> = { held: new Group(7, 0.3, 0.004), picked: new Group(11, 0.3, 0.006), hovered: new Group(12, 0.35, 0.007) };
  private places: Float32Array = new Float32Array();

  get objects(): Points[] {
    return Object.values(this.groups).map((group) => group.points);
  }

  set(which: MarkerKind, nodes: ArrayLike<number>): void {
    this.groups[which].set(nodes, this.places);
  }

  move(places: Float32Array): void {
    this.places = places;
    for (const group of Object.values(this.groups)) group.move(places);
  }

  /** Nothing is marked: another surface has other nodes. */
  clear(): void {
    for (const group of Object.values(this.groups)) group.set([], this.places);
  }

  /** ratio: of pixels of the picture to those of the page. spacing: of nodes, in pixels of the page; where many are marked, discs leave gaps. */
  scale(ratio: number, spacing: number): void {
    for (const group of Object.values(this.groups)) group.scale(ratio, spacing);
  }

  restyle(colour: (name: string) => Color): void {
    this.groups.held.colours(colour('--held'), colour('--halo'));
    this.groups.picked.colours(colour('--accent'), colour('--halo'));
    this.groups.hovered.colours(colour('--halo'), colour('--accent'));
  }
}
