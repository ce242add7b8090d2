// The surface in the view: its triangles, its edges, and those that are sharp.

import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh, type Color } from 'three';
import type { Shape } from '../shape/shape';
import { partOf, setNormals, verticesOf, type Part, type Vertices } from '../shape/vertices';
import type { Field } from './fields';
import { kindOf, surfaceMaterial, type Lamps, type Look } from './materials';
import { loadSimplifier, simplified } from './simplify';

/** Triangles that are drawn in a picture's time without a graphics card. */
const quick = 8000;

export class SurfaceLayer {
  private readonly surface = new Mesh(new BufferGeometry(), surfaceMaterial());
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly features = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  readonly object = new Group().add(this.surface, this.lines, this.features);
  private vertices: Vertices | null = null;
  private triangles = new BufferAttribute(new Uint32Array(), 1);
  /** Those of a drag, where they are fewer; made when the first picture of one is drawn. */
  private fewer: { triangles: BufferAttribute; part: Part } | null = null;
  private look: Look = 'shaded';
  edges = false;
  private field: Field | null = null;

  /** software: there is no graphics card. */
  constructor(private readonly software: boolean) {
    if (software) loadSimplifier().catch((error: unknown) => console.warn('Pictures of a drag have all triangles:', error));
  }

  open(shape: Shape): void {
    this.features.visible = !shape.curve;
    this.vertices = null;
    this.field = null;
  }

  /** settled: what is sharp is looked for anew, which a shape that changes many times a second does without; it may have fewer triangles, too. */
  show(shape: Shape, places: Float32Array, settled: boolean): void {
    if (settled || !this.vertices) this.split(shape, places);
    else if (this.software && !this.fewer) this.simplify();
    const fewer = settled ? null : this.fewer;
    const { geometry } = this.surface;
    geometry.setIndex(fewer?.triangles ?? this.triangles);
    const { nodes } = this.vertices!;
    const { position, normal } = geometry.attributes;
    const count = fewer ? fewer.part.vertices.length : nodes.length;
    for (let k = 0; k < count; ++k) {
      const v = fewer ? fewer.part.vertices[k] : k;
      for (let i = 0; i < 3; ++i) position.array[3 * v + i] = places[3 * nodes[v] + i];
    }
    setNormals(normal.array as Float32Array, shape.faces.nodes, shape.sides, this.vertices!, places, fewer?.part);
    position.needsUpdate = normal.needsUpdate = true;
    const ends = this.lines.geometry.getAttribute('position');
    (ends.array as Float32Array).set(places);
    ends.needsUpdate = true;
    this.colour();
  }

  setField(field: Field | null): void {
    this.field = field;
  }

  setLook(look: Look): void {
    this.look = look;
  }

  setLamps({ count, turn }: Lamps): void {
    const { lamps, across } = this.surface.material.uniforms;
    lamps.value = count;
    across.value.set(Math.cos(turn), Math.sin(turn));
  }

  restyle(colour: (name: string) => Color): void {
    const { kind, colour: fill } = this.surface.material.uniforms;
    // Until its values have come, a surface is shaded.
    kind.value = kindOf(kindOf(this.look) === 3 && !this.field ? 'shaded' : this.look);
    fill.value = colour(this.look === 'wire' ? '--stage' : '--surface');
    this.lines.material.color = colour('--wire');
    this.features.material.color = colour('--feature');
    this.lines.visible = this.look === 'wire' || this.edges;
    this.colour();
  }

  private colour(): void {
    if (!this.field || !this.vertices) return;
    const { range, map, values } = this.field;
    const { uniforms } = this.surface.material;
    uniforms.range.value.set(...range);
    map.forEach((colour, k) => uniforms.stops.value[k].set(...colour));
    const heights = this.surface.geometry.getAttribute('value');
    const { nodes } = this.vertices;
    for (let v = 0; v < nodes.length; ++v) heights.setX(v, values[nodes[v]]);
    heights.needsUpdate = true;
  }

  private split(shape: Shape, places: Float32Array): void {
    const vertices = (this.vertices = verticesOf(shape.faces, places, shape.edges));
    const count = vertices.nodes.length;
    for (const object of [this.surface, this.lines, this.features]) object.geometry.dispose();
    this.triangles = new BufferAttribute(shape.triangleCorners.map((corner) => vertices.corners[corner]), 1);
    this.fewer = null;
    this.surface.geometry = new BufferGeometry().setIndex(this.triangles);
    for (const [name, size] of [['position', 3], ['normal', 3], ['value', 1]] as const)
      this.surface.geometry.setAttribute(name, new BufferAttribute(new Float32Array(size * count), size));
    const ends = new BufferAttribute(new Float32Array(places.length), 3);
    this.lines.geometry = new BufferGeometry().setIndex(new BufferAttribute(shape.edges.ends, 1)).setAttribute('position', ends);
    this.features.geometry = new BufferGeometry().setIndex(new BufferAttribute(vertices.features, 1)).setAttribute('position', ends);
  }

  private simplify(): void {
    const all = this.triangles.array as Uint32Array;
    if (all.length <= 3 * quick) return;
    const triangles = simplified(all, this.surface.geometry.getAttribute('position').array as Float32Array, quick);
    if (triangles) this.fewer = { triangles: new BufferAttribute(triangles, 1), part: partOf(triangles, this.vertices!) };
  }
}
