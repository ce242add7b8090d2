// Draws a surface with WebGL 2.

import {fragmentShader, usualLamps, vertexShader} from './shaders.js';
import {styleColour} from './colours.js';

const dotColour = [0.78, 0.27, 0.12];
const kinds = {shaded: 1, wire: 0, zebra: 2, mean: 3, gaussian: 3, deviation: 3};

function programOf(gl) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

export class SurfaceView {
  // shapes: positions, normals, triangles, edges. points: coordinates of dots shown with shaded faces. Throws if the
  // browser has no WebGL 2.
  constructor(canvas, shapes, points) {
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext('webgl2', {antialias: true});
    if (!gl) throw new Error('This browser has no WebGL 2, which the view needs. Charts and figures are below.');
    this.program = programOf(gl);
    this.places = Object.fromEntries(['turn', 'middle', 'scale', 'lift', 'dot_size', 'kind', 'colour', 'stops', 'range', 'nearness', 'lamps', 'across']
      .map((name) => [name, gl.getUniformLocation(this.program, name)]));
    this.shapes = shapes.map((shape) => this.upload(shape));
    this.dots = this.uploadDots(points);
    this.values = {};
  }

  // Adds an attribute of vertices to the bound vertex array.
  attribute(name, size, data) {
    const gl = this.gl;
    const buffer = gl.createBuffer();
    const place = gl.getAttribLocation(this.program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    return buffer;
  }

  uploadDots(points) {
    const array = this.gl.createVertexArray();
    this.gl.bindVertexArray(array);
    this.attribute('position', 3, points);
    return {array, count: points.length / 3};
  }

  upload({positions, normals, triangles, edges}) {
    const gl = this.gl;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const indices = (data) => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, data, gl.STATIC_DRAW);
      return {buffer, count: data.length};
    };
    this.attribute('position', 3, positions);
    this.attribute('normal', 3, normals);
    const values = this.attribute('value', 1, new Float32Array(positions.length / 3));
    return {array, values, triangles: indices(triangles), edges: indices(edges)};
  }

  // Sets the values of a shape that a colour map shows.
  setValues(shape, values) {
    if (!values || this.values[shape] === values) return;
    this.values[shape] = values;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.shapes[shape].values);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, values, this.gl.STATIC_DRAW);
  }

  // colours: {map, range, values} of the modes that show values, else null.
  draw(camera, {shape, mode, colours}) {
    const gl = this.gl;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight].map((side) => Math.round(side * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
    if (colours) this.setValues(shape, colours.values[shape]);
    const paper = styleColour('--panel');
    gl.viewport(0, 0, width, height);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    const scale = 2 * camera.scale(width, height);
    gl.uniformMatrix3fv(this.places.turn, true, camera.rows.flat());
    gl.uniform3fv(this.places.middle, camera.middle);
    gl.uniform2f(this.places.scale, scale / width, scale / height);
    gl.uniform1f(this.places.lift, 0);
    gl.uniform1f(this.places.nearness, 1 / camera.breadth);
    gl.uniform1f(this.places.lamps, usualLamps);
    gl.uniform2f(this.places.across, 1, 0);  // upright
    gl.uniform1i(this.places.kind, kinds[mode]);
    gl.uniform3fv(this.places.colour, mode === 'wire' ? paper : [0.56, 0.66, 0.78]);
    if (colours) {
      gl.uniform3fv(this.places.stops, colours.map.flat());
      gl.uniform2fv(this.places.range, colours.range);
    }
    const {array, triangles, edges} = this.shapes[shape];
    const elements = (what, indices) => {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices.buffer);
      gl.drawElements(what, indices.count, gl.UNSIGNED_INT, 0);
    };
    gl.bindVertexArray(array);
    elements(gl.TRIANGLES, triangles);
    gl.uniform1i(this.places.kind, kinds.wire);
    gl.uniform1f(this.places.lift, 0.003 / Math.max(1, camera.zoom));
    if (mode === 'wire') {
      gl.uniform3fv(this.places.colour, styleColour('--ink'));
      elements(gl.LINES, edges);
    } else if (mode === 'shaded') {
      gl.uniform3fv(this.places.colour, dotColour);
      gl.uniform1f(this.places.dot_size, Math.max(2, width / 250));
      gl.bindVertexArray(this.dots.array);
      gl.drawArrays(gl.POINTS, 0, this.dots.count);
    }
  }
}
