// A static server on loopback, for trying the editor and for its tests: node serve.mjs [port].

import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.json': 'application/json' };

// folders: address prefix -> folder. shared: whether the page may share memory with its worker. Returns a promise of
// the server, listening on 127.0.0.1.
export function serve(folders, port = 0, shared = true) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    const prefix = Object.keys(folders).filter((start) => path.startsWith(start)).sort((a, b) => b.length - a.length)[0];
    const file = prefix && join(folders[prefix], normalize('/' + path.slice(prefix.length)), path.endsWith('/') ? 'index.html' : '');
    if (!file || !statSync(file, { throwIfNoEntry: false })?.isFile()) {
      response.writeHead(404).end('not found');
      return;
    }
    // The two policies let page and worker share memory, so a solution that is out of date can be ended soon.
    response.writeHead(200, {
      'Content-Type': types[extname(file)] ?? 'application/octet-stream',
      ...(shared ? { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' } : {}),
    });
    createReadStream(file).pipe(response);
  });
  return new Promise((done, failed) => server.on('error', failed).listen(port, '127.0.0.1', () => done(server)));
}

if (process.argv[1] === new URL(import.meta.url).pathname) {
  const server = await serve({ '/': new URL('../build/editor', import.meta.url).pathname }, Number(process.argv[2] ?? 8000));
  console.log(`http://127.0.0.1:${server.address().port}/`);
}
