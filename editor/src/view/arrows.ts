// Arrows at nodes whose normals are held, as long everywhere in the view.

import { BufferAttribute, ConeGeometry, CylinderGeometry, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, type BufferGeometry, type Color } from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import type { Vector } from '../base/vectors';
import { hides, projected, type Seen } from './seen';

/** Of the height of the view. */
const length = 0.09;
const most = 3000;

/** Along z, of length one; the head is its last quarter. */
function arrow(): BufferGeometry {
  const shaft = new CylinderGeometry(0.014, 0.014, 0.8, 8, 1, true).translate(0, 0.4, 0);
  const head = new ConeGeometry(0.06, 0.26, 12).translate(0, 0.87, 0);
  return mergeGeometries([shaft, head]).rotateX(Math.PI / 2);
}

export class Arrows {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private nodes: number[] = [];
  private places: Float32Array = new Float32Array();

  constructor() {
    const geometry = new InstancedBufferGeometry();
    const { index, attributes } = arrow();
    geometry.setIndex(index).setAttribute('position', attributes.position as BufferAttribute).setAttribute('normal', attributes.normal as BufferAttribute);
    for (const [name, size] of [['place', 3], ['direction', 3], ['marked', 1]] as const) geometry.setAttribute(name, new InstancedBufferAttribute(new Float32Array(size * most), size));
    geometry.instanceCount = 0;
    this.object = new Mesh(geometry, new ShaderMaterial({
      glslVersion: GLSL3,
      uniforms: { size: { value: 1 }, plain: { value: null }, strong: { value: null } },
      vertexShader: `
uniform float size;
in vec3 place;
in vec3 direction;
in float marked;
out float strength;
out vec3 facing;
void main() {
  vec3 side = normalize(cross(direction, abs(direction.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  mat3 frame = mat3(side, cross(direction, side), direction);
  float width = 1.0 + 0.6 * marked;
  strength = marked;
  facing = normalMatrix * frame * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place + size * frame * (position * vec3(width, width, 1.0)), 1.0);
}`,
      fragmentShader: `
uniform vec3 plain;
uniform vec3 strong;
in float strength;
in vec3 facing;
out vec4 result;
void main() {
  result = vec4(mix(plain, strong, strength) * (0.7 + 0.3 * max(normalize(facing).z, 0.0)), 1.0);
}`,
    }));
  }

  /** marked: nodes that stand out, and are drawn in any case where there are very many. */
  set(normals: ReadonlyMap<number, Vector>, marked: ReadonlySet<number>): void {
    const first = [...marked].filter((node) => normals.has(node));
    const rest = [...normals.keys()].filter((node) => !marked.has(node));
    const step = Math.max(1, rest.length / Math.max(1, most - first.length));
    for (let k = 0; k < rest.length; k += step) first.push(rest[Math.floor(k)]);
    this.nodes = first.slice(0, most);
    const { direction, marked: strength } = this.object.geometry.attributes;
    this.nodes.forEach((node, k) => {
      direction.setXYZ(k, ...normals.get(node)!);
      strength.setX(k, marked.has(node) ? 1 : 0);
    });
    direction.needsUpdate = strength.needsUpdate = true;
    this.object.geometry.instanceCount = this.nodes.length;
    this.object.visible = this.nodes.length > 0;
    this.move(this.places);
  }

  move(places: Float32Array): void {
    this.places = places;
    const { place } = this.object.geometry.attributes;
    this.nodes.forEach((node, k) => place.setXYZ(k, places[3 * node], places[3 * node + 1], places[3 * node + 2]));
    place.needsUpdate = true;
  }

  /** zoom: of a camera whose view is two units high at one. */
  scale(zoom: number): void {
    this.object.material.uniforms.size.value = (2 * length) / zoom;
  }

  restyle(colour: (name: string) => Color): void {
    Object.assign(this.object.material.uniforms, { plain: { value: colour('--held') }, strong: { value: colour('--accent') } });
  }

  /** Pixels. */
  static lengthIn(height: number): number {
    return length * height;
  }

  /** The node whose arrow has its head within so many pixels of a point, or -1. */
  pick(seen: Seen, x: number, y: number, radius: number): number {
    const { place, direction } = this.object.geometry.attributes;
    const size = this.object.material.uniforms.size.value as number;
    const heads = new Float32Array(3 * this.nodes.length);
    for (let k = 0; k < heads.length; ++k) heads[k] = place.array[k] + 0.87 * size * direction.array[k];
    const screen = projected({ ...seen, places: heads });
    const near = this.nodes
      .map((node, k) => ({ node, at: screen.subarray(3 * k, 3 * k + 3), distance: Math.hypot(screen[3 * k] - x, screen[3 * k + 1] - y) }))
      .filter(({ distance }) => distance <= radius)
      .sort((a, b) => a.distance - b.distance)
      .slice(0, 8);
    if (near.length === 0) return -1;
    const all = projected(seen);
    return near.find(({ node, at }) => !hides(all, seen.triangles, at, node, 1e-4))?.node ?? -1;
  }
}
