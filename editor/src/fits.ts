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
    if (!this.now || !('fit' in shape)) return shape.fair(progress);
    const { kind, value, outliers, points } = this.now;
    const report = shape.fit(this.clouds.get(points)!, { [kind]: value, outliers }, progress);
    this.found = report.fit!.smoothingLength;
    return report;
  }

  /** In a drag: a tolerance by the smoothing length that it came to, and without points where that is slow. */
  follow(shape: CoreSurface | CoreCurve, progress: Progress): Report {
    const { now, found } = this;
    const settings = now && (now.kind === 'weight' ? { weight: now.value } : found !== null && { smoothingLength: found });
    if (!now || !settings || !this.follows || !('fit' in shape)) return shape.follow(progress);
    const report = shape.fit(this.clouds.get(now.points)!, settings, progress);
    this.follows = report.seconds < quick;
    return report;
  }
}
