// Shaders: surfaces as in the page of --html, markers as discs.

import { Color, DoubleSide, GLSL3, ShaderMaterial, Vector2, Vector3 } from 'three';
import { fragmentShader, usualLamps } from '../../../page/shaders.js';
import { fieldNames } from './fields';

const vertexShader = `
in float value;
out vec3 place;
out vec3 facing;
out float height;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = mat3(modelViewMatrix) * position;  // relative to the middle of the shape, so lamps stay with it when the view
                                             // moves
  facing = normalMatrix * normal;
  height = value;
  gl_Position = projectionMatrix * seen;
}`;

export const looks = ['wire', 'shaded', 'zebra', ...fieldNames] as const;
export type Look = (typeof looks)[number];

/** What the fragment shader calls a kind. */
export function kindOf(look: Look): number {
  return Math.min(3, looks.indexOf(look));
}

/** Reflection lines: how many lamps are around the surface, and by how much they are turned in the view, in radians; upright at 0. */
export interface Lamps {
  count: number;
  turn: number;
}

export function surfaceMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    // three.js writes the version line itself.
    fragmentShader: fragmentShader.replace(/^#version.*/, ''),
    uniforms: {
      kind: { value: 1 }, colour: { value: new Color() }, range: { value: new Vector2(0, 1) }, stops: { value: Array.from({ length: 9 }, () => new Vector3()) },
      // At a distance of the shape's size.
      nearness: { value: 1 }, lamps: { value: usualLamps }, across: { value: new Vector2(1, 0) },
    },
    side: DoubleSide,
    // Lines on the surface are drawn before it.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 2,
  });
}

/** size: in pixels. rim: a ring of the second colour around the disc, as a share of its radius. coloured: discs have colours of their own. */
export function markerMaterial(coloured = false): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexColors: coloured,
    transparent: true,
    depthWrite: false,
    uniforms: { size: { value: 8 }, inside: { value: new Color() }, rim: { value: new Color() }, rimWidth: { value: 0.25 }, lift: { value: 0.004 } },
    vertexShader: `
uniform float size;
uniform float lift;
uniform vec3 inside;
out vec3 disc;
void main() {
#ifdef USE_COLOR
  disc = color;
#else
  disc = inside;
#endif
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0) + vec4(0.0, 0.0, lift, 0.0));
  gl_PointSize = size;
}`,
    fragmentShader: `
in vec3 disc;
uniform vec3 rim;
uniform float rimWidth;
out vec4 result;
void main() {
  float radius = 2.0 * length(gl_PointCoord - 0.5);
  float soft = fwidth(radius);
  result = vec4(mix(disc, rim, smoothstep(-soft, soft, radius - 1.0 + rimWidth)), 1.0 - smoothstep(1.0 - 2.0 * soft, 1.0, radius));
}`,
  });
}
