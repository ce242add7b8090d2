// Decodes the data that the program puts into the page: see cli/page_bytes.cpp.

export function jsonOf(id) {
  return JSON.parse(document.getElementById(id).textContent);
}

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Three bytes a coordinate, 0 to 2^24 − 1 over the box; here −½ to ½.
function coordinatesOf(bytes) {
  const coordinates = new Float32Array(bytes.length / 3);
  for (let i = 0; i < coordinates.length; ++i)
    coordinates[i] = (bytes[3 * i] | bytes[3 * i + 1] << 8 | bytes[3 * i + 2] << 16) / 0xffffff - 0.5;
  return coordinates;
}

function doublesOf(bytes) {
  const view = new DataView(bytes.buffer);
  return Float64Array.from({length: bytes.length / 8}, (_, i) => view.getFloat64(8 * i, true));
}

function halvesOf(bytes) {
  return Float32Array.from({length: bytes.length / 2}, (_, i) => {
    const bits = bytes[2 * i] | bytes[2 * i + 1] << 8;
    const exponent = bits >> 10 & 31;
    const mantissa = bits & 1023;
    const size = exponent === 0 ? mantissa * 2 ** -24 : (1024 + mantissa) * 2 ** (exponent - 25);
    return bits & 0x8000 ? -size : size;
  });
}

// Faces or chains: the number of nodes, unless all are equal, then the step from each node to the next, as zigzag
// varints.
function runsOf(bytes, length) {
  const begin = [0];
  const nodes = [];
  let at = 0;
  const next = () => {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  };
  for (let node = 0; at < bytes.length;) {
    for (let left = length || next(); left > 0; --left) {
      const step = next();
      node += step % 2 ? -(step + 1) / 2 : step / 2;
      nodes.push(node);
    }
    begin.push(nodes.length);
  }
  return {begin: Uint32Array.from(begin), nodes: Uint32Array.from(nodes)};
}

export function sceneOf(json) {
  const surface = json.kind === 'surface';
  const first = json.shapes[0];
  const runs = runsOf(bytesOf(first.runs), first.length);
  const shapes = json.shapes.map((shape) => ({
    title: shape.title,
    positions: surface ? coordinatesOf(bytesOf(shape.nodes)) : doublesOf(bytesOf(shape.nodes)),
    runs: shape === first || !shape.runs ? runs : runsOf(bytesOf(shape.runs), shape.length),
    closed: shape.closed,
    mean: surface ? halvesOf(bytesOf(shape.mean)) : null,
    gaussian: surface ? halvesOf(bytesOf(shape.gaussian)) : null,
    deviation: shape.deviation ? halvesOf(bytesOf(shape.deviation)) : null,
  }));
  return {...json, surface, shapes, points: json.points ? Float32Array.from(doublesOf(bytesOf(json.points))) : new Float32Array()};
}
