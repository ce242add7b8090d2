// Draws curves with their curvature combs.

const longestTooth = 0.15;  // of the size of the curve, for the sharpest place of the last shape
const longestTeeth = 0.4;   // teeth of any shape are cut off there
const mostDots = 600;       // more nodes than this would hide the curve
const stretch = 500;        // points of one stroke, whose time is quadratic in them

// The points at least a pixel from the one before, and the last.
function apart(places) {
  let last = null;
  return Array.from(places.keys()).filter((k) => {
    const keep = !last || k === places.length - 1 || Math.hypot(places[k][0] - last[0], places[k][1] - last[1]) >= 1;
    if (keep) last = places[k];
    return keep;
  });
}

export class CurveView {
  // shapes: chains, see chainsOf(). part: what is seen first, to which the comb is scaled; null: all.
  constructor(canvas, shapes, {size: whole, leading, part}) {
    this.canvas = canvas;
    this.shapes = shapes;
    const size = this.size = part ? part.radius : whole;
    const seen = (point) => !part || Math.hypot(...part.middle.map((middle, i) => point[i] - middle)) <= part.radius;
    const sharpest = (chains) => chains.flatMap(({points, vectors}) => vectors.filter((vector, k) => vector && seen(points[k])))
      .reduce((most, vector) => Math.max(most, Math.hypot(...vector)), 0);
    // A straight curve gives no scale; then the sharpest of all does.
    const wanted = sharpest(shapes[leading]);
    this.tooth = wanted * size > 1e-6 ? longestTooth * size / wanted
      : longestTooth * size / Math.max(1e-6 / size, ...shapes.map(sharpest));
  }

  tip(chain, k, length) {
    const vector = chain.vectors[k];
    if (!vector) return chain.points[k];
    const most = longestTeeth * this.size;
    const tooth = vector.map((part) => part * this.tooth * length);
    const size = Math.hypot(...tooth);
    return chain.points[k].map((part, i) => part - tooth[i] * (size > most ? most / size : 1));
  }

  draw(camera, {shape, behind, comb}) {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    Object.assign(this.canvas, {width: Math.round(width * ratio), height: Math.round(height * ratio)});
    const pen = this.canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const scale = camera.scale(width, height);
    const place = (point) => {
      const from = point.map((part, i) => part - camera.middle[i]);
      const along = (row) => row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
      return [width / 2 + scale * along(camera.rows[0]), height / 2 - scale * along(camera.rows[1])];
    };
    if (behind)
      for (let other = 0; other < this.shapes.length; ++other) if (other !== shape) this.layer(pen, place, other, comb, 0.35);
    this.layer(pen, place, shape, comb, 1);
  }

  layer(pen, place, shape, comb, alpha) {
    const style = getComputedStyle(document.documentElement);
    const colour = style.getPropertyValue(shape === 0 && this.shapes.length > 1 ? '--first' : '--second');
    const line = (open, closed) => {
      const points = closed ? [...open, open[0]] : open;
      for (let begin = 0; begin + 1 < points.length; begin += stretch) {
        pen.beginPath();
        points.slice(begin, begin + stretch + 1).forEach((point, k) => pen[k ? 'lineTo' : 'moveTo'](...point));
        pen.stroke();
      }
    };
    pen.strokeStyle = pen.fillStyle = colour;
    for (const chain of this.shapes[shape]) {
      const places = chain.points.map(place);
      const shown = apart(places);
      const roots = shown.map((k) => places[k]);
      if (comb > 0) {
        const tips = shown.map((k) => place(this.tip(chain, k, comb)));
        pen.globalAlpha = 0.45 * alpha;
        pen.lineWidth = 0.7;
        roots.forEach((root, k) => line([root, tips[k]], false));
        line(tips, chain.closed);
      }
      pen.globalAlpha = alpha;
      pen.lineWidth = 2;
      line(roots, chain.closed);
      if (roots.length > mostDots) continue;
      for (const [x, y] of roots) pen.fillRect(x - 1.5, y - 1.5, 3, 3);
    }
    pen.globalAlpha = 1;
  }
}
