// Puts the editor together.

import { sequential } from '../../page/colours.js';
import { bindCommands, listShortcuts, type Command } from './base/commands';
import { Entry, wholeNumber } from './base/entry';
import { acceptDrops, choose, download, fromAddress, stem } from './base/files';
import { showLoading, type Loading } from './base/loading';
import { startTheme, switchTheme } from './base/theme';
import { rove } from './base/toolbar';
import { bindUnit } from './base/units';
import type { Report } from './library/protocol';
import { enclosed } from './shape/neighbours';
import { placesOf } from './shape/shape';
import { byInput, toFile } from './constraints/constraints';
import type { Fit } from './constraints/points';
import { Autosave } from './edit/autosave';
import { Editor } from './edit/editor';
import { Opening } from './edit/opening';
import { bindPresets } from './navigation/presets';
import { UpMenu } from './navigation/up';
import { Fields, type Field } from './view/fields';
import { View } from './view/view';
import { Gestures } from './pick/gestures';
import { BrushCard } from './pick/brush_card';
import { pick } from './pick/picking';
import { selectionCommands } from './pick/selection';
import { Tilts } from './pick/tilts';
import { Tools } from './pick/tools';
import { Ways } from './pick/ways';
import { Drawing } from './draw/drawing';
import { Nodes } from './draw/nodes';
import { Looks } from './look/looks';
import { Marks } from './look/marks';
import { Dropped } from './start/dropped';
import { StartPanel } from './start/start_panel';
import { CurvePanel } from './panels/curve_panel';
import { Examples } from './panels/examples';
import { showFor } from './panels/kinds';
import { showLegend, showLengths } from './panels/legend';
import { Numbers } from './panels/numbers';
import { PictureOf } from './panels/picture';
import { PointsPanel } from './panels/points';
import { bindReach, showReach } from './panels/reach_slider';
import { SectionPanel } from './panels/section_panel';
import { ServedFile } from './panels/served';
import { SharpPanel } from './panels/sharp';
import { describe, sayItCannotDraw } from './panels/status';
import { bindStrength } from './panels/strength';
import { bindSymmetry, showSymmetry } from './panels/symmetry';

const canvas = document.getElementById('canvas') as HTMLCanvasElement;
const panel = document.querySelector('aside')!;
const help = document.getElementById('help') as HTMLDialogElement;
const format = document.getElementById('format') as HTMLSelectElement;
const examples = new Examples(document.getElementById('example') as HTMLSelectElement, {
  open: (...addresses) => void openExample(...addresses),
  reopen: (slot) => void autosave.reopen(slot),
  forget: () => void autosave.forgetOthers(),
});
const range = document.getElementById('range') as HTMLInputElement;
const firstExample = 'examples/annulus.obj';
/** Pixels between nodes from which on each is a target of its own, and where there are fewer a drag turns the view. */
const distinct = 40;
const shapes = '.obj,.off,.ply,.stl,.csv,.dat,.xyz,.gpx';
const fromField = document.getElementById('deviation-from')!;
let coloured: Field | null = null;
let dotted: { fit: Fit | undefined; report: Report | null } = { fit: undefined, report: null };

const editor: Editor = new Editor({
  opened: (shape, inPlace) => {
    marks.clear();
    examples.opened(opening.example ? editor.name : null);
    showFor(shape, editor.name, format);
    // After its plot has taken its room.
    curves.open(shape);
    view.setUp(inPlace ? up.up : up.open(shape));
    view.open(shape, editor.drawn);
    looks.opened(shape);
    fields.open(shape);
    section.open(shape);
  },
  renumbered: (shape) => {
    marks.clear();
    curves.open(shape);
    view.open(shape, true);
    fields.open(shape);
    section.open(shape);
  },
  shape: (positions, settled) => {
    view.show(positions, settled);
    curves.show(positions, settled);
    section.show(positions, settled);
    fields.move(positions, editor.result, settled);
  },
  changed,
  leaving: () => start.leave(),
});
const opening = new Opening(editor);
const drawing = new Drawing(canvas, editor, opening, () => view, () => refresh());
const fields = new Fields({
  ask: (positions) => editor.client.ask('curvatures', { positions }),
  show: (field) => {
    coloured = field;
    compare();
    view.setField(field);
    showLegend(document.getElementById('legend')!, field);
    describe(editor, coloured);
  },
  failed: (message) => editor.setFault(message, 'solver'),
});
const tools: Tools = new Tools(canvas, document.querySelector('#overlay')!, {
  seen: () => view.seen(),
  picked: () => editor.picked,
  pick: (picked) => editor.set({ picked }),
  withImages: (nodes) => editor.symmetry.with(nodes),
  enclosed: (nodes, others) => enclosed(editor.shape!, nodes, others),
  brush: () => brush.refresh(),
});
const brush = new BrushCard(document.getElementById('brush')!, () => tools);
const ways = new Ways(document.getElementById('way')!, {
  wayOf: (across, down) => view.wayOf(across, down),
  normal: () => editor.normalOf(editor.drags.node),
  moved: (way, time) => editor.drags.by(way, time),
});
const autosave = new Autosave(editor, opening, document.getElementById('restored')!, (recent) => examples.list(recent));
const points = new PointsPanel(editor);
const start: StartPanel = new StartPanel(document.getElementById('start')!, editor, () => tools, { chosen: toolChanged });
const sharp = new SharpPanel(document.getElementById('sharp-angle')!, document.getElementById('sharp-says')!, editor);
const numbers = new Numbers(document.getElementById('numbers')!, editor);
const tilts = new Tilts(canvas, editor, () => view, () => tools.tool === 'pick');
const gestures = new Gestures(canvas, {
  active: () => tools.tool === 'pick',
  pick: (x, y, radius) => {
    const seen = view.seen();
    return seen ? pick(seen, x, y, radius, (node) => editor.isDraggable(node)) : -1;
  },
  draggable: (node) => editor.isDraggable(node) || editor.picked.has(node) || isCurve() || view.spacing > distinct,
  hovered: (node) => {
    if (node === editor.hovered || (node >= 0 && editor.atArrow)) return;
    editor.set({ hovered: node, atArrow: false });
  },
  picked: (node, add) => editor.pick(node, add),
  dragBegun: (node) => { editor.drags.begin('position', node, performance.now()); ways.begin(); },
  dragged: (across, down, time) => ways.by(across, down, time),
  dropped: () => { ways.end(); editor.drags.end(true); },
  cancelled: () => { ways.end(); editor.drags.end(false); },
});
const view = newView();
const loopCount = new Entry(document.querySelector<HTMLInputElement>('#loop-nodes input')!, () => wholeNumber(3, 1000), (count) => count !== null && editor.setFairBoundary(true, count));
new Entry(document.getElementById('node-number') as HTMLInputElement, () => wholeNumber(0, (editor.shape?.input.length ?? 3) / 3 - 1), (node) => node !== null && editor.shape && editor.pick(node, false));
const nodes = new Nodes(canvas, editor, () => view.seen(), () => tools.tool === 'pick');

function newView(): View {
  try {
    return new View(canvas, panel, () => editor.frames.drawn(performance.now()));
  } catch (error) {
    sayItCannotDraw();
    throw error;
  }
}

const marks = new Marks(editor, view);
const looks: Looks = new Looks(editor, view, fields, marks, document.getElementById('wipe')!, document.getElementById('wipe-line')!, document.getElementById('lamps')!, () => refresh());
const curves = new CurvePanel(view.curve, document.getElementById('comb') as HTMLInputElement, document.getElementById('comb-clip') as HTMLInputElement, document.getElementById('dock')!, () => view.draw(), () => refresh());
const section = new SectionPanel(view.section, () => view.draw());
const pictureOf = new PictureOf(editor, view, fields);
const served = ServedFile.of(location.href, editor, format.parentElement!);

const opened = (): boolean => editor.shape !== null;
const isCurve = (): boolean => editor.shape?.curve != null;
const somePicked = (): boolean => editor.picked.size > 0;
const pickedRims = (): number[] => [...editor.picked].filter((node) => editor.shape!.boundary[node]);
const commands: Command[] = [
  { id: 'open', title: 'Open a mesh or a curve', keys: ['o', 'ctrl+o'], run: () => choose(shapes, open, told) },
  ...(served ? [served.command] : []),
  { id: 'save', title: 'Save the result', keys: served ? [] : ['ctrl+s'], run: () => void save(), enabled: opened,
    detail: () => (editor.strength < 1 ? `${Math.round(100 * editor.strength)} % of the way from the input` : undefined) },
  { id: 'load-constraints', title: 'Load constraints', keys: [], run: () => choose('.json', open), enabled: opened },
  { id: 'save-constraints', title: 'Save constraints', keys: ['ctrl+shift+s'], enabled: opened,
    run: () => download(`${stem(editor.name)}-constraints.json`, toFile(byInput(editor.shown, editor.shape!, editor.normals))) },
  ...start.commands,
  ...points.commands,
  ...drawing.commands,
  ...nodes.commands,
  { id: 'undo', title: 'Undo', keys: ['ctrl+z', 'z'], run: () => (start.undoes ? start : opening).undo(), enabled: () => (start.undoes ?? opening.undoes) !== null,
    detail: () => start.undoes ?? opening.undoes ?? undefined },
  { id: 'redo', title: 'Redo', keys: ['ctrl+shift+z', 'ctrl+y', 'y'], run: () => (start.redoes ? start : opening).redo(), enabled: () => (start.redoes ?? opening.redoes) !== null,
    detail: () => start.redoes ?? opening.redoes ?? undefined },
  { id: 'fix-position', title: 'Fix positions of picked nodes', keys: ['f'], run: () => editor.hold('position', true), enabled: somePicked },
  { id: 'free-position', title: 'Free positions of picked nodes', keys: ['shift+f'], run: () => editor.hold('position', false), enabled: somePicked },
  { id: 'fix-normal', title: 'Fix normals or tangents of picked nodes', keys: ['n'], run: () => editor.hold(editor.direction, true), enabled: somePicked },
  { id: 'free-normal', title: 'Free normals or tangents of picked nodes', keys: ['shift+n'], run: () => editor.hold(editor.direction, false), enabled: somePicked },
  ...selectionCommands(editor, tools, toolChanged),
  { id: 'boundary-positions', title: 'Fix or free boundary positions', keys: ['b'], enabled: opened,
    run: () => editor.setBoundary('position', !editor.isBoundaryFixed('position')), pressed: () => editor.isBoundaryFixed('position') },
  { id: 'boundary-normals', title: 'Fix or free boundary normals or tangents', keys: ['shift+b'], enabled: opened,
    run: () => editor.setBoundary(editor.direction, !editor.isBoundaryFixed(editor.direction)), pressed: () => editor.isBoundaryFixed(editor.direction) },
  { id: 'fair-boundary', title: 'Fair boundary loops, then the surface', keys: ['k'], enabled: () => !isCurve() && (editor.shape?.boundary.includes(1) ?? false),
    run: () => editor.setFairBoundary(!editor.constraints.fairBoundary, loopCount.value), pressed: () => editor.constraints.fairBoundary ?? false,
    detail: () => (editor.shape && !editor.shape.boundary.includes(1) ? 'it has no boundary' : undefined) },
  { id: 'fill-holes', title: 'Fill holes: those at picked boundary nodes, or all but outer rims', keys: ['shift+h'], run: () => void editor.fillHoles(pickedRims()),
    enabled: () => !isCurve() && editor.making === '' && (editor.shape?.boundary.includes(1) ?? false) },
  { id: 'span', title: 'Span the curves with a surface; curves that are picked may be its edges', keys: ['shift+s'], run: () => void opening.span(), enabled: () => isCurve() && editor.making === '' },
  { id: 'sharp-edges', title: 'Keep edges sharp that turn by more than an angle', keys: [], run: () => sharp.toggle(), enabled: () => opened() && !isCurve(),
    pressed: () => editor.constraints.sharp !== undefined },
  { id: 'comb', title: 'Curvature comb', keys: ['c'], run: () => curves.toggleComb(), enabled: isCurve, pressed: () => curves.comb },
  { id: 'comb-root', title: 'Hairs by the root of the curvature', keys: [], run: () => { curves.toggleRoot(); refresh(); }, enabled: isCurve, pressed: () => curves.root },
  { id: 'plot-in', title: 'Plot less of the curve; the wheel does so at the pointer, a drag moves', keys: [], run: () => curves.zoom(0.5), enabled: isCurve },
  { id: 'plot-out', title: 'Plot more of the curve', keys: [], run: () => curves.zoom(2), enabled: () => isCurve() && curves.zoomed },
  { id: 'plot', title: 'Plot of curvature', keys: ['p'], run: () => { curves.fold(); refresh(); }, enabled: isCurve, pressed: () => curves.unfolded },
  ...looks.commands,
  { id: 'picture', title: 'Save a picture of before and after', keys: ['shift+p'], enabled: () => opened() && !editor.busy, run: () => void pictureOf.save().catch((error: Error) => editor.setFault(error.message, 'file')) },
  section.command,
  { id: 'input', title: 'Show the input or the result', keys: ['i'], run: () => editor.toggleInput(), enabled: opened, pressed: () => editor.showsInput },
  { id: 'fit', title: 'Show all', keys: ['0', 'home'], run: () => view.fit() },
  { id: 'zoom-in', title: 'Zoom in', keys: ['+', '='], run: () => view.zoomBy(1.25) },
  { id: 'zoom-out', title: 'Zoom out', keys: ['-'], run: () => view.zoomBy(0.8) },
  { id: 'escape', title: 'Give up what is dragged, solved or picked', keys: ['escape'], run: escape },
  { id: 'end', title: 'End the solution that runs', keys: [], run: () => editor.cancel(), enabled: () => editor.canEnd },
  { id: 'go-on', title: 'Solve what was cancelled', keys: [], run: () => editor.settle(), enabled: () => editor.stopped },
  { id: 'theme', title: 'Light or dark', keys: ['t'], run: () => { switchTheme(); view.restyle(); } },
  { id: 'help', title: 'Keyboard shortcuts', keys: ['?'], run: () => help.showModal() },
  { id: 'afresh', title: 'Forget what was restored', keys: [], run: () => void autosave.forget().then(() => openExample(firstExample)).then(() => autosave.begin()) },
  { id: 'dismiss-restored', title: 'Dismiss the notice', keys: [], run: () => { document.getElementById('restored')!.hidden = true; } },
  { id: 'dismiss', title: 'Dismiss the message', keys: [], run: () => editor.set({ fault: null }) },
];
const refresh = bindCommands(commands);
listShortcuts(help.querySelector('dl')!, [...commands,
  { title: 'While a node is dragged: along an axis, its normal', keys: ['x', 'y', 'z', 'n'] },
  { title: 'While a curve is drawn: end it, take its last node away', keys: ['enter', 'backspace'] },
]);

/** Deviation is from the file, or, where that was chosen and something was applied, from that. */
function compare(): void {
  const applied = editor.shown.start;
  fromField.hidden = coloured?.name !== 'deviation' || !applied;
  if (editor.shape) fields.compareWith(fromField.querySelector('select')!.value && applied ? applied : editor.shape.input);
}

function changed(): void {
  compare();
  marks.refresh(looks.look, editor.trying && start.way === 'repair');
  describe(editor, coloured);
  showLoading(document.getElementById('loading')!, editor.loading);
  start.refresh();
  numbers.refresh();
  sharp.refresh();
  view.setSharp(editor.sharp);
  showSymmetry(document.getElementById('symmetric')!, editor);
  showReach(document.getElementById('reach') as HTMLInputElement, editor);
  document.getElementById('loop-nodes')!.hidden = !editor.constraints.loopNodes?.length;
  points.refresh();
  autosave.changed();
  showPoints();
  refresh();
}

function showPoints(): void {
  const { shape, shown: { fit }, report } = editor;
  if ((dotted.fit === fit && dotted.report === report) || (editor.dragging && !report?.distances)) return;
  dotted = { fit, report };
  const distances = report?.distances?.length === (fit?.cloud.positions.length ?? 0) / 3 ? report!.distances! : null;
  const limit = fit?.kind === 'within' ? fit.value : report?.fit?.greatest || 1;
  // Deviation shows how far a surface is from its own nodes.
  const drawn = fit && shape && (fit.cloud.bytes || shape.curve);
  view.dots.set(drawn ? placesOf(shape, fit.cloud.positions) : new Float32Array(), distances, limit);
  const legend = document.getElementById('points-legend')!;
  legend.hidden = !drawn || !distances;
  if (!legend.hidden) showLengths(legend, `Distance of the points${fit!.kind === 'within' ? ', in red beyond the tolerance' : ''}`, sequential, limit);
  view.draw();
}

function told(loading: Loading): void {
  editor.set({ loading });
}

function open({ name, bytes }: { name: string; bytes: Uint8Array }): void {
  void opening.open(name, bytes);
}

async function openAddress(address: string): Promise<void> {
  try {
    const { name, bytes } = await fromAddress(address, told);
    await opening.open(name, bytes);
    if (!editor.fault) served?.opened(address);
  } catch (error) {
    editor.setFault((error as Error).message, 'file');
  }
}

/** Faired, with what it shows. */
async function openExample(address: string, constraints?: string, points?: string): Promise<void> {
  try {
    const { name, bytes } = await fromAddress(address);
    const held = constraints && new TextDecoder().decode((await fromAddress(constraints)).bytes);
    await opening.openFair(name, bytes, held, points ? await fromAddress(points) : undefined);
  } catch (error) {
    editor.setFault((error as Error).message, 'file');
  }
}

async function save(): Promise<void> {
  const name = `${stem(editor.name)}-fair.${format.value}`;
  try {
    download(name, await editor.written(name));
    editor.set({ saved: name });
  } catch (error) {
    editor.setFault((error as Error).message, 'file');
  }
}

/** What the address names, or else what was open last. */
async function begin(): Promise<void> {
  const file = new URLSearchParams(location.search).get('file');
  if (file) await openAddress(file);
  else if (!(await autosave.restore())) await openExample(firstExample);
  autosave.begin();
}

function escape(): void {
  if (tilts.cancel() || gestures.cancel() || tools.cancel()) return;
  if (editor.canEnd) editor.cancel();
  else if (start.dismiss()) return;
  else if (somePicked()) editor.pick(-1, false);
  else tools.set('pick');
  toolChanged();
}

function toolChanged(): void {
  view.leaveToTool(tools.tool !== 'pick');
  editor.set({ hovered: -1 });
}

range.addEventListener('input', () => {
  range.parentElement!.querySelector('output')!.textContent = `${range.value} % of the nodes`;
  fields.setShare(range.valueAsNumber / 100);
});
fromField.addEventListener('change', changed);
bindUnit(document.getElementById('unit') as HTMLSelectElement, () => { fields.setShare(range.valueAsNumber / 100); changed(); });
bindSymmetry(document.getElementById('symmetry') as HTMLSelectElement, editor);
bindReach(document.getElementById('reach') as HTMLInputElement, editor);
const up = new UpMenu(document.getElementById('up') as HTMLSelectElement, (which) => view.setUp(which));
bindPresets(document.getElementById('mouse') as HTMLSelectElement, (preset) => view.setPreset(preset));
bindStrength(document.querySelector('#strength')!, (share, settled) => editor.setStrength(share, settled));
rove(document.querySelector('[role=toolbar]')!);
const dropped = new Dropped(document.getElementById('ask') as HTMLDialogElement, editor, opening, { open, points: (file) => void points.load(file) });
acceptDrops((hangs) => { document.getElementById('drop')!.hidden = !hangs; }, (file, alt) => {
  editor.set({ loading: null });
  dropped.take(file, alt);
}, told);
setInterval(() => { if (editor.busy) describe(editor, coloured); }, 1000);
startTheme(() => view.restyle());
view.restyle();
changed();
void begin();
