// Shaders for the view of a surface.

export const vertexShader = `#version 300 es
uniform mat3 turn;
uniform vec3 middle;
uniform vec2 scale;
uniform float dot_size;  // of points, in pixels
uniform float lift;  // lifts lines and points towards the eye, so their faces do not hide them
in vec3 position;
in vec3 normal;
in float value;
out vec3 place;
out vec3 facing;
out float height;
void main() {
  vec3 seen = turn * (position - middle);
  gl_Position = vec4(seen.xy * scale, -0.2 * (seen.z + lift), 1.0);
  gl_PointSize = dot_size;
  place = seen;
  facing = turn * normal;
  height = value;
}`;

// The number of lamps of reflection lines.
export const usualLamps = 16;

// kind: 0 one colour; 1 shaded; 2 reflection lines; 3 the value by its colour, shaded a little.
export const fragmentShader = `#version 300 es
precision highp float;
uniform int kind;
uniform vec3 colour;
uniform vec3 stops[9];
uniform vec2 range;
uniform float nearness;  // one over the distance of the lamps of reflection lines
uniform float lamps;  // their number around the surface
uniform vec2 across;  // a unit vector across them, in the view
in vec3 place;
in vec3 facing;
in float height;
out vec4 result;

vec3 colour_of(float share) {
  float place = clamp(share, 0.0, 1.0) * 8.0;
  int k = min(int(place), 7);
  return mix(stops[k], stops[k + 1], place - float(k));
}

void main() {
  vec3 n = normalize(facing);
  // Surfaces are seen from both sides: the normal is that of the visible side.
  if (dot(n, cross(dFdx(place), dFdy(place))) < 0.0) n = -n;
  float towards = max(n.z, 0.0);  // at sharp edges a face may turn to the eye where its smoothed normal does not
  if (kind == 0) {
    result = vec4(colour, 1.0);
  } else if (kind == 1) {
    vec3 key = normalize(vec3(-0.5, 0.7, 0.8));
    float shine = pow(max(dot(n, normalize(key + vec3(0.0, 0.0, 1.0))), 0.0), 40.0);
    result = vec4(colour * (0.25 + 0.3 * towards + 0.5 * max(dot(n, key), 0.0)) + 0.2 * shine, 1.0);
  } else if (kind == 2) {
    // Long parallel lamps around the surface, mirrored towards the eye. They are near, so a plane mirrors several of
    // them, as straight lines.
    vec3 mirrored = reflect(vec3(0.0, 0.0, -1.0), n);
    float wave = cos(lamps * atan(dot(across, mirrored.xy + nearness * place.xy), mirrored.z));
    float soft = min(fwidth(wave), 1.0);
    float lamp = smoothstep(-soft, soft, wave);
    result = vec4(vec3(0.08 + 0.86 * lamp) * (0.75 + 0.25 * towards), 1.0);
  } else {
    float share = (height - range.x) / (range.y - range.x);
    result = vec4(colour_of(share) * (0.7 + 0.3 * towards), 1.0);
  }
}`;
