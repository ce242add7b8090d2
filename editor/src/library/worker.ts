// The worker that owns the library and the open shape. It answers one request after the other.

import { describe, describeCurve, describeSurface, loadFastest, openShape, type Core, type CoreCurve, type CoreSurface } from './core';
import { Fits } from './fits';
import { endedAll, endedSolution, type Answer, type Ask, type Drag, type HeldNormals, type Job, type Kind, type Reply, type Report, type Request, type Start } from './protocol';

declare function postMessage(reply: Reply, transfer?: Transferable[]): void;

let core: Core;
/** What is open, with all that its file carries. */
let file: CoreSurface | CoreCurve | null = null;
/** What is solved: that, or another one of the same nodes that starts elsewhere. */
let shape: CoreSurface | CoreCurve | null = null;
/** The number that each node of a curve had when it was opened. */
let from: Int32Array | null = null;
/** Makes the curve that is open once more, as it was opened. */
let anew: (() => CoreCurve) | null = null;
let ended: Int32Array | null = null;
const fits = new Fits();

/** Of a shape that nobody has looked at. */
const rough: Report = { outcome: 'foreseen', usable: false, iterations: 0, seconds: 0, threads: 1, expectedError: null, movingNodes: 0, warnings: [] };

type Progress = (fraction: number) => boolean;
type Handlers = { [K in Kind]: (ask: Ask<K>, progress: Progress) => Answer<K> };

function opened(): CoreSurface | CoreCurve {
  if (!shape) throw new Error('Nothing is open');
  return shape;
}

function take(next: CoreSurface | CoreCurve): void {
  startAtInput();
  file?.delete();
  file = shape = next;
  from = null;
}

function startAtInput(): void {
  if (shape !== file) shape?.delete();
  shape = file;
}

/** The same nodes elsewhere. OBJ keeps all digits, and what rules may name: groups and normals. */
function moved(positions: Float64Array): CoreSurface | CoreCurve {
  const name = 'start.obj';
  if ('faceBegin' in file!) return new core.Surface(written(file, name, positions), name);
  const { chainBegin, chainNodes, closed } = describeCurve(file!);
  const curve = anew!();
  curve.setNodes(positions, chainBegin, chainNodes, closed, from ?? Int32Array.from({ length: positions.length / 3 }, (_, node) => node));
  return curve;
}

function written(target: CoreSurface | CoreCurve, name: string, positions: Float64Array): Uint8Array {
  const before = target.positions();
  target.setPositions(positions);
  try {
    return target.write(name);
  } finally {
    target.setPositions(before);
  }
}

function drawn({ places, closed, nodes }: Ask<'draw'>): { curve: CoreCurve; from: Int32Array } {
  const curve = core.Curve.through(places, closed);
  try {
    curve.setRules('{"rules": [{"nodes": "all", "position": "fixed"}]}');
    return { curve, from: curve.resample(nodes) };
  } catch (error) {
    curve.delete();
    throw error;
  }
}

function hold(target: CoreSurface | CoreCurve, { rules, fairBoundary, fit }: Job): void {
  if (fit !== undefined) fits.use(fit);
  if (rules !== undefined) target.setRules(rules);
  if (fairBoundary !== undefined && 'setFairBoundary' in target) target.setFairBoundary(fairBoundary);
}

function heldDirections(target: CoreSurface | CoreCurve): HeldNormals {
  if ('heldNormals' in target) return target.heldNormals();
  const { nodes, tangents } = target.heldTangents();
  return { nodes, normals: tangents };
}

function holdAt(target: CoreSurface | CoreCurve, { part, nodes, vectors }: Drag): void {
  nodes.forEach((node, k) => {
    const [x, y, z] = vectors.subarray(3 * k, 3 * k + 3);
    if (part === 'normal' && 'holdNormal' in target) target.holdNormal(node, x, y, z);
    else if (part === 'tangent' && 'holdTangent' in target) target.holdTangent(node, x, y, z);
    else target.holdPosition(node, x, y, z);
  });
}

const handlers: Handlers = {
  open({ name, bytes, rules }) {
    const next = openShape(core, name, bytes);
    try {
      next.setRules(rules);
    } catch (error) {
      next.delete();
      throw error;
    }
    fits.clear();
    take(next);
    anew = 'faceBegin' in next ? null : () => openShape(core, name, bytes) as CoreCurve;
    return describe(next);
  },
  draw(ask) {
    const { curve, from } = drawn(ask);
    fits.clear();
    take(curve);
    anew = () => drawn(ask).curve;
    return { ...describeCurve(curve), from };
  },
  sketch(ask) {
    const { curve } = drawn(ask);
    curve.fair(null);
    const positions = curve.positions();
    curve.delete();
    return ask.closed ? Float64Array.of(...positions, ...positions.subarray(0, 3)) : positions;
  },
  nodes(ask) {
    if (!anew) throw new Error('Only curves get other nodes');
    const next = anew();
    if (ask) next.setNodes(ask.positions, ask.chainBegin, ask.chainNodes, ask.closed, ask.from);
    take(next);
    from = ask?.from ?? null;
    return describeCurve(next);
  },
  fill({ at, positions }, progress) {
    const copy = moved(positions);
    try {
      if (!('fill' in copy)) throw new Error('Only surfaces have holes');
      const report = copy.fill({ at }, progress);
      return { report, patches: copy.patches(), positions: copy.positions() };
    } finally {
      copy.delete();
    }
  },
  span({ sharp, positions }, progress) {
    const copy = moved(positions);
    try {
      if (!('span' in copy)) throw new Error('Only curves are spanned');
      return copy.span({ sharp }, progress);
    } finally {
      copy.delete();
    }
  },
  patches(ask) {
    if (!file || !('setPatches' in file)) throw new Error('Only surfaces have patches');
    startAtInput();
    file.setPatches(ask);
    return describeSurface(file);
  },
  start(positions) {
    opened();
    startAtInput();
    if (positions) shape = moved(positions);
    return null;
  },
  hold({ rules }) {
    opened().setRules(rules);
    return null;
  },
  points({ number, from }) {
    const own = ArrayBuffer.isView(from);
    // As in the program, nodes of a shape that is fitted to them keep about their places.
    return { positions: fits.add(number, own ? core.Points.at(from) : new core.Points(from.bytes, from.name), own) };
  },
  region({ rules, nodes, positions }) {
    opened().setRules(rules);
    return opened().region(nodes, positions);
  },
  sharp({ angle, noisy }) {
    const target = opened();
    if (!('findSharpEdges' in target)) throw new Error('Only surfaces have sharp edges');
    return target.findSharpEdges(angle, noisy ? target.noise() : 0);
  },
  noise() {
    return opened().noise();
  },
  solve({ rules, fairBoundary, fit, drag }, progress) {
    const target = opened();
    hold(target, { rules, fairBoundary, fit });
    const normals = rules !== undefined ? heldDirections(target) : undefined;
    const sharp = rules !== undefined && 'sharpEdges' in target ? target.sharpEdges() : undefined;
    if (drag) holdAt(target, drag);
    const foreseen = drag?.rough ? (target as CoreSurface).predict() : null;
    if (foreseen) return { positions: foreseen, report: rough };
    const before = target.positions();
    const report = drag ? fits.update(target, progress) : fits.fair(target, progress);
    // A cancelled shape may be crumpled.
    if (report.outcome === 'cancelled') target.setPositions(before);
    return { positions: target.positions(), report, normals, sharp };
  },
  curvatures({ positions }) {
    return (opened() as CoreSurface).curvatures(positions);  // never asked of curves
  },
  write({ name, positions }) {
    opened();
    return written(file!, name, positions);
  },
};

function transferables(answer: Answer<Kind>): Transferable[] {
  if (answer === null || typeof answer === 'number') return [];
  const parts = ArrayBuffer.isView(answer) ? [] : Object.values(answer);
  return [answer, ...parts, ...('patches' in answer ? Object.values(answer.patches) : [])].filter(ArrayBuffer.isView).map((array) => array.buffer as ArrayBuffer);
}

function handle<K extends Kind>({ number, kind, ask }: Request<K>): void {
  const progress: Progress = (fraction) => {
    postMessage({ number, fraction });
    return ended !== null && (Atomics.load(ended, endedAll) >= number || (kind === 'solve' && Atomics.load(ended, endedSolution) >= number));
  };
  try {
    const answer = handlers[kind](ask, progress);
    postMessage({ number, answer }, transferables(answer));
  } catch (error) {
    postMessage({ number, error: error instanceof Error ? error.message : String(error) });
  }
}

const ready = new Promise<void>((done, failed) => {
  self.addEventListener('message', ({ data }: MessageEvent<Start>) => {
    ended = data.ended;
    loadFastest(data.folder).then((loaded) => {
      core = loaded;
      done();
    }, failed);
  }, { once: true });
});

self.addEventListener('message', ({ data }: MessageEvent<Start | Request>) => {
  if (!('kind' in data)) return;
  ready.then(() => handle(data), (error: unknown) => postMessage({ number: data.number, error: `The library cannot be loaded: ${error}` }));
});
