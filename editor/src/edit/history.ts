// Undo and redo: states as plain data, with the step that led to each.

export interface Step<State> {
  readonly label: string;
  readonly state: State;
}

export interface History<State> {
  readonly past: readonly Step<State>[];
  readonly now: Step<State>;
  readonly future: readonly Step<State>[];
}

export function begun<State>(state: State): History<State> {
  return { past: [], now: { label: '', state }, future: [] };
}

export function done<State>({ past, now }: History<State>, label: string, state: State): History<State> {
  return { past: [...past, now], now: { label, state }, future: [] };
}

export function undone<State>({ past, now, future }: History<State>): History<State> {
  return { past: past.slice(0, -1), now: past[past.length - 1], future: [now, ...future] };
}

export function redone<State>({ past, now, future }: History<State>): History<State> {
  return { past: [...past, now], now: future[0], future: future.slice(1) };
}
