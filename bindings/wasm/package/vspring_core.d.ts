// The library in JavaScript: see README.md. Arrays are copies; places and vectors are three numbers each,
// lengths are in units of the file. Every call throws an Error for what it cannot use, and leaves the shape as it was.

/** Loads the library. */
declare function vspringCore(options?: vspringCore.Options): Promise<vspringCore.Core>;

declare namespace vspringCore {
  interface Options {
    /** The bytes of the .wasm file; by default the file next to the script. */
    wasmBinary?: ArrayBuffer | Uint8Array;
    /** The address of a file of the library. */
    locateFile?: (name: string) => string;
    /** Of vspring_core_threads.js: the number of threads, and the address of that script. */
    threads?: number;
    mainScriptUrlOrBlob?: string;
  }

  /** Called about 20 times a second with the share done, 0 to 1. Return true to end the call soon, with the best shape so far; an Error ends it, too, and is thrown behind it. Calls that would change or delete what the call works on are refused meanwhile. */
  type Progress = ((fraction: number) => boolean | void) | null;

  /** How a run ended. */
  interface Report {
    outcome: string;
    /** Whether the shape is an answer to what was asked, as with exit status 0 of the program; else it is one on the way, or the input. */
    usable: boolean;
    iterations: number;
    seconds: number;
    threads: number;
    /** Expected distance of the result from the equilibrium, as a share of the diagonal; null if unknown. */
    expectedError: number | null;
    movingNodes: number;
    warnings: string[];
    /** Not of a surface's update(). */
    greatestMove?: number;
    /** Of fit(), without outliers. */
    fit?: FitFigures;
    /** Of fit(): of every point; missing for many points if the call was cancelled. */
    distances?: Float64Array;
  }

  interface FitFigures {
    points: number;
    pullingPoints: number;
    outliers: number;
    smoothingLength: number | null;
    leastRadius: number | null;
    /** The node of the least radius. */
    sharpestNode: number;
    greatest: number;
    rms: number;
  }

  /** Exactly one of weight, smoothingLength, within and rms; the rest is optional. */
  interface FitSettings {
    weight?: number | null;
    smoothingLength?: number | null;
    within?: number | null;
    rms?: number | null;
    /** The share of points to leave out. */
    outliers?: number | null;
    /** Curves: the least radius of curvature; corners at turns by more than this angle, degrees. */
    leastRadius?: number | null;
    sharp?: number | null;
    /** Whether nodes keep their distribution. */
    keep?: boolean;
  }

  /** The held normals. */
  interface HeldNormals {
    nodes: Int32Array;
    normals: Float64Array;
  }

  /** The held tangents. */
  interface HeldTangents {
    nodes: Int32Array;
    tangents: Float64Array;
  }

  /** The principal curvatures at the nodes; k1 is not less than k2. */
  interface Curvatures {
    k1: Float64Array;
    k2: Float64Array;
  }

  /** Constraints with which only some nodes move: nodes that stay, and the rim with its normals or, of curves, its tangents. */
  interface Region {
    fixed: Int32Array;
    rim: Int32Array;
    normals?: Float64Array;
    tangents?: Float64Array;
  }

  /** How a shape is symmetric. */
  interface Symmetry {
    /** Whether it is one half, rather than the whole. */
    isHalf: boolean;
    pairs: number;
    onPlane: number;
    /** The mirror image of each node of the whole, of which the shape's own nodes are the first; on the plane itself, of no face -1. */
    partner: Int32Array;
  }

  interface Points {
    positions(): Float64Array;
    /** Whether they have weights of their own. */
    weighted(): boolean;
    /** Frees its memory, which JavaScript does not do by itself. */
    delete(): void;
  }

  /** Members of surfaces and curves. */
  interface Shape {
    nodeCount(): number;
    positions(): Float64Array;
    /** 1 for every node of a boundary; of a curve for every end. */
    boundary(): Uint8Array;
    warnings(): string[];
    /** Takes the shape for half of one that is symmetric about a plane, or for a whole one: 'x', 'x=2.5' or 'plane:px,py,pz,nx,ny,nz'; '': for any. Returns what is found, and null for ''. Nothing holds it then. */
    setSymmetry(plane: string): Symmetry | null;
    /** Replaces all constraints by those of a constraints file. */
    setRules(json: string): void;
    holdPosition(node: number, x: number, y: number, z: number): void;
    freePosition(node: number): void;
    /** Sets whether it meets the curvature of what is around it, too, in place of its tangents or tangent planes alone. */
    setContinuity(curvature: boolean): void;
    /** Fairs the file's shape. */
    fair(progress: Progress): Report;
    /** Fairs from the last shape, for a drag. */
    update(progress: Progress): Report;
    /** Fits the file's shape to points. */
    fit(points: Points, settings: FitSettings, progress: Progress): Report;
    region(nodes: Int32Array, positions: Float64Array): Region;
    /** The estimated standard deviation of the nodes. */
    noise(): number;
    /** Sets another shape to write. */
    setPositions(positions: Float64Array): void;
    /** The bytes of a file, with all data of the input; the name gives the format. */
    write(name: string): Uint8Array;
    /** Frees its memory, which JavaScript does not do by itself. */
    delete(): void;
  }

  /** Which holes are filled, and how: all but outer rims, unless more is said. */
  interface FillSettings {
    /** Only holes through these boundary nodes, outer rims among them. */
    at?: ArrayLike<number> | null;
    outerRims?: boolean;
    /** Only holes with rims no longer than this, and with no more edges. */
    maxSize?: number | null;
    maxEdges?: number | null;
    /** Whether patches stay as they are before fairing. */
    flat?: boolean;
  }

  /** A closed loop of boundary edges, and what became of it. */
  interface Hole {
    /** Its nodes, the least first. */
    rim: Int32Array;
    length: number;
    state: 'filled' | 'outer-rim' | 'too-large' | 'elsewhere' | 'unfillable' | 'cancelled';
    /** Of one that cannot be filled: why, where, and what to do; else empty. */
    fault: string;
    /** Of a filled one: its new nodes and faces, which follow each other from these on; else -1. */
    firstNode: number;
    nodeCount: number;
    firstFace: number;
    faceCount: number;
    /** How its fairing ended; null where it has no new node, and with flat. */
    outcome: string | null;
  }

  /** Of the fairing of all patches: the worst outcome, sums of work. */
  interface FillReport extends Report {
    holes: Hole[];
  }

  /** The nodes and triangles that fill() has added to a file. */
  interface Patches {
    positions: Float64Array;
    corners: Int32Array;
    /** The node of the file and the face of the file that each is like, such as in its colour. */
    nodeLike: Int32Array;
    faceLike: Int32Array;
    /** Groups of OBJ: the first face of each, and its name. */
    groupBegin: Int32Array;
    groupNames: string[];
  }

  interface SharpEdges {
    /** Two nodes each. */
    edges: Int32Array;
    /** Where the nodes of each chain begin, and the number of all nodes. */
    chainBegin: Int32Array;
    chainNodes: Int32Array;
    /** 1 for every closed chain. */
    closed: Uint8Array;
    /** Nodes at which three sharp edges or more meet. */
    corners: Int32Array;
  }

  interface Surface extends Shape {
    faceCount(): number;
    /** Where the corners of each face begin, and the number of all corners. */
    faceBegin(): Int32Array;
    corners(): Int32Array;
    holdNormal(node: number, x: number, y: number, z: number): void;
    freeNormal(node: number): void;
    heldNormals(): HeldNormals;
    /** Sets whether boundary loops are faired first. */
    setFairBoundary(first: boolean): void;
    /** Edges that stay sharp besides those that rules name, two nodes each; none when nodes are added by fill(). */
    setSharpEdges(edges: ArrayLike<number>): void;
    /** Those set and those that rules name, two nodes each. */
    sharpEdges(): Int32Array;
    /** Edges of the file's shape that turn by more than an angle, degrees, with their chains; with noise(), or another, of the surface without it. */
    findSharpEdges(angle: number, noise: number): SharpEdges;
    /** Edges that the file marks, by lines of OBJ or the element edge of PLY, and that can be sharp; two nodes each. */
    markedEdges(): Int32Array;
    /** Predicts the positions of update(); null if it would not start from the last shape. */
    predict(): Float64Array | null;
    curvatures(positions: Float64Array): Curvatures;
    /** Fills holes of the file's shape with fair patches. Their nodes and faces follow those of the file, which stay as they are; nothing holds it then. */
    fill(settings: FillSettings, progress: Progress): FillReport;
    patches(): Patches;
    /** Replaces the patches by others, such as those of another surface from the same file; null: by none. Nothing holds it then. */
    setPatches(patches: Patches | null): void;
  }

  /** Which loops of a network are spanned, and how: all but outer rims and lids, unless more is said. */
  interface SpanSettings {
    /** Length of edges; by default an 80th of the diagonal of the box around the curves. */
    length?: number | null;
    /** Curves nearer to each other than this meet there; by default a thousandth of that diagonal. */
    join?: number | null;
    /** Whether the curves are faired first. */
    fairCurves?: boolean;
    /** Numbers of chains along which the surface may have an edge. */
    sharp?: ArrayLike<number> | null;
    /** Where the surface ends in this plane, it is at right angles to it. */
    symmetry?: string | null;
    /** Only these loops, by their numbers in the report; these, too; not these. */
    loops?: ArrayLike<number> | null;
    also?: ArrayLike<number> | null;
    without?: ArrayLike<number> | null;
    /** Whether the surface stays as it is before fairing. */
    flat?: boolean;
  }

  /** A curve of a network, from one junction or corner to the next. */
  interface NetworkCurve {
    /** Nodes of the input along it; -1 where curves cross between nodes. */
    from: Int32Array;
    /** Nodes of the surface along it; none if no surface meets it. */
    nodes: Int32Array;
    length: number;
    sharp: boolean;
    /** How many spanned loops run along it. */
    loops: number;
  }

  /** A closed loop of curves, and what became of it. */
  interface NetworkLoop {
    /** Their numbers, in order, and the node of the input where each begins, or -1. */
    curves: Int32Array;
    junctions: Int32Array;
    length: number;
    /** By how many degrees it turns from the loops beside it, before fairing. */
    turn: number;
    state: 'spanned' | 'outer' | 'lid' | 'left-out' | 'unspannable' | 'cancelled';
    /** Whether its faces are quads in a grid. */
    grid: boolean;
    /** Of a spanned one: the nodes within it and its faces, which follow each other from these on; else -1. */
    firstNode: number;
    nodeCount: number;
    firstFace: number;
    faceCount: number;
  }

  /** Of the surface's fairing. */
  interface SpanReport extends Report {
    curves: NetworkCurve[];
    loops: NetworkLoop[];
    /** Nodes on curves, which stay, and the normals where the surface ends. */
    held: Int32Array;
    heldNormals: HeldNormals;
    /** Along sharp curves between two faces, two nodes each. */
    sharpEdges: Int32Array;
    /** The surface as an OBJ file, for `new Surface(surface, 'span.obj')`. */
    surface: Uint8Array;
  }

  interface Curve extends Shape {
    /** Where the nodes of each chain begin, and the number of all nodes. */
    chainBegin(): Int32Array;
    chainNodes(): Int32Array;
    /** 1 for every closed chain. */
    closed(): Uint8Array;
    /** Whether the file has two coordinates a node. */
    planar(): boolean;
    holdTangent(node: number, x: number, y: number, z: number): void;
    freeTangent(node: number): void;
    heldTangents(): HeldTangents;
    /** Puts even nodes between held ones, `nodes` in all. Returns for every node its number before, or -1. */
    resample(nodes: number): Int32Array;
    /** Spans the chains, where their nodes are now, with a fair surface; the curve stays as it is. */
    span(settings: SpanSettings, progress: Progress): SpanReport;
    setNodes(positions: Float64Array, chainBegin: Int32Array, chainNodes: Int32Array, closed: Uint8Array, from: Int32Array): void;
  }

  interface Core {
    version(): string;
    /** Of vspring_core_threads.js: ends the threads; otherwise node does not end. */
    PThread?: { terminateAllThreads(): void };
    /** name: of the file; its extension gives the format if the content does not. */
    Surface: new (bytes: Uint8Array, name: string) => Surface;
    Curve: (new (bytes: Uint8Array, name: string) => Curve) & {
      /** Makes a curve without a file. */
      through(positions: Float64Array, closed: boolean): Curve;
    };
    Points: (new (bytes: Uint8Array, name: string) => Points) & { at(positions: Float64Array): Points };
  }
}

export = vspringCore;
export as namespace vspringCore;
