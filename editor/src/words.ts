// What messages of the library advise, and what it is called in the editor.

const words: [RegExp, string][] = [
  [/fix the (?:boundary|ends)/g, '$& (“Positions fixed”)'],
  [/let only a region move/g, '$& (“Fair only these nodes”)'],
];

export function inEditorWords(message: string): string {
  return words.reduce((text, [advice, ours]) => text.replace(advice, ours), message);
}
