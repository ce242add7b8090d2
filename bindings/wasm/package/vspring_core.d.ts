// The library in JavaScript: see README.md. Arrays are copies; places and vectors are three numbers each,
// lengths are in units of the file. Every call throws an Error for what it cannot use, and leaves the shape as it was.

/** Loads the library. */
declare function vspringCore(options?: vspringCore.Options): Promise<vspringCore.Core>;

declare namespace vspringCore {
  interface Options {
    /** The bytes of the .wasm file; without them it is found beside the script. */
    wasmBinary?: ArrayBuffer | Uint8Array;
    /** The address of a file of the library. */
    locateFile?: (name: string) => string;
    /** Of vspring_core_threads.js: how many work on every call, and the address of that script. */
    threads?: number;
    mainScriptUrlOrBlob?: string;
  }

  /** Called some 20 times a second with how much is done, 0 to 1. Returns true to end the call soon, with the best shape so far. */
  type Progress = ((fraction: number) => boolean | void) | null;

  /** How a run ended. */
  interface Report {
    outcome: string;
    /** Whether the shape is an answer to what was asked, as with exit status 0 of the program; else it is one on the way, or the input. */
    usable: boolean;
    iterations: number;
    seconds: number;
    threads: number;
    /** How far the result is expected to be from the equilibrium, as a share of the diagonal; null where it is not told. */
    expectedError: number | null;
    movingNodes: number;
    warnings: string[];
    /** Of all but a surface's update(). */
    greatestMove?: number;
    /** Of fit(), outliers left out. */
    fit?: FitFigures;
    /** Of fit(): of every point; of many points only where the call was not cancelled. */
    distances?: Float64Array;
  }

  interface FitFigures {
    points: number;
    pullingPoints: number;
    outliers: number;
    smoothingLength: number | null;
    leastRadius: number | null;
    /** The node that has it. */
    sharpestNode: number;
    greatest: number;
    rms: number;
  }

  /** One of weight, smoothingLength, within and rms; the rest as it is liked. */
  interface FitSettings {
    weight?: number | null;
    smoothingLength?: number | null;
    within?: number | null;
    rms?: number | null;
    /** The share of points that is left out. */
    outliers?: number | null;
    /** Curves: no smaller radius than this; corners at turns by more than so many degrees. */
    leastRadius?: number | null;
    sharp?: number | null;
    /** Whether nodes keep their distribution. */
    keep?: boolean;
  }

  /** Normals that are held. */
  interface HeldNormals {
    nodes: Int32Array;
    normals: Float64Array;
  }

  /** Tangents that are held. */
  interface HeldTangents {
    nodes: Int32Array;
    tangents: Float64Array;
  }

  /** The principal curvatures at the nodes; k1 is not less than k2. */
  interface Curvatures {
    k1: Float64Array;
    k2: Float64Array;
  }

  /** What must hold for only some nodes to move: nodes that stay, and the rim with its normals or, of curves, its tangents. */
  interface Region {
    fixed: Int32Array;
    rim: Int32Array;
    normals?: Float64Array;
    tangents?: Float64Array;
  }

  interface Points {
    positions(): Float64Array;
    /** Whether they have weights of their own. */
    weighted(): boolean;
    /** Frees its memory, which JavaScript does not do by itself. */
    delete(): void;
  }

  /** What surfaces and curves have in common. */
  interface Shape {
    nodeCount(): number;
    positions(): Float64Array;
    /** 1 for every node of a boundary, of a curve: for every end. */
    boundary(): Uint8Array;
    warnings(): string[];
    /** Replaces all constraints by those of a constraints file. */
    setRules(json: string): void;
    holdPosition(node: number, x: number, y: number, z: number): void;
    freePosition(node: number): void;
    /** From the file's shape. */
    fair(progress: Progress): Report;
    /** From the last shape, for a drag. */
    update(progress: Progress): Report;
    /** As fair(), drawn to points. */
    fit(points: Points, settings: FitSettings, progress: Progress): Report;
    region(nodes: Int32Array, positions: Float64Array): Region;
    /** The estimated standard deviation of the nodes. */
    noise(): number;
    /** Another shape to write. */
    setPositions(positions: Float64Array): void;
    /** The bytes of a file, with all that the input carried; the format by the name. */
    write(name: string): Uint8Array;
    /** Frees its memory, which JavaScript does not do by itself. */
    delete(): void;
  }

  interface Surface extends Shape {
    faceCount(): number;
    /** Where the corners of each face begin, and the number of them all. */
    faceBegin(): Int32Array;
    corners(): Int32Array;
    holdNormal(node: number, x: number, y: number, z: number): void;
    freeNormal(node: number): void;
    heldNormals(): HeldNormals;
    /** Whether boundary loops are faired first. */
    setFairBoundary(first: boolean): void;
    /** About where update() would lead; null where it would not start from the last shape. */
    predict(): Float64Array | null;
    curvatures(positions: Float64Array): Curvatures;
  }

  interface Curve extends Shape {
    /** Where the nodes of each chain begin, and the number of them all. */
    chainBegin(): Int32Array;
    chainNodes(): Int32Array;
    /** 1 for every chain that is closed. */
    closed(): Uint8Array;
    /** Whether the file has two coordinates a node. */
    planar(): boolean;
    holdTangent(node: number, x: number, y: number, z: number): void;
    freeTangent(node: number): void;
    heldTangents(): HeldTangents;
    /** So many even nodes between those that are held. Returns for every node its number before, or -1. */
    resample(nodes: number): Int32Array;
    setNodes(positions: Float64Array, chainBegin: Int32Array, chainNodes: Int32Array, closed: Uint8Array, from: Int32Array): void;
  }

  interface Core {
    version(): string;
    /** Of vspring_core_threads.js: ends the threads, without which node does not end. */
    PThread?: { terminateAllThreads(): void };
    /** name: of the file, whose extension says its format where its content does not. */
    Surface: new (bytes: Uint8Array, name: string) => Surface;
    Curve: (new (bytes: Uint8Array, name: string) => Curve) & {
      /** A curve that no file gave. */
      through(positions: Float64Array, closed: boolean): Curve;
    };
    Points: (new (bytes: Uint8Array, name: string) => Points) & { at(positions: Float64Array): Points };
  }
}

export = vspringCore;
export as namespace vspringCore;
