// Draws curves with their curvature combs.

const longestTooth = 0.15;  // of the size of the curve, for the sharpest place of the last shape
const longestTeeth = 0.4;   // where those of any shape are cut off
const mostDots = 600;       // more nodes than this would hide the curve

export class CurveView {
  // shapes: chains, see chainsOf().
  constructor(canvas, shapes, size, leading) {
    this.canvas = canvas;
    this.shapes = shapes;
    this.size = size;
    const sharpest = (chains) => chains.flatMap((chain) => chain.vectors)
      .reduce((most, vector) => vector ? Math.max(most, Math.hypot(...vector)) : most, 0);
    // A straight curve gives no scale, then the sharpest of all does.
    const wanted = sharpest(shapes[leading]);
    this.tooth = wanted * size > 1e-6 ? longestTooth * size / wanted
      : longestTooth * size / Math.max(1e-6 / size, ...shapes.map(sharpest));
  }

  tips(chain, length) {
    const most = longestTeeth * this.size;
    return chain.points.map((point, k) => {
      const vector = chain.vectors[k];
      if (!vector) return point;
      const tooth = vector.map((part) => part * this.tooth * length);
      const size = Math.hypot(...tooth);
      return point.map((part, i) => part - tooth[i] * (size > most ? most / size : 1));
    });
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
    const line = (points, closed) => {
      pen.beginPath();
      points.forEach((point, k) => pen[k ? 'lineTo' : 'moveTo'](...point));
      if (closed) pen.closePath();
      pen.stroke();
    };
    pen.strokeStyle = pen.fillStyle = colour;
    for (const chain of this.shapes[shape]) {
      const roots = chain.points.map(place);
      if (comb > 0) {
        const tips = this.tips(chain, comb).map(place);
        pen.globalAlpha = 0.45 * alpha;
        pen.lineWidth = 0.7;
        pen.beginPath();
        roots.forEach((root, k) => {
          pen.moveTo(...root);
          pen.lineTo(...tips[k]);
        });
        pen.stroke();
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
