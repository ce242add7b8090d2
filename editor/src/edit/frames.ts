// Counts frames during a drag: a frame counts if it shows a shape solved for a pointer position at most 100 ms old.

export class FrameCounter {
  private begin = 0;
  private count = 0;
  private pictures = 0;
  private shown: number | null = null;

  start(now: number): void {
    Object.assign(this, { begin: now, count: 0, pictures: 0, shown: null });
  }

  /** A shape for the pointer's place at that time will be drawn next. */
  solved(time: number): void {
    this.shown = time;
  }

  drawn(now: number): void {
    if (this.shown !== null && now - this.shown <= 100) ++this.count;
    this.shown = null;
    ++this.pictures;
  }

  /** Those that count, and all pictures. */
  perSecond(now: number): [number, number] {
    const rate = now > this.begin ? 1000 / (now - this.begin) : 0;
    return [rate * this.count, rate * this.pictures];
  }
}
