"""The editor beside pages of other origins, in a browser as people have it."""
import http.server
import threading
import unittest

from browser import PROGRAM as CHROMIUM
from browser import Browser
from served import Served
from support import hat

# What a page may try without the user: read, write, embed, and forms.
ATTACK = """
(async (address, file, save) => {
  const seen = {};
  const attempt = async (name, action) => {
    try { seen[name] = await action(); } catch (error) { seen[name] = 'refused'; }
  };
  const text = async (answer) => answer.type === 'opaque' ? 'opaque' : answer.status + ' ' + (await answer.text()).slice(0, 20);
  await attempt('read', async () => text(await fetch(file)));
  await attempt('readWithoutCors', async () => text(await fetch(file, {mode: 'no-cors'})));
  await attempt('write', async () => text(await fetch(save, {method: 'PUT', body: 'v 6 6 6'})));
  await attempt('post', async () => text(await fetch(save, {method: 'POST', mode: 'no-cors', body: 'v 6 6 6'})));
  await attempt('beacon', async () => String(navigator.sendBeacon(save, 'v 6 6 6')));
  const loads = (element, place, url) => new Promise((done) => {
    element.onload = () => done('loaded');
    element.onerror = () => done('refused');
    element[place] = url;
    document.body.append(element);
  });
  await attempt('image', () => loads(document.createElement('img'), 'src', address + 'picture.png'));
  await attempt('script', () => loads(document.createElement('script'), 'src', address + 'main.js'));
  await attempt('frame', async () => {
    const frame = document.createElement('iframe');
    await loads(frame, 'src', address);
    return frame.contentDocument ? frame.contentDocument.body.textContent : 'refused';
  });
  await attempt('socket', () => new Promise((done) => {
    const socket = new WebSocket(file.replace('http:', 'ws:'));
    socket.onopen = () => done('open');
    socket.onerror = () => done('refused');
  }));
  return seen;
})
"""


class OtherOrigin(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<!doctype html><title>elsewhere</title><body></body>")

    def log_message(self, *arguments):
        pass


@unittest.skipUnless(CHROMIUM, "needs Chromium")
class OtherPages(Served):
    def setUp(self):
        super().setUp()
        (self.page / "main.js").write_text("window.seen = 1;")
        # The smallest picture there is.
        (self.page / "picture.png").write_bytes(bytes.fromhex(
            "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c6360606060000000050001a5f645400000000049454e44ae426082"))
        self.path = self.write("in.obj", hat())
        self.start(self.path, "--no-browser")

    def browse(self, url):
        browser = Browser(hosts="MAP elsewhere.example 127.0.0.1")
        self.addCleanup(browser.close)
        browser.visit(url)
        return browser

    def attack(self, browser, address):
        text = f"{ATTACK}({address!r}, {address + self.query['file'][0]!r}, {address + self.query['save'][0]!r})"
        return browser.evaluate(text)

    def test_a_page_of_another_origin_learns_and_writes_nothing(self):
        other = http.server.ThreadingHTTPServer(("127.0.0.1", 0), OtherOrigin)
        threading.Thread(target=other.serve_forever, daemon=True).start()
        self.addCleanup(other.server_close)
        self.addCleanup(other.shutdown)
        # Even one that knows the address, from another port and by another name.
        for origin in (f"http://127.0.0.1:{other.server_port}", f"http://elsewhere.example:{other.server_port}"):
            seen = self.attack(self.browse(origin + "/"), f"http://127.0.0.1:{self.address.port}{self.address.path}")
            self.assertEqual(seen.pop("beacon"), "true", "sent, at least")
            self.assertEqual(set(seen.values()) - {"refused", "opaque"}, set(), seen)
            self.assertEqual(self.path.read_text(), hat())
        self.end()

    def test_a_name_that_is_made_to_lead_here_is_not_answered(self):
        rebound = f"http://elsewhere.example:{self.address.port}{self.address.path}"
        browser = self.browse(rebound)
        self.assertIn("Not from here", browser.evaluate("document.body.textContent"))
        seen = self.attack(browser, rebound)
        self.assertRegex(seen["read"], "^403 ")
        self.assertRegex(seen["write"], "^403 ")
        self.assertEqual(self.path.read_text(), hat())
        # The same page under its own name may do all that.
        own = f"http://127.0.0.1:{self.address.port}{self.address.path}"
        seen = self.attack(self.browse(own), own)
        self.assertRegex(seen["read"], "^200 # a hat")
        self.assertRegex(seen["write"], "^204")
        self.assertEqual(self.path.read_text(), "v 6 6 6")
        self.end()


if __name__ == "__main__":
    unittest.main()
