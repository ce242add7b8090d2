// A toolbar is one stop of the Tab key; arrow keys move within it.

export function rove(toolbar: HTMLElement): void {
  const buttons = [...toolbar.querySelectorAll('button')];
  const stop = (at: number): void => buttons.forEach((button, k) => { button.tabIndex = k === at ? 0 : -1; });
  stop(0);
  buttons.forEach((button, k) => button.addEventListener('focus', () => stop(k)));
  toolbar.addEventListener('keydown', (event) => {
    const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
    const at = buttons.findIndex((button) => button === event.target);
    if (!step || at < 0) return;
    event.preventDefault();
    buttons[(at + step + buttons.length) % buttons.length].focus();
  });
}
