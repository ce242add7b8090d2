// Shapes that tests in JavaScript have in common.

// A unit sphere without its poles, of two reds, as PLY: its text, and the lines of its nodes.
export function openSphere() {
  const [rows, columns] = [13, 24];
  const lines = [];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const [latitude, longitude] = [(((row * 140) / (rows - 1) - 70) * Math.PI) / 180, (2 * Math.PI * column) / columns];
      lines.push(`${Math.cos(latitude) * Math.cos(longitude)} ${Math.cos(latitude) * Math.sin(longitude)} ${Math.sin(latitude)} ${row < 6 ? 10 : 200}`);
    }
  }
  const faces = [];
  const at = (row, column) => row * columns + (column % columns);
  for (let row = 0; row + 1 < rows; ++row) for (let column = 0; column < columns; ++column) faces.push(`4 ${at(row, column)} ${at(row, column + 1)} ${at(row + 1, column + 1)} ${at(row + 1, column)}`);
  const head = ['ply', 'format ascii 1.0', `element vertex ${lines.length}`, ...['x', 'y', 'z'].map((axis) => `property double ${axis}`), 'property uchar red', `element face ${faces.length}`, 'property list uchar int vertex_indices', 'end_header'];
  return { nodes: lines, text: `${[...head, ...lines, ...faces].join('\n')}\n` };
}
