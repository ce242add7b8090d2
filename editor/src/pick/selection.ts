// Commands that pick nodes, and those that choose the tool.

import type { Command } from '../base/commands';
import { withLoops } from '../shape/loops';
import { all, grown, inverted, shrunk, withParts } from '../shape/neighbours';
import type { Shape } from '../shape/shape';
import type { Editor } from '../edit/editor';
import { tools, type Tool, type Tools } from './tools';

const titles: Record<Tool, string> = { pick: 'Pick and drag', box: 'Pick in a box', lasso: 'Pick in a lasso', brush: 'Pick with a brush' };

/** toolChanged: another tool is in hand, or it works otherwise. */
export function selectionCommands(editor: Editor, hand: Tools, toolChanged: () => void): Command[] {
  const opened = (): boolean => editor.shape !== null;
  const some = (): boolean => editor.picked.size > 0;
  const change = (id: string, title: string, keys: string[], made: (shape: Shape, picked: ReadonlySet<number>) => Set<number>, enabled = some): Command =>
    ({ id, title, keys, enabled, run: () => editor.set({ picked: made(editor.shape!, editor.picked) }) });
  const step = (by: number): void => {
    const count = editor.shape!.input.length / 3;
    const [last] = [...editor.picked].slice(-1);
    editor.pick(last === undefined ? (by > 0 ? 0 : count - 1) : (last + by + count) % count, false);
  };
  const tool = (run: () => void) => (): void => {
    run();
    toolChanged();
  };
  return [
    ...tools.map((which, k) => ({ id: `tool-${which}`, title: titles[which], keys: ['qwer'[k]], run: tool(() => hand.set(which)), pressed: () => hand.tool === which })),
    { id: 'visible-only', title: 'Box and lasso leave out what is hidden', keys: ['h'], run: tool(() => { hand.visibleOnly = !hand.visibleOnly; }),
      pressed: () => hand.visibleOnly },
    { id: 'narrow', title: 'Smaller brush', keys: ['['], run: () => hand.setRadius(0.8 * hand.radius) },
    { id: 'widen', title: 'Larger brush', keys: [']'], run: () => hand.setRadius(1.25 * hand.radius) },
    { id: 'erase', title: 'The brush takes away, as with Alt', keys: ['shift+x'], run: tool(() => hand.setErases(!hand.erases)), enabled: () => hand.tool === 'brush', pressed: () => hand.erases },
    change('loop', 'Pick boundary loops of picked nodes', ['l'], withLoops, () => [...editor.picked].some((node) => editor.shape!.boundary[node])),
    change('part', 'Pick connected parts of picked nodes', ['shift+l'], withParts),
    { id: 'next', title: 'Pick the next node', keys: ['.'], enabled: opened, run: () => step(1) },
    { id: 'previous', title: 'Pick the node before', keys: [','], enabled: opened, run: () => step(-1) },
    change('all', 'Pick all nodes', ['ctrl+a'], all, opened),
    change('invert', 'Pick the other nodes', ['ctrl+i'], inverted, opened),
    change('grow', 'Pick one ring of neighbours more', ['g'], grown),
    change('shrink', 'Pick one ring of neighbours less', ['shift+g'], shrunk),
    { id: 'region', title: 'Fair only the picked nodes', keys: ['shift+r'], run: () => void editor.fairOnlyPicked(), enabled: some },
  ];
}
