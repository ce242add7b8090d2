// The worker as promises, with the only queue of solutions.

import { endedAll, endedSolution, type Answer, type Ask, type Job, type Kind, type Reply, type Request, type Solved, type Start } from './protocol';

interface Waiting {
  request: Request;
  done: (answer: Answer<Kind>) => void;
  failed: (error: Error) => void;
  progress?: (fraction: number) => void;
}

/** A request was given up without an answer. */
export class Ended extends Error {}

/** Whether it takes long, and may be given up. */
const canEnd = ({ kind }: Request): boolean => ['solve', 'fill', 'span'].includes(kind);

/** Milliseconds that a solution has to end by itself, with the best shape so far. */
const patience = 40;

export class CoreClient {
  private worker: Worker;
  private readonly waiting = new Map<number, Waiting>();
  private readonly ended = self.crossOriginIsolated ? new Int32Array(new SharedArrayBuffer(8)) : null;
  private last = 0;

  /** What opened the shape, changed its nodes, says where it starts and read its points, and what held it last: all that another worker has to know. */
  private sources: Request[] = [];
  private holds: Job = {};
  private anew = false;

  /** broken: what to do where the worker itself fails, such as for want of memory. */
  constructor(private readonly broken: (message: string) => void) {
    this.worker = this.started();
  }

  private started(): Worker {
    const worker = new Worker(new URL('worker.js', document.baseURI));
    worker.addEventListener('message', ({ data }: MessageEvent<Reply>) => {
      if (worker === this.worker) this.receive(data);
    });
    worker.addEventListener('error', (event) => {
      const message = `The library has failed: ${event.message || 'it cannot be loaded'}`;
      for (const { failed } of this.waiting.values()) failed(new Error(message));
      this.waiting.clear();
      this.broken(message);
    });
    const start: Start = { folder: document.baseURI, ended: this.ended };
    worker.postMessage(start);
    return worker;
  }

  ask<K extends Kind>(kind: K, ask: Ask<K>, progress?: (fraction: number) => void): Promise<Answer<K>> {
    const request: Request<K> = { number: ++this.last, kind, ask };
    if (kind === 'solve') this.remember(request as Request<'solve'>);
    return new Promise<Answer<K>>((done, failed) => {
      this.waiting.set(request.number, { request, done: done as Waiting['done'], failed, progress });
      this.worker.postMessage(request);
    });
  }

  /** All solutions that have been asked for so far end soon, with the best shape so far. */
  endSolutions(): void {
    if (this.ended) Atomics.store(this.ended, endedSolution, this.last);
  }

  /** The same now, if need be without a shape: where memory is not shared or the library is long about it, another worker takes over. */
  endNow(): void {
    const { last } = this;
    if (this.ended) Atomics.store(this.ended, endedAll, last);
    setTimeout(() => {
      if ([...this.waiting.values()].some(({ request }) => canEnd(request) && request.number <= last)) this.restart(last);
    }, this.ended ? patience : 0);
  }

  /** last: the number of the last request that is given up. */
  private restart(last: number): void {
    this.worker.terminate();
    this.worker = this.started();
    this.anew = true;
    for (const source of this.sources) this.worker.postMessage(source);
    for (const [number, { request, failed }] of [...this.waiting]) {
      if (canEnd(request) && number <= last) {
        this.waiting.delete(number);
        failed(new Ended());
      } else {
        if (request.kind === 'solve') this.remember(request as Request<'solve'>);
        this.worker.postMessage(request);
      }
    }
  }

  /** Another worker knows what holds only once it has been told. */
  private remember(request: Request<'solve'>): void {
    const { drag, ...holds } = (request.ask = this.anew ? { ...this.holds, ...request.ask } : request.ask);
    this.holds = { ...this.holds, ...holds };
    this.anew = false;
  }

  private keep(request: Request): void {
    if (request.kind === 'open' || request.kind === 'draw') this.sources = [request];
    // Newer requests replace older ones, and other nodes start at the input.
    const gone: Partial<Record<Kind, readonly Kind[]>> = { nodes: ['nodes', 'start'], patches: ['patches', 'start'], start: ['start'], points: [] };
    const replaced = gone[request.kind];
    if (replaced) this.sources = [...this.sources.filter(({ kind }) => !replaced.includes(kind)), request];
  }

  private receive(reply: Reply): void {
    const waiting = this.waiting.get(reply.number);
    if (!waiting) return;
    if ('fraction' in reply) {
      waiting.progress?.(reply.fraction);
      return;
    }
    this.waiting.delete(reply.number);
    if (!('error' in reply)) this.keep(waiting.request);
    if ('error' in reply) waiting.failed(new Error(reply.error));
    else waiting.done(reply.answer);
  }
}

/** A newer job stands for an older one that still waits; constraints that the older one was to set are not lost. */
export function merged(older: Job | null, newer: Job): Job {
  if (older?.rules === undefined || newer.rules !== undefined) return newer;
  const { drag: _, ...holds } = older;
  return { ...holds, ...newer };
}

export interface SolverEvents {
  solved: (solved: Solved, job: Job) => void;
  failed: (message: string, job: Job) => void;
  /** Given up without a shape. */
  ended: () => void;
  progress: (fraction: number) => void;
  /** Whether something is being solved. */
  busy: (busy: boolean) => void;
}

/** Milliseconds that a step of a drag may have taken when the drag ends and yet be shown. */
const soon = 100;

/** At most one job runs and one waits. */
export class Solver {
  private running: Job | null = null;
  private began = 0;
  private waiting: Job | null = null;
  /** What was given up before it ran. */
  private left: Job | null = null;
  private dropped = false;
  private readonly resting: (() => void)[] = [];

  constructor(
    private readonly client: Pick<CoreClient, 'ask' | 'endNow' | 'endSolutions'>,
    private readonly events: SolverEvents,
  ) {}

  push(next: Job): void {
    const job = merged(this.left, next);
    this.left = null;
    if (this.running) {
      this.waiting = merged(this.waiting, job);
      // Solving from the input takes long, and the result would be out of date; a drag is still shown if it is soon.
      const late = !job.drag && performance.now() - this.began > soon;
      if (!this.running.drag || late) this.client.endSolutions();
    } else {
      void this.run(job);
    }
  }

  /** Until nothing is solved and nothing waits. */
  rest(): Promise<void> {
    return new Promise((done) => {
      if (this.running) this.resting.push(done);
      else done();
    });
  }

  /** Nothing is solved any longer, not even what waits; what holds is not lost. */
  cancel(): void {
    if (this.waiting) this.left = merged(this.left, this.waiting);
    this.dropped = this.waiting !== null;
    this.waiting = null;
    this.client.endNow();
  }

  /** Forgets what waits, as another file is opened. */
  clear(): void {
    this.waiting = this.left = null;
    if (this.running) this.client.endSolutions();
  }

  private async run(job: Job): Promise<void> {
    this.running = job;
    this.began = performance.now();
    this.events.busy(true);
    try {
      const solved = await this.client.ask('solve', job, this.events.progress);
      this.events.solved(solved, job);
    } catch (error) {
      if (error instanceof Ended) this.events.ended();
      else this.events.failed((error as Error).message, job);
    }
    this.running = null;
    // The shape does not fit the constraints, however that solution ended.
    if (this.dropped) this.events.ended();
    this.dropped = false;
    const next = this.waiting;
    this.waiting = null;
    if (next) {
      void this.run(next);
      return;
    }
    this.events.busy(false);
    for (const done of this.resting.splice(0)) done();
  }
}
