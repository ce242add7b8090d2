// Requests of the page to the worker, and its answers. Arrays are transferred, not copied.

import type { Curvatures, FillReport, HeldNormals, Patches, Region, Report, SharpEdges, SpanReport } from '../../../bindings/wasm/package/vspring_core';
import type { NamedBytes } from '../base/files';
import type { Vector } from '../base/vectors';

export type { Curvatures, FillReport, HeldNormals, Patches, Region, Report, SharpEdges };

/** What may be held of a node; tangents are those of curves. */
export const parts = ['position', 'normal', 'tangent'] as const;
export type Part = (typeof parts)[number];

interface OpenedShape {
  positions: Float64Array;
  /** 1 for every node of a boundary, of a curve: for every end. */
  boundary: Uint8Array;
  warnings: string[];
}

export interface OpenedSurface extends OpenedShape {
  faceBegin: Int32Array;
  corners: Int32Array;
}

export interface OpenedCurve extends OpenedShape {
  chainBegin: Int32Array;
  chainNodes: Int32Array;
  closed: Uint8Array;
  /** Whether the file has two coordinates a node. */
  planar: boolean;
}

export type Opened = OpenedSurface | OpenedCurve;

/** Nodes and chains of a curve where some were inserted or deleted. from: the number that each had when it was opened; -1: none. */
export interface CurveNodes {
  positions: Float64Array;
  chainBegin: Int32Array;
  chainNodes: Int32Array;
  closed: Uint8Array;
  from: Int32Array;
}

/** Places of held nodes, or their normals, three numbers each. */
export interface Drag {
  part: Part;
  nodes: Int32Array;
  vectors: Float64Array;
  /** How far that is from where the drag began. */
  way: Vector;
  /** When the pointer was there, in milliseconds as of performance.now(). */
  time: number;
  /** Only about where that leads, in less time; nothing is solved. */
  rough?: boolean;
}

export type FitKind = 'smoothingLength' | 'within' | 'rms' | 'weight';

/** outliers: a share of the points. */
export interface FitSettings {
  readonly kind: FitKind;
  readonly value: number;
  readonly outliers: number;
}

/** points: the number that they were given. */
export interface FitJob extends FitSettings {
  points: number;
}

/** rules: a constraints file, where what holds has changed; with it, whether free boundary nodes are faired first. drag: held nodes under the pointer; without it the surface is faired anew from the input. */
export interface Job {
  rules?: string;
  fairBoundary?: boolean;
  /** Comes with rules: null where there are no points to be drawn towards. */
  fit?: FitJob | null;
  drag?: Drag;
}

export interface Solved {
  positions: Float64Array;
  report: Report;
  /** Where rules came with the job; of curves tangents. */
  normals?: HeldNormals;
  /** Likewise, of surfaces: the edges that stay sharp, two nodes each. */
  sharp?: Int32Array;
}

export interface Requests {
  open: { ask: { name: string; bytes: Uint8Array; rules: string }; answer: Opened };
  /** Opens the curve through places, three numbers each, that are held there, with so many nodes in all. from: for every node the place that it is at, or -1. */
  draw: { ask: { places: Float64Array; closed: boolean; nodes: number }; answer: OpenedCurve & { from: Int32Array } };
  /** The fair curve through places as `draw` opens it, with its first node once more at its end where it is closed; what is open stays. */
  sketch: { ask: Ask<'draw'>; answer: Float64Array };
  /** Gives the curve that was opened other nodes; null: its own. Nothing holds it then, and points stay. */
  nodes: { ask: CurveNodes | null; answer: OpenedCurve };
  /** Fills holes of the surface with those positions: through those boundary nodes, or, null, all but outer rims. What is open stays. */
  fill: { ask: { at: Int32Array | null; positions: Float64Array }; answer: { report: FillReport; patches: Patches; positions: Float64Array } };
  /** The surface through the curves with those positions, and what holds it on them. sharp: numbers of chains along which it may have an edge. What is open stays. */
  span: { ask: { sharp: Int32Array; positions: Float64Array }; answer: Pick<SpanReport, 'outcome' | 'warnings' | 'surface' | 'held' | 'heldNormals' | 'sharpEdges'> };
  /** Gives the surface that was opened these patches and no others; null: none. Nothing holds it then, and points stay. */
  patches: { ask: Patches | null; answer: OpenedSurface };
  /** Throws, and leaves what held, where the rules are refused. */
  hold: { ask: { rules: string }; answer: null };
  /** All that is solved starts from there; null: from the input. Nothing holds it then. */
  start: { ask: Float64Array | null; answer: null };
  /** Takes scattered points, which the jobs name by that number, from a file or as nodes of the shape itself. Another shape has none. */
  points: { ask: { number: number; from: NamedBytes | Float64Array }; answer: { positions: Float64Array } };
  /** Of a shape of those positions. */
  region: { ask: { rules: string; nodes: Int32Array; positions: Float64Array }; answer: Region };
  /** Edges that turn by more than an angle, in degrees, where all starts from. noisy: of the surface without its noise, as its own nodes are points. */
  sharp: { ask: { angle: number; noisy: boolean }; answer: SharpEdges };
  /** The standard deviation of the nodes where all starts from, as far as that can be told; else 0. */
  noise: { ask: null; answer: number };
  solve: { ask: Job; answer: Solved };
  curvatures: { ask: { positions: Float64Array }; answer: Curvatures };
  /** The bytes of a file of that name, with those positions. */
  write: { ask: { name: string; positions: Float64Array }; answer: Uint8Array };
}

export type Kind = keyof Requests;
export type Ask<K extends Kind> = Requests[K]['ask'];
export type Answer<K extends Kind> = Requests[K]['answer'];

export interface Request<K extends Kind = Kind> {
  number: number;
  kind: K;
  ask: Ask<K>;
}

/** Where in shared memory the page writes the number of the last request that is to end soon: of solutions that are out of date, and of all. */
export const endedSolution = 0;
export const endedAll = 1;

/** folder: an address in the one that the library is loaded from. ended: that memory; null where it may not be shared. */
export interface Start {
  folder: string;
  ended: Int32Array | null;
}

export type Reply =
  | { number: number; answer: Answer<Kind> }
  | { number: number; error: string }
  | { number: number; fraction: number };
