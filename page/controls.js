// Labelled controls of the view.

// Adds exclusive choices: [value, text] each. Returns the inputs.
export function addChoice(form, name, title, choices, chosen, changed) {
  const set = document.createElement('fieldset');
  set.append(Object.assign(document.createElement('legend'), {textContent: title}));
  const inputs = choices.map(([value, text]) => {
    const input = Object.assign(document.createElement('input'), {type: 'radio', name, value, checked: value === chosen});
    input.addEventListener('change', () => changed(value));
    const label = document.createElement('label');
    label.append(input, text);
    set.append(label);
    return input;
  });
  form.append(set);
  return inputs;
}

export function addSlider(parent, id, text, {low, high, step, value}, changed) {
  const label = Object.assign(document.createElement('label'), {className: 'plain'});
  const input = Object.assign(document.createElement('input'), {type: 'range', id, min: low, max: high, step, value});
  input.addEventListener('input', () => changed(input.valueAsNumber));
  label.append(text, input);
  parent.append(label);
}

export function addSwitch(form, id, text, checked, changed) {
  const label = Object.assign(document.createElement('label'), {className: 'plain'});
  const input = Object.assign(document.createElement('input'), {type: 'checkbox', id, checked});
  input.addEventListener('change', () => changed(input.checked));
  label.append(input, text);
  form.append(label);
}

export function addButton(form, text, pressed) {
  const button = Object.assign(document.createElement('button'), {type: 'button', textContent: text});
  button.addEventListener('click', pressed);
  form.append(button);
}
