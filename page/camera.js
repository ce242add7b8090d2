// The view of a shape: a rotation, a place in the middle, and a zoom. Parallel projection.

const product = (a, b) => a.map((row) => [0, 1, 2].map((k) => row[0] * b[0][k] + row[1] * b[1][k] + row[2] * b[2][k]));

export class Camera {
  // rows: the directions to the right, up and towards the eye. positions: of the shapes. margin: size of the view
  // relative to the shapes. part: what is seen first; null: all.
  constructor(rows, positions, margin, changed, part) {
    const [across, up] = rows.map((row) => {
      let most = 1e-3;
      for (const points of positions)
        for (let k = 0; k < points.length; k += 3)
          most = Math.max(most, Math.abs(row[0] * points[k] + row[1] * points[k + 1] + row[2] * points[k + 2]));
      return 2 * margin * most;
    });
    this.extents = [across, up];
    this.changed = changed;
    this.all = {rows, middle: [0, 0, 0], zoom: 1};
    this.home = part ? {rows, middle: part.middle, zoom: Math.min(...this.extents.map((side, i) => side / part.extents[i]))} : this.all;
    // The breadth of what is seen first.
    this.breadth = Math.max(...this.extents) / this.home.zoom;
    this.show(this.home);
  }

  // Shows the first view, or all.
  show(place) {
    Object.assign(this, place);
    this.changed();
  }

  // Turns by angles about the axes of the view, radians.
  turn(across, up) {
    const [c, s, d, t] = [Math.cos(across), Math.sin(across), Math.cos(up), Math.sin(up)];
    this.rows = product(product([[1, 0, 0], [0, d, -t], [0, t, d]], [[c, 0, s], [0, 1, 0], [-s, 0, c]]), this.rows);
    this.changed();
  }

  // Moves by shares of the height of the view.
  move(across, up) {
    const step = this.extents[1] / this.zoom;
    this.middle = this.middle.map((part, i) => part - step * (across * this.rows[0][i] + up * this.rows[1][i]));
    this.changed();
  }

  magnify(factor) {
    this.zoom = Math.min(1e4, Math.max(0.05, this.zoom * factor));
    this.changed();
  }

  // Pixels per unit in a view of that many pixels.
  scale(width, height) {
    return this.zoom * Math.min(width / this.extents[0], height / this.extents[1]);
  }
}

// Lets pointer, wheel and keys at an element move the camera.
export function steer(element, camera, onSpace) {
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  for (const end of ['pointerup', 'pointercancel'])
    element.addEventListener(end, (event) => pointers.delete(event.pointerId));
  element.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const height = element.clientHeight;
    const across = (event.clientX - last.x) / height;
    const up = (last.y - event.clientY) / height;
    const before = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (pointers.size === 2) {
      if (before > 0) camera.magnify(spread() / before);
      camera.move(across / 2, up / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      camera.move(across, up);
    } else {
      camera.turn(3 * across, -3 * up);
    }
  });
  element.addEventListener('wheel', (event) => {
    event.preventDefault();
    camera.magnify(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
  }, {passive: false});
  element.addEventListener('keydown', (event) => {
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (arrows[event.key]) {
      const [across, up] = arrows[event.key];
      if (event.shiftKey) camera.move(0.05 * across, 0.05 * up);
      else camera.turn(0.1 * across, -0.1 * up);
    } else if (event.key === '+' || event.key === '=') camera.magnify(1.2);
    else if (event.key === '-') camera.magnify(1 / 1.2);
    else if (event.key === '0' || event.key === 'Home') camera.show(camera.home);
    else if (event.key === ' ') onSpace();
    else return;
    event.preventDefault();
  });
}
