"""The library for JavaScript as npm installs it, its example page, and the editor as any server serves it."""
import functools
import http.server
import json
import re
import sys
import threading
import time
import unittest
import zipfile

from support import ROOT, VERSION, Case

sys.path.insert(0, str(ROOT / "tests/cli"))
from browser import Browser  # noqa: E402

METHODS = """
const core = await (await import('vspring')).default();
const methods = (of) => Object.getOwnPropertyNames(of.prototype ?? of).filter((name) => typeof (of.prototype ?? of)[name] === 'function');
const inherited = ['constructor', 'clone', 'deleteLater', 'isAliasOf', 'isDeleted', 'delete'];
console.log(JSON.stringify(Object.fromEntries(['Curve', 'Points', 'Surface'].map((name) => [name, methods(core[name]).filter((method) => !inherited.includes(method)).sort()]))));
"""

TYPED = """
import vspringCore from 'vspring';
import type { Report, Surface } from 'vspring';
export async function fair(bytes: Uint8Array): Promise<Float64Array> {
  const core = await vspringCore();
  const surface: Surface = new core.Surface(bytes, 'part.ply');
  const report: Report = surface.fair((fraction) => fraction > 0.5);
  // @ts-expect-error: what is not there is an error
  surface.fairly();
  return report.iterations > 0 ? surface.positions() : core.Curve.through(surface.positions(), true).positions();
}
"""


class Web(Case):
    def served(self, folder):
        """The address of a plain server."""
        class Quiet(http.server.SimpleHTTPRequestHandler):
            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(folder)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        return f"http://127.0.0.1:{server.server_address[1]}/"

    def shown(self, address, expression, awaited):
        """What the expression says, once it matches; nothing goes wrong, and nobody else is asked."""
        browser = Browser()
        self.addCleanup(browser.close)
        browser.visit(address)
        end = time.monotonic() + 120
        while not re.search(awaited, text := str(browser.evaluate(expression))):
            self.assertLess(time.monotonic(), end, f"{text} {browser.faults}")
            time.sleep(0.1)
        self.assertEqual(browser.faults, [])
        host = address.split("/")[2]
        self.assertEqual([url for url in browser.requests if not url.startswith(("data:", "blob:")) and url.split("/")[2] != host], [])
        return text

    def test_npm(self):
        (self.folder / "package.json").write_text('{"name": "user", "private": true, "type": "module"}')
        self.call("npm", "install", "--offline", "--no-audit", "--no-fund", "--silent", self.package(f"vspring-{VERSION}.tgz"), HOME=str(self.folder))
        installed = self.folder / "node_modules/vspring"
        self.assertEqual(json.loads((installed / "package.json").read_text())["version"], VERSION)
        self.assertIn("converged", self.call("node", installed / "example/fair.mjs", self.hat(), "fair.ply"))
        self.assertTrue((self.folder / "fair.ply").read_bytes().startswith(b"ply"))
        (block,) = re.findall(r"^```js\n(.*?)^```$", (ROOT / "docs/quick-start.md").read_text(), re.MULTILINE | re.DOTALL)
        (self.folder / "quick-start.mjs").write_text(block)
        (self.folder / "examples").symlink_to(ROOT / "examples")
        self.assertEqual(self.call("node", "quick-start.mjs"), "converged\n")
        self.assertTrue((self.folder / "blend.obj").exists())
        self.call("node", "-e", "require('vspring/threads')({threads: 2}).then((core) => core.PThread.terminateAllThreads())")

        # Types: every class has the calls that it says, and a program in TypeScript is checked by them.
        (self.folder / "methods.mjs").write_text(METHODS)
        methods = json.loads(self.call("node", "methods.mjs"))
        types = (installed / "vspring_core.d.ts").read_text()
        body = lambda name: re.search(rf"interface {name}\b[^{{]*\{{(.*?)^  \}}", types, re.MULTILINE | re.DOTALL).group(1)
        told = lambda name: set(re.findall(r"^    (\w+)\(", body(name), re.MULTILINE)) - {"delete"}
        self.assertEqual(set(methods["Surface"]), told("Shape") | told("Surface"))
        self.assertEqual(set(methods["Curve"]), told("Shape") | told("Curve"))
        self.assertEqual(set(methods["Points"]), told("Points"))
        (self.folder / "typed.ts").write_text(TYPED)
        self.call(ROOT / "editor/node_modules/.bin/tsc", "--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--types", "", "typed.ts")

        self.shown(self.served(installed) + "example/index.html", "document.getElementById('told').textContent", r"^hat.obj: converged")

    def test_editor(self):
        with zipfile.ZipFile(self.package(f"vspring-editor-{VERSION}.zip")) as packed:
            packed.extractall(self.folder)
        # It opens an example, and the library fairs it.
        self.shown(self.served(self.folder / "vspring-editor"), "document.body.innerText", r"Done · nodes moved")


if __name__ == "__main__":
    unittest.main()
