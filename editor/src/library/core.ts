// The library in WebAssembly as the worker sees it: see docs/webassembly.md.

import type { Curvatures, HeldNormals, Opened, OpenedCurve, Region, Report } from './protocol';

/** What surfaces and curves have in common. */
export interface CoreShape {
  positions(): Float64Array;
  boundary(): Uint8Array;
  warnings(): string[];
  setRules(json: string): void;
  holdPosition(node: number, x: number, y: number, z: number): void;
  fair(progress: ((fraction: number) => boolean) | null): Report;
  update(progress: ((fraction: number) => boolean) | null): Report;
  fit(points: CorePoints, settings: object, progress: (fraction: number) => boolean): Report;
  region(nodes: Int32Array, positions: Float64Array): Region;
  noise(): number;
  setPositions(positions: Float64Array): void;
  write(name: string): Uint8Array;
  delete(): void;
}

export interface CoreSurface extends CoreShape {
  predict(): Float64Array | null;
  holdNormal(node: number, x: number, y: number, z: number): void;
  heldNormals(): HeldNormals;
  faceCount(): number;
  faceBegin(): Int32Array;
  corners(): Int32Array;
  curvatures(positions: Float64Array): Curvatures;
  setFairBoundary(first: boolean): void;
}

export interface CorePoints {
  positions(): Float64Array;
  delete(): void;
}

export interface CoreCurve extends CoreShape {
  chainBegin(): Int32Array;
  chainNodes(): Int32Array;
  closed(): Uint8Array;
  planar(): boolean;
  holdTangent(node: number, x: number, y: number, z: number): void;
  heldTangents(): { nodes: Int32Array; tangents: Float64Array };
  resample(nodes: number): Int32Array;
  setNodes(positions: Float64Array, chainBegin: Int32Array, chainNodes: Int32Array, closed: Uint8Array, from: Int32Array): void;
}

export interface Core {
  Points: (new (bytes: Uint8Array, name: string) => CorePoints) & { at(positions: Float64Array): CorePoints };
  Surface: new (bytes: Uint8Array, name: string) => CoreSurface;
  Curve: (new (bytes: Uint8Array, name: string) => CoreCurve) & { through(places: Float64Array, closed: boolean): CoreCurve };
}

/** A surface or a curve, by the rule of the command line: by the extension, and an OBJ file without faces is a curve. */
export function openShape(core: Core, name: string, bytes: Uint8Array): CoreSurface | CoreCurve {
  if (!/\.(csv|dat|gpx|xyz)$/i.test(name)) {
    const surface = new core.Surface(bytes, name);
    if (surface.faceCount() > 0 || !/\.obj$/i.test(name)) return surface;
    surface.delete();
  }
  return new core.Curve(bytes, name);
}

const common = (shape: CoreShape) => ({ positions: shape.positions(), boundary: shape.boundary(), warnings: shape.warnings() });

export function describeCurve(curve: CoreCurve): OpenedCurve {
  return { ...common(curve), chainBegin: curve.chainBegin(), chainNodes: curve.chainNodes(), closed: curve.closed(), planar: curve.planar() };
}

export function describe(shape: CoreSurface | CoreCurve): Opened {
  return 'faceBegin' in shape ? { ...common(shape), faceBegin: shape.faceBegin(), corners: shape.corners() } : describeCurve(shape);
}

declare const vspringCore: (options: { locateFile: (name: string) => string; mainScriptUrlOrBlob: string; threads: number }) => Promise<Core>;
declare function importScripts(address: string): void;

/** The library from the folder of that address. One thread has memory of its own, more of them share theirs. */
async function loadCore(folder: string, threads: number): Promise<Core> {
  const script = new URL(threads > 1 ? 'vspring_core_threads.js' : 'vspring_core.js', folder).href;
  importScripts(script);
  return vspringCore({ locateFile: (name) => new URL(name, folder).href, mainScriptUrlOrBlob: script, threads });
}

/** More of them gain little, and each loads the library. */
const mostThreads = 8;

/** With a thread for each core where the page may share memory with them and they can be had, else with one. */
export async function loadFastest(folder: string): Promise<Core> {
  const threads = self.crossOriginIsolated ? Math.min(navigator.hardwareConcurrency, mostThreads) : 1;
  if (threads > 1) {
    const { Worker } = self;
    const loading = new AbortController();
    const failure = new Promise<never>((_, failed) => {
      // The library itself listens too late to hear of threads that cannot be loaded at all, and waits for them.
      self.Worker = class extends Worker {
        constructor(address: string | URL) {
          super(address);
          this.addEventListener('error', (event) => {
            event.stopImmediatePropagation();
            event.preventDefault();
            failed(event);
          }, loading);
        }
      };
    });
    try {
      return await Promise.race([loadCore(folder, threads), failure]);
    } catch (error) {
      console.warn('Threads cannot be loaded:', error);
    } finally {
      loading.abort();
      self.Worker = Worker;
    }
  }
  return loadCore(folder, 1);
}
