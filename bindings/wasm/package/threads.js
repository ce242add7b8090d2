// The library with threads: vspringCore({ threads: 4 }).

module.exports = require('./load.js')('vspring_core_threads');
