const { readFileSync } = require('node:fs');
const { join } = require('node:path');

module.exports = (name) => (options) => require(`./${name}.js`)({ wasmBinary: readFileSync(join(__dirname, `${name}.wasm`)), ...options });
