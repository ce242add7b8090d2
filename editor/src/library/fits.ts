// Scattered points in the worker, and fits to them.

import type { CorePoints, CoreShape } from './core';
import type { FitJob, Report } from './protocol';

type Progress = (fraction: number) => boolean;
/** A fit that takes longer, in seconds, does not follow the pointer. */
const quick = 0.12;

export class Fits {
  private readonly clouds = new Map<number, { points: CorePoints; keep: boolean }>();
  private now: FitJob | null = null;
  private found: number | null = null;
  private follows = true;

  /** keep: whether nodes that these draw keep their distribution. */
  add(number: number, points: CorePoints, keep: boolean): Float64Array {
    this.clouds.set(number, { points, keep });
    return points.positions();
  }

  clear(): void {
    for (const { points } of this.clouds.values()) points.delete();
    this.clouds.clear();
    this.now = null;
  }

  use(fit: FitJob | null): void {
    this.now = fit;
  }

  /** From the input, drawn towards the points if there are some. */
  fair(shape: CoreShape, progress: Progress): Report {
    this.follows = true;
    if (!this.now) return shape.fair(progress);
    const { kind, value, outliers, points } = this.now;
    const report = this.drawn(shape, points, { [kind]: value, outliers }, progress);
    this.found = report.fit!.smoothingLength;
    return report;
  }

  /** In a drag: a tolerance by the smoothing length that it came to, and without points where that is slow. */
  update(shape: CoreShape, progress: Progress): Report {
    const { now, found } = this;
    const settings = now && (now.kind === 'weight' ? { weight: now.value } : found !== null && { smoothingLength: found });
    if (!now || !settings || !this.follows) return shape.update(progress);
    const report = this.drawn(shape, now.points, settings, progress);
    this.follows = report.seconds < quick;
    return report;
  }

  private drawn(shape: CoreShape, number: number, settings: object, progress: Progress): Report {
    const { points, keep } = this.clouds.get(number)!;
    return shape.fit(points, { ...settings, keep }, progress);
  }
}
