// What the graphics card does: shading and reflection lines as in the page of --html, markers as discs.

import { Color, DoubleSide, GLSL3, ShaderMaterial } from 'three';

const vertexShader = `
out vec3 place;
out vec3 facing;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = seen.xyz;
  facing = normalMatrix * normal;
  gl_Position = projectionMatrix * seen;
}`;

const fragmentShader = `
uniform int kind;  // 0 one colour; 1 shaded; 2 reflection lines
uniform vec3 colour;
in vec3 place;
in vec3 facing;
out vec4 result;
void main() {
  vec3 n = normalize(facing);
  // A surface is seen from both sides: the normal is on that of the face that is seen.
  if (dot(n, cross(dFdx(place), dFdy(place))) < 0.0) n = -n;
  float towards = max(n.z, 0.0);
  if (kind == 0) {
    result = vec4(colour, 1.0);
  } else if (kind == 1) {
    vec3 key = normalize(vec3(-0.5, 0.7, 0.8));
    float shine = pow(max(dot(n, normalize(key + vec3(0.0, 0.0, 1.0))), 0.0), 48.0);
    result = vec4(colour * (0.32 + 0.28 * towards + 0.5 * max(dot(n, key), 0.0)) + 0.12 * shine, 1.0);
  } else {
    // Long parallel lamps around the surface, upright in the view, as mirrored towards the eye.
    vec3 mirrored = reflect(vec3(0.0, 0.0, -1.0), n);
    float wave = cos(16.0 * atan(mirrored.x, mirrored.z));
    float soft = min(fwidth(wave), 1.0);
    float lamp = smoothstep(-soft, soft, wave);
    result = vec4(vec3(0.08 + 0.86 * lamp) * (0.75 + 0.25 * towards), 1.0);
  }
}`;

export const looks = ['wire', 'shaded', 'zebra'] as const;
export type Look = (typeof looks)[number];

export function surfaceMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    uniforms: { kind: { value: 1 }, colour: { value: new Color() } },
    side: DoubleSide,
    // Lines on the surface are drawn before it.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 2,
  });
}

/** size: in pixels. rim: a ring of the second colour around the disc, as a share of its radius. */
export function markerMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    transparent: true,
    depthWrite: false,
    uniforms: { size: { value: 8 }, inside: { value: new Color() }, rim: { value: new Color() }, rimWidth: { value: 0.25 }, lift: { value: 0.004 } },
    vertexShader: `
uniform float size;
uniform float lift;
void main() {
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0) + vec4(0.0, 0.0, lift, 0.0));
  gl_PointSize = size;
}`,
    fragmentShader: `
uniform vec3 inside;
uniform vec3 rim;
uniform float rimWidth;
out vec4 result;
void main() {
  float radius = 2.0 * length(gl_PointCoord - 0.5);
  float soft = fwidth(radius);
  result = vec4(mix(inside, rim, smoothstep(-soft, soft, radius - 1.0 + rimWidth)), 1.0 - smoothstep(1.0 - 2.0 * soft, 1.0, radius));
}`,
  });
}
