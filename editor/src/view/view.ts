// The view: the surface, its lines and markers, drawn when something has changed.

import { Color, ColorManagement, LinearSRGBColorSpace, Matrix4, OrthographicCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Vector } from '../base/vectors';
import { nothing, placesOf, type Shape } from '../shape/shape';
import { lying, standing, type Up } from '../shape/upright';
import { assignButtons, bindArrows, bindWheel } from '../navigation/buttons';
import { Gizmo } from '../navigation/gizmo';
import { buttonsOf, keptPreset, type Preset } from '../navigation/presets';
import { Arrows } from './arrows';
import { CurveLayer } from './curve_layer';
import { Dots } from './dots';
import type { Field } from './fields';
import { gridOfUnits } from './grid';
import { Markers } from './markers';
import type { Lamps, Look } from './materials';
import { pixelOf, placeAt, towards } from './projection';
import type { Seen } from './seen';
import { drawsInSoftware } from './software';
import { SurfaceLayer } from './surface_layer';
import { Wipe } from './wipe';

/** Milliseconds between pictures of a drag beyond which they have fewer pixels, and beyond which nobody drags. */
const slow = 45;
const still = 300;
/** Pixels along each side, as shares: of those of the picture before, and of all. */
const fewer = 0.7;
const coarsest = 0.3;

ColorManagement.enabled = false;  // colours are those of the style sheet

export class View {
  readonly markers = new Markers();
  readonly dots = new Dots();
  readonly arrows = new Arrows();
  readonly curve = new CurveLayer();
  /** What somebody draws: the nodes, and the curve through them. */
  private readonly sketch = new CurveLayer();
  private readonly through = new CurveLayer(false, false);
  private readonly input = new CurveLayer(true);
  readonly section = new CurveLayer(false, false);
  /** Edges that stay sharp. */
  private readonly sharp = new CurveLayer(false, false, '--held');
  private sharpEnds: ArrayLike<number> = [];
  private readonly grid = gridOfUnits();
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, -50, 50);
  private readonly renderer: WebGLRenderer;
  private controls: OrbitControls;
  private shape: Shape | null = null;
  private places: Float32Array = new Float32Array();
  private asked = false;
  /** Smooth edges come from the card; without one, from a finer picture when all has been still for a while. */
  private readonly software = drawsInSoftware();
  private readonly surface = new SurfaceLayer(this.software);
  private readonly wipe = new Wipe(this.software, document.getElementById('wipe-line')!);
  private look: Look = 'shaded';
  /** Pixels of the picture to one of the page, along each side. */
  private resolution = 1;
  /** That of pictures that follow the pointer. */
  private moving = 1;
  private drawnAt = 0;
  private rest = 0;
  private preset: Preset = keptPreset();
  private taken = false;
  private up: Up = 'z';
  private readonly gizmo = new Gizmo(document.getElementById('gizmo')!, (from) => this.lookFrom(from));

  /** panel: what may lie above the right end of the view. drawn: called after each picture. Throws where the browser has no WebGL 2. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly panel: HTMLElement, private readonly drawn: () => void) {
    // Nothing is behind the canvas: opaque, it costs the browser less.
    const context = canvas.getContext('webgl2', { alpha: false, antialias: !this.software });
    if (!context) throw new Error('no WebGL 2');
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.controls = this.newControls();
    const events = { move: (across: number, down: number) => this.moveBy(across, down), turn: (across: number, down: number) => this.turnBy(across, down) };
    bindWheel(canvas, { ...events, turns: () => buttonsOf[this.preset].wheelTurns });
    bindArrows(canvas, events);
    this.scene.add(this.surface.object, this.wipe.object, this.grid, ...this.input.objects, ...this.curve.objects, ...this.section.objects, ...this.sharp.objects, ...this.through.objects, ...this.sketch.objects, ...this.markers.objects, this.arrows.object, this.dots.object);
    this.scene.traverse((object) => { object.frustumCulled = false; });
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  /** They turn about what is upwards as they are made. */
  private newControls(): OrbitControls {
    this.camera.up.set(...lying([0, 0, 1], this.up));
    const controls = new OrbitControls(this.camera, this.canvas);
    Object.assign(controls, { zoomToCursor: true, minZoom: 0.05, maxZoom: 1e4 });
    controls.addEventListener('change', () => this.draw());
    assignButtons(controls, this.taken, this.preset);
    return controls;
  }

  /** The shape stands up that way, and is seen from where it is seen first. */
  setUp(up: Up): void {
    if (up === this.up) return;
    this.up = up;
    this.gizmo.setUp(up);
    const { target } = this.controls;
    this.controls.dispose();
    this.controls = this.newControls();
    this.controls.target.copy(target);
    this.fit(true);
  }

  /** stays: the view stays where it is in units of the file. */
  open(shape: Shape, stays: boolean): void {
    const before = this.shape ?? nothing;
    this.shape = shape;
    this.surface.open(shape);
    this.wipe.set(this.wipe.share, shape);
    this.grid.visible = shape === nothing;
    this.curve.setComb(new Float32Array(), new Float32Array());
    this.sharpEnds = [];
    this.input.show(shape.curve ? placesOf(shape, shape.input) : new Float32Array(), shape.curve ? shape.edges.ends : []);
    this.show(shape.input, true);
    if (stays) this.reframe(before, shape);
    else this.fit(true);
  }

  /** settled: it is not one of many a second. */
  show(positions: Float64Array, settled: boolean): void {
    if (!this.shape) return;
    this.places = placesOf(this.shape, positions);
    const gap = performance.now() - this.drawnAt;
    if (settled) this.moving = 1;
    else if (this.software && gap > slow && gap < still) this.moving = Math.max(coarsest, fewer * this.moving);
    this.surface.show(this.shape, this.places, settled);
    this.curve.show(this.shape.curve ? this.places : new Float32Array(), this.shape.curve ? this.shape.edges.ends : []);
    this.sharp.show(this.places, this.sharpEnds);
    this.markers.move(this.places);
    this.arrows.move(this.places);
    this.draw();
  }

  /** ends: of the edges that stay sharp, two nodes each. */
  setSharp(ends: ArrayLike<number>): void {
    if (ends === this.sharpEnds) return;
    this.sharpEnds = ends;
    this.sharp.show(this.places, ends);
    this.draw();
  }

  /** What the colours show, of the nodes as they were seen when it was asked for. */
  setField(field: Field | null): void {
    this.surface.setField(field);
    this.restyle();
  }

  setLook(look: Look): void {
    this.look = look;
    this.surface.setLook(look);
    this.restyle();
  }

  setLamps(lamps: Lamps): void {
    this.surface.setLamps(lamps);
    this.wipe.setLamps(lamps);
    this.draw();
  }

  /** The input left of a line at that share of the view; null: no line. */
  setWipe(share: number | null): void {
    this.wipe.set(share, this.shape);
    this.restyle();
  }

  /** Edges over whatever else is shown. */
  setEdges(shown: boolean): void {
    this.surface.edges = shown;
    this.restyle();
  }

  /** Takes the colours of the style sheet. */
  restyle(): void {
    const style = getComputedStyle(this.canvas);
    const colour = (name: string): Color => {
      this.canvas.style.color = `var(${name})`;
      return new Color().setStyle(style.color);
    };
    this.renderer.setClearColor(colour(this.look === 'zebra' ? '--behind-zebra' : '--stage'));
    this.surface.restyle(colour);
    this.wipe.restyle(this.look, this.surface.edges, colour);
    this.curve.restyle(colour);
    this.sketch.restyle(colour);
    this.through.restyle(colour);
    this.input.restyle(colour);
    this.section.restyle(colour);
    this.sharp.restyle(colour);
    this.grid.material.color = colour('--line');
    this.markers.restyle(colour);
    this.arrows.restyle(colour);
    this.dots.restyle(colour);
    this.canvas.style.color = '';
    this.draw();
  }

  /** The whole shape in the view; home: from the side that it is first seen from, of a plane curve down on its plane. */
  fit(home = false): void {
    const { camera, controls } = this;
    const from = home ? new Vector3(...(this.shape?.curve?.plane ?? lying([0.45, -0.85, 0.75], this.up))) : camera.position.clone().sub(controls.target);
    camera.position.copy(from.normalize().multiplyScalar(5));
    controls.target.set(0, 0, 0);
    controls.update();
    camera.updateMatrixWorld();
    const low = new Vector3().setScalar(Infinity);
    const high = new Vector3().setScalar(-Infinity);
    const place = new Vector3();
    for (let k = 0; k < this.places.length; k += 3) {
      place.fromArray(this.places, k).applyMatrix4(camera.matrixWorldInverse);
      low.min(place);
      high.max(place);
    }
    if (low.x > high.x) [low, high].forEach((end, k) => end.setScalar(k - 0.5));
    const middle = low.clone().add(high).multiplyScalar(0.5).applyMatrix4(camera.matrixWorld);
    camera.position.sub(controls.target).add(middle);
    controls.target.copy(middle);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { covered } = this;
    camera.zoom = 1.6 / Math.max(high.y - low.y, ((high.x - low.x) * height) / Math.max(1, width - covered), 1e-3);
    const aside = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0).multiplyScalar(covered / height / camera.zoom);
    for (const end of [camera.position, controls.target]) end.add(aside);
    this.resize();
    controls.update();
  }

  zoomBy(factor: number): void {
    this.camera.zoom = Math.min(1e4, Math.max(0.05, this.camera.zoom * factor));
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** taken: a tool has the left button and the single finger. */
  leaveToTool(taken: boolean): void {
    this.taken = taken;
    assignButtons(this.controls, taken, this.preset);
  }

  setPreset(preset: Preset): void {
    this.preset = preset;
    this.leaveToTool(this.taken);
  }

  /** From a side, all of the shape in the view; from above and below, its back is upwards. */
  lookFrom(from: Vector): void {
    const { camera, controls } = this;
    const [x, y, z] = standing(from, this.up);
    camera.position.copy(controls.target).add(new Vector3(...lying([x, x === 0 && y === 0 ? -1e-4 : y, z], this.up)));
    this.fit();
  }

  private turnBy(across: number, down: number): void {
    const { camera, controls } = this;
    const perPixel = (2 * Math.PI) / this.canvas.clientHeight;
    const from = new Vector3(...standing(camera.position.clone().sub(controls.target).toArray(), this.up));
    const around = Math.atan2(from.y, from.x) - across * perPixel;
    const above = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, Math.asin(Math.min(1, Math.max(-1, from.z / from.length()))) + down * perPixel));
    const flat = Math.max(1e-4, Math.cos(above));
    camera.position.copy(controls.target).add(new Vector3(...lying([flat * Math.cos(around), flat * Math.sin(around), Math.sin(above)], this.up)).multiplyScalar(from.length()));
    controls.update();
    this.draw();
  }

  /** Pixels between neighbouring nodes, about. */
  get spacing(): number {
    return ((this.shape?.spacing ?? 0) * this.camera.zoom * this.canvas.clientHeight) / 2;
  }

  seen(): Seen | null {
    if (!this.shape) return null;
    this.camera.updateMatrixWorld();
    const matrix = new Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse).elements;
    return { places: this.places, triangles: this.shape.triangles, matrix, width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  /** A way on the screen, in pixels, as one in the plane of the view, in units of the file; of planar curves in theirs. */
  wayOf(across: number, down: number): Vector {
    const way = this.wayInView(across, down).divideScalar(this.shape?.scale ?? 1);
    if (this.shape?.curve?.planar) {
      const along = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 2);
      if (Math.abs(along.z) > 0.1) way.addScaledVector(along, -way.z / along.z);
      way.z = 0;
    }
    return way.toArray();
  }

  /** From the view towards whoever looks at it. */
  get towards(): Vector {
    return towards(this.camera);
  }

  placeAt(x: number, y: number, normal: Vector): Vector | null {
    return placeAt(this.camera, this.canvas, this.shape ?? nothing, x, y, normal);
  }

  pixelOf(place: Vector): [number, number] {
    return pixelOf(this.camera, this.canvas, this.shape ?? nothing, place);
  }

  /** Nodes as somebody draws them, and the curve through them, three numbers a node; both none: nothing is drawn. */
  showSketch(nodes: readonly Vector[], through: Float64Array): void {
    const shape = this.shape ?? nothing;
    this.sketch.show(placesOf(shape, Float64Array.from(nodes.flat())), []);
    const ends = Array.from({ length: Math.max(0, through.length / 3 - 1) }, (_, k) => [k, k + 1]).flat();
    this.through.show(placesOf(shape, through), ends);
    this.draw();
  }

  private wayInView(across: number, down: number): Vector3 {
    const perPixel = 2 / this.camera.zoom / this.canvas.clientHeight;
    const [right, up] = [0, 1].map((column) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, column));
    return right.multiplyScalar(across * perPixel).addScaledVector(up, -down * perPixel);
  }

  private moveBy(across: number, down: number): void {
    const way = this.wayInView(-across, -down);
    for (const end of [this.camera.position, this.controls.target]) end.add(way);
    this.controls.update();
    this.draw();
  }

  /** Many changes, one picture: when the browser paints next. */
  draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.arrows.scale(this.camera.zoom);
      this.setResolution(this.moving);
      this.scaleMarkers();
      this.paint();
      this.gizmo.turn(...([0, 1, 2].map((column) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, column).toArray()) as [Vector, Vector, Vector]));
      this.drawn();
      this.drawnAt = performance.now();
      this.canvas.dataset.picture = this.software ? 'quick' : 'fine';
      clearTimeout(this.rest);
      if (this.software) this.rest = window.setTimeout(() => this.refine(), still);
    });
  }

  private paint(): void {
    const { renderer, scene, camera, canvas: { clientWidth: width, clientHeight: height } } = this;
    renderer.render(scene, camera);
    this.wipe.paint(this.surface.object, width - this.covered, (pixels) => {
      renderer.setScissorTest(true);
      renderer.setScissor(0, 0, pixels, height);
      renderer.render(scene, camera);
      renderer.setScissorTest(false);
    });
  }

  /** What is seen beside the panel, as finely as it is drawn at last, without a line between input and result. */
  async picture(): Promise<HTMLCanvasElement> {
    await new Promise(requestAnimationFrame);
    const { share } = this.wipe;
    this.wipe.set(null, this.shape);
    this.setResolution(2);
    this.paint();
    const { width, height } = this.scaleOfPicture;
    const copy = Object.assign(document.createElement('canvas'), { width, height });
    copy.getContext('2d')!.drawImage(this.canvas, 0, 0);
    this.wipe.set(share, this.shape);
    this.draw();
    return copy;
  }

  /** Pixels of such a picture, and how many a unit of the file has. */
  get scaleOfPicture(): { width: number; height: number; perUnit: number } {
    const ratio = 2 * window.devicePixelRatio;
    const { clientWidth, clientHeight } = this.canvas;
    return { width: Math.floor(ratio * (clientWidth - this.covered)), height: Math.floor(ratio * clientHeight), perUnit: (ratio * this.camera.zoom * clientHeight * (this.shape?.scale ?? 1)) / 2 };
  }

  /** Pixels of the view, left of what lies above it. */
  get free(): number {
    return this.canvas.clientWidth - this.covered;
  }

  /** What the panel covers of the width. */
  private get covered(): number {
    return this.panel.offsetLeft > 0 ? this.canvas.clientWidth - this.panel.offsetLeft : 0;
  }

  private reframe(from: Shape, to: Shape): void {
    const { camera, controls } = this;
    const moved = controls.target.clone().divideScalar(from.scale).add(new Vector3(...from.centre)).sub(new Vector3(...to.centre)).multiplyScalar(to.scale);
    camera.position.add(moved).sub(controls.target);
    controls.target.copy(moved);
    this.zoomBy(from.scale / to.scale);
    controls.update();
  }

  private refine(): void {
    this.setResolution(2);
    this.paint();
    this.canvas.dataset.picture = 'fine';
  }

  private setResolution(resolution: number): void {
    if (resolution === this.resolution) return;
    this.resolution = resolution;
    this.resizePicture();
  }

  private resizePicture(): void {
    const ratio = window.devicePixelRatio * this.resolution;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    this.scaleMarkers();
  }

  private scaleMarkers(): void {
    const ratio = this.renderer.getPixelRatio();
    this.markers.scale(ratio, this.spacing);
    this.dots.scale(ratio);
    this.curve.scale(ratio);
    this.sketch.scale(ratio, 8);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const ratio = clientWidth / Math.max(1, clientHeight);
    this.resizePicture();
    Object.assign(this.camera, { left: -ratio, right: ratio });
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
