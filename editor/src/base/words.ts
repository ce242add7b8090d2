// Words: numbers of things, and the editor's terms in advice of library messages.

const words: [RegExp, string][] = [
  [/fix the (?:boundary|ends)/g, '$& (“Positions fixed”)'],
  [/let only a region move/g, '$& (“Fair only these nodes”)'],
];

export function counted(number: number, one: string, many = `${one}s`): string {
  return `${number.toLocaleString('en')} ${number === 1 ? one : many}`;
}

/** Whether a warning of the library only says how it came to a result that is as good as any: nobody has to do anything about it. */
export function isNote(warning: string): boolean {
  return warning.endsWith('these are edge springs');
}

export function inEditorWords(message: string): string {
  return words.reduce((text, [advice, ours]) => text.replace(advice, ours), message);
}
