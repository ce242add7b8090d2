// All commands, in one list: buttons, keys and the list of shortcuts are made from it.

export interface Command {
  id: string;
  title: string;
  /** Such as 'z' or 'ctrl+z'; the command key of a Mac counts as Ctrl. The first is the one that is shown. */
  keys: string[];
  run: () => void;
  enabled?: () => boolean;
  pressed?: () => boolean;
  /** What it would be done to, for the button's tip. */
  detail?: () => string | undefined;
}

function keyOf(event: KeyboardEvent): string {
  const key = event.key.toLowerCase();
  // Keyboards differ in where a sign is and whether it needs Shift.
  const shift = event.shiftKey && /^[a-z]$/.test(key);
  return `${event.ctrlKey || event.metaKey ? 'ctrl+' : ''}${shift ? 'shift+' : ''}${key}`;
}

function shown(key: string): string {
  return key.split('+').filter(Boolean).map((part) => part[0].toUpperCase() + part.slice(1)).join(' ') || '+';
}

/** Whether the key means something to what has the focus. */
function takes(target: EventTarget | null, key: string): boolean {
  if (target instanceof HTMLInputElement && target.type === 'range') return key === 'home';
  const typed = target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && !['checkbox', 'radio', 'button'].includes(target.type));
  if (key.startsWith('ctrl+')) return typed && key === 'ctrl+a';
  return typed || target instanceof HTMLSelectElement;
}

/** Binds every element with data-command, and the keys. Returns what brings the buttons up to date. */
export function bindCommands(commands: Command[]): () => void {
  const bound: { button: HTMLElement; command: Command }[] = [];
  for (const button of document.querySelectorAll<HTMLElement>('[data-command]')) {
    const command = commands.find(({ id }) => id === button.dataset.command);
    if (!command) throw new Error(`There is no command ${button.dataset.command}`);
    bound.push({ button, command });
    button.addEventListener('click', () => command.run());
  }
  addEventListener('keydown', (event) => {
    const key = keyOf(event);
    if (event.altKey || document.querySelector('dialog[open]') || takes(event.target, key)) return;
    const command = commands.find(({ keys }) => keys.includes(key));
    if (!command) return;
    event.preventDefault();
    if (command.enabled?.() ?? true) command.run();
  });
  return () => {
    for (const { button, command } of bound) {
      (button as HTMLButtonElement).disabled = !(command.enabled?.() ?? true);
      const detail = command.detail?.();
      const key = command.keys[0] ? ` (${shown(command.keys[0])})` : '';
      button.title = `${command.title}${detail ? `: ${detail}` : ''}${key}`;
      if (command.pressed) button.setAttribute('aria-pressed', String(command.pressed()));
    }
  };
}

/** Into a list of terms and their keys. */
export function listShortcuts(list: HTMLElement, commands: Pick<Command, 'title' | 'keys'>[]): void {
  for (const { title, keys } of commands.filter((command) => command.keys.length > 0)) {
    const row = document.createElement('div');
    const name = Object.assign(document.createElement('dt'), { textContent: title });
    const cell = document.createElement('dd');
    for (const key of keys) cell.append(Object.assign(document.createElement('kbd'), { textContent: shown(key) }));
    row.append(name, cell);
    list.append(row);
  }
}
