// Errors of C++ are thrown here, after it has returned: JavaScript errors would skip C++ destructors. So those of a
// progress function end the call, too, before they are thrown. (Emscripten's optimiser reads JavaScript of 2018.)
addOnInit(() => {
  // Where the shapes and points are that calls work on whose progress function runs.
  const busy = new Set();
  const changes = /^(delete|fair|fill|fit|free|hold|predict|resample|set|update)/;
  const addressOf = (one) => (one && one.$$ ? one.$$.ptr : undefined);
  const checked = (made) => {
    const message = Module['fault'];
    if (message === undefined) return made;
    Module['fault'] = undefined;
    if (made && made.delete) made.delete();
    throw new Error(message);
  };
  const checking = (name, call) => function (...given) {
    if (changes.test(name) && busy.has(addressOf(this)))
      throw new Error(`busy: ${name}() would change what a call works on that is reporting its progress; do it after that call`);
    const progress = given.findIndex((one) => typeof one === 'function');
    if (progress < 0) return checked(call.apply(this, given));
    const faults = [];
    const tell = given[progress];
    given[progress] = (fraction) => {
      try {
        return tell(fraction);
      } catch (fault) {
        faults.push(fault);
        return true;
      }
    };
    const used = [this, ...given].map(addressOf).filter((one) => one !== undefined && !busy.has(one));
    used.forEach((one) => busy.add(one));
    try {
      const made = checked(call.apply(this, given));
      if (faults.length > 0) throw faults[0];
      return made;
    } finally {
      used.forEach((one) => busy.delete(one));
    }
  };
  const wrap = (from, to) => {
    for (const name of Object.getOwnPropertyNames(from)) {
      const { value, writable } = Object.getOwnPropertyDescriptor(from, name);
      if (name !== 'constructor' && writable && typeof value === 'function') to[name] = checking(name, value);
    }
  };
  for (const name of ['Curve', 'Points', 'Surface']) {
    const plain = Module[name];
    const Checked = function (...given) { return checked(new plain(...given)); };
    Checked.prototype = plain.prototype;
    wrap(plain.prototype, plain.prototype);
    for (const inherited of ['delete', 'deleteLater']) plain.prototype[inherited] = checking(inherited, plain.prototype[inherited]);
    wrap(plain, Checked);
    Module[name] = Checked;
  }
});
