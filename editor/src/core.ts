// The library in WebAssembly as the worker sees it: see docs/webassembly.md.

import type { Region, Report } from './protocol';

export interface CoreSurface {
  positions(): Float64Array;
  faceBegin(): Int32Array;
  corners(): Int32Array;
  boundary(): Uint8Array;
  warnings(): string[];
  setRules(json: string): void;
  holdPosition(node: number, x: number, y: number, z: number): void;
  fair(progress: ((fraction: number) => boolean) | null): Report;
  follow(progress: ((fraction: number) => boolean) | null): Report;
  region(nodes: Int32Array): Region;
  write(name: string): Uint8Array;
  delete(): void;
}

export interface Core {
  Surface: new (bytes: Uint8Array, name: string) => CoreSurface;
}

export type CoreFactory = (options: { locateFile: (name: string) => string }) => Promise<Core>;
