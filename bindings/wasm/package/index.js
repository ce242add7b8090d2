// In node: the library, with the WebAssembly file next to it. Pages load vspring_core.js themselves.

module.exports = require('./load.js')('vspring_core');
