// The library in WebAssembly as the worker sees it: see docs/webassembly.md.

import type { Core, Curve as CoreCurve, Points as CorePoints, Shape as CoreShape, Surface as CoreSurface } from '../../../bindings/wasm/package/vspring_core';
import type { Opened, OpenedCurve, OpenedSurface } from './protocol';

export type { Core, CoreCurve, CorePoints, CoreShape, CoreSurface };

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

export function describeSurface(surface: CoreSurface): OpenedSurface {
  return { ...common(surface), faceBegin: surface.faceBegin(), corners: surface.corners() };
}

export function describe(shape: CoreSurface | CoreCurve): Opened {
  return 'faceBegin' in shape ? describeSurface(shape) : describeCurve(shape);
}

declare const vspringCore: typeof import('../../../bindings/wasm/package/vspring_core');
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
      // The library listens too late to notice threads that cannot be loaded at all, and would wait for them.
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
