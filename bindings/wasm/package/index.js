// In node: the library, with its WebAssembly from beside it. Pages load vspring_core.js themselves.

module.exports = require('./load.js')('vspring_core');
