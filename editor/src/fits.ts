// What the worker knows of scattered points, and how the shape follows with them.

import type { Core, CoreCurve, CorePoints, CoreSurface } from './core';
import type { FitJob, Report } from './protocol';

type Progress = (fraction: number) => boolean;
/** A fit that takes longer, in seconds, does not follow the pointer. */
const quick = 0.12;

export class Fits {
  private readonly clouds = new Map<number, CorePoints>();
  private now: FitJob | null = null;
  private found: number | null = null;
  private follows = true;
  /** Of the last solution without points. */
  private last: Report | null = null;

  read(core: Core, number: number, name: string, bytes: Uint8Array): Float64Array {
    const points = new core.Points(bytes, name);
    this.clouds.set(number, points);
    return points.positions();
  }

  clear(): void {
    for (const points of this.clouds.values()) points.delete();
    this.clouds.clear();
    this.now = null;
  }

  use(fit: FitJob | null): void {
    this.now = fit;
  }

  /** From the input, drawn towards the points if there are some. */
  fair(shape: CoreSurface | CoreCurve, progress: Progress): Report {
    this.follows = true;
    if (!this.now || !('fit' in shape)) return (this.last = shape.fair(progress));
    const { kind, value, outliers, points } = this.now;
    const report = shape.fit(this.clouds.get(points)!, { [kind]: value, outliers }, progress);
    this.found = report.fit!.smoothingLength;
    return report;
  }

  /** In a drag: a tolerance by the smoothing length that it came to, and without points where that is slow. exact: to the equilibrium. */
  follow(shape: CoreSurface | CoreCurve, exact: boolean, progress: Progress): Report {
    const { now, found } = this;
    const settings = now && (now.kind === 'weight' ? { weight: now.value } : found !== null && { smoothingLength: found });
    if (!now || !settings || !this.follows || !('fit' in shape)) return (!exact && this.preview(shape)) || (this.last = shape.follow(progress));
    const report = shape.fit(this.clouds.get(now.points)!, settings, progress);
    this.follows = report.seconds < quick;
    return report;
  }

  /** Null where there is no shape to start from. */
  private preview(shape: CoreSurface | CoreCurve): Report | null {
    const begin = performance.now();
    const correction = 'preview' in shape ? shape.preview() : null;
    if (correction === null || !this.last) return null;
    return { ...this.last, outcome: 'preview', iterations: 1, expectedError: correction, seconds: (performance.now() - begin) / 1000 };
  }
}
