// A curve in the view: its polygon, its nodes, and the hairs of its curvature comb.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Points, type Color, type Object3D } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { markerMaterial } from './materials';

const mostDots = 1000;  // more would hide the curve

export class CurveLayer {
  private readonly line = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 2 }));
  private readonly dots = new Points(new BufferGeometry(), markerMaterial());
  private readonly hairs = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.55 }));
  private readonly envelope = new LineSegments(new BufferGeometry(), new LineBasicMaterial());

  /** Behind, of another shape to compare with, it is thin. nodes: whether they are shown. colour: of the line. */
  constructor(behind = false, private readonly nodes = !behind, private readonly colour = behind ? '--quiet' : '--curve') {
    if (behind) this.line.material.linewidth = 1;
    this.dots.material.uniforms.rimWidth.value = 0;
    this.dots.material.uniforms.lift.value = 0.001;
    this.show(new Float32Array(), []);
  }

  get objects(): Object3D[] {
    return [this.hairs, this.envelope, this.line, this.dots];
  }

  /** ends: of the edges, two nodes each. */
  show(places: Float32Array, ends: ArrayLike<number>): void {
    const segments = new Float32Array(3 * ends.length);
    for (let k = 0; k < ends.length; ++k) for (let i = 0; i < 3; ++i) segments[3 * k + i] = places[3 * ends[k] + i];
    this.line.visible = ends.length > 0;
    // Made anew, as a geometry cannot change its number of segments.
    this.line.geometry.dispose();
    this.line.geometry = new LineSegmentsGeometry();
    if (this.line.visible) this.line.geometry.setPositions(segments);
    this.dots.visible = this.nodes && places.length > 0 && places.length / 3 <= mostDots;
    replace(this.dots, this.dots.visible ? places.slice() : new Float32Array());
  }

  /** Ends of lines, six numbers each. */
  setComb(hairs: Float32Array, envelope: Float32Array): void {
    for (const [object, ends] of [[this.hairs, hairs], [this.envelope, envelope]] as const) {
      object.visible = ends.length > 0;
      replace(object, ends);
    }
  }

  /** ratio: of pixels of the picture to those of the page. dots: of these, how large nodes are. */
  scale(ratio: number, dots = 4.5): void {
    this.dots.material.uniforms.size.value = dots * ratio;
  }

  restyle(colour: (name: string) => Color): void {
    this.line.material.color = colour(this.colour);
    this.dots.material.uniforms.inside.value = this.dots.material.uniforms.rim.value = colour('--curve');
    this.hairs.material.color = this.envelope.material.color = colour('--comb');
  }
}

function replace(object: Points | LineSegments, places: Float32Array): void {
  object.geometry.dispose();
  object.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(places, 3));
}
