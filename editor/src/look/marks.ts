// Which nodes are marked: held ones, picked ones, and the one under the pointer.

import { rim } from '../shape/neighbours';
import { heldPosition } from '../constraints/constraints';
import type { Editor } from '../edit/editor';
import type { Look } from '../view/materials';
import type { View } from '../view/view';

export class Marks {
  private held: Uint8Array = new Uint8Array();
  private shown = { normals: new Map() as Editor['normals'], picked: new Set() as ReadonlySet<number>, hovered: -1, edgeOnly: false, hidden: false };
  /** Marks of held nodes, and their arrows, cover what reflection lines and colours show. */
  private hidden = false;
  private look: Look = 'shaded';

  constructor(private readonly editor: Editor, private readonly view: View) {}

  /** Another shape has other nodes. */
  clear(): void {
    this.view.markers.clear();
    this.view.arrows.set(new Map(), new Set());
    this.held = new Uint8Array();
    this.shown.picked = new Set();
  }

  get visible(): boolean {
    return !this.hidden;
  }

  toggle(): void {
    this.hidden = !this.hidden;
    this.held = new Uint8Array();
    this.refresh(this.look, this.shown.edgeOnly);
  }

  /** edgeOnly: of what is picked, as what lies within is to be seen. */
  refresh(look: Look, edgeOnly: boolean): void {
    const { editor, view, shown } = this;
    const { held: { nodes: held }, shape, picked, hovered, normals } = editor;
    if (look !== this.look) Object.assign(this, { look, hidden: look !== 'shaded' && look !== 'wire', held: new Uint8Array() });
    const curve = shape?.curve != null;
    if (this.held !== held || shown.edgeOnly !== edgeOnly) {
      this.held = held;
      const fixed = [...held.keys()].filter((node) => held[node] & heldPosition);
      // If most nodes are held, as around a region, marks on all would hide the shape.
      const some = 2 * fixed.length > held.length && !curve ? [...rim(shape!, fixed)] : fixed;
      view.markers.set('held', this.hidden || edgeOnly ? [] : some);
      view.draw();
    }
    if (shown.normals !== normals || shown.picked !== picked || shown.hovered !== hovered || shown.edgeOnly !== edgeOnly || shown.hidden !== this.hidden) {
      const { hidden } = this;
      this.shown = { normals, picked, hovered, edgeOnly, hidden };
      view.arrows.set(hidden ? new Map() : normals, new Set(hovered < 0 ? picked : [...picked, hovered]));
      view.markers.set('picked', edgeOnly && !curve ? [...rim(shape!, [...picked])] : [...picked]);
      view.markers.set('hovered', hovered < 0 || picked.has(hovered) ? [] : [hovered]);
      view.draw();
    }
  }
}
