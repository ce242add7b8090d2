// Messages of the library that name options of the command line, in words of the editor.

const words: [RegExp, string][] = [
  [/,? or a rule in --constraints/g, ''],
  [/ \(--constraints\)/g, ''],
  [/--fix boundary/g, '“Positions fixed”'],
  [/--region/g, '“Fair only these nodes”'],
];

export function inEditorWords(message: string): string {
  return words.reduce((text, [option, ours]) => text.replace(option, ours), message);
}
