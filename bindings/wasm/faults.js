// Errors of C++ are thrown here, after it has returned: JavaScript errors would skip C++ destructors. (Emscripten's
// optimiser reads JavaScript of 2018.)
addOnInit(() => {
  const checked = (made) => {
    const message = Module['fault'];
    if (message === undefined) return made;
    Module['fault'] = undefined;
    if (made && made.delete) made.delete();
    throw new Error(message);
  };
  const checking = (call) => function (...given) { return checked(call.apply(this, given)); };
  const wrap = (from, to) => {
    for (const name of Object.getOwnPropertyNames(from)) {
      const { value, writable } = Object.getOwnPropertyDescriptor(from, name);
      if (name !== 'constructor' && writable && typeof value === 'function') to[name] = checking(value);
    }
  };
  for (const name of ['Curve', 'Points', 'Surface']) {
    const plain = Module[name];
    const Checked = function (...given) { return checked(new plain(...given)); };
    Checked.prototype = plain.prototype;
    wrap(plain.prototype, plain.prototype);
    wrap(plain, Checked);
    Module[name] = Checked;
  }
});
