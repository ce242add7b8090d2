"""A headless Chromium, driven through its DevTools pipe; and pictures of what it shows."""
import base64
import fcntl
import itertools
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

# The one without windows takes less processor time.
PROGRAM = shutil.which("chromium-headless-shell") or shutil.which("chromium")
# Software drawing, the same on every machine. The sandbox needs rights that containers lack; the pages are our own.
OPTIONS = ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--remote-debugging-pipe", "--no-first-run", "--disable-extensions", "--disable-background-networking",
           "--disable-dev-shm-usage", "--hide-scrollbars", "--force-device-scale-factor=1"]


class Browser:
    """One page of one browser. `faults` has what the console complains of, `requests` the addresses that were asked for."""

    def __init__(self, width=640, height=560, hosts=""):
        """hosts: names that are to lead elsewhere, as --host-resolver-rules takes them."""
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.out = os.pipe()
        self.into, from_browser = os.pipe()
        # The pipe is on the descriptors 3 and 4; the shell puts it there, from others that are neither.
        to_browser, from_browser = (self.moved_up(descriptor) for descriptor in (to_browser, from_browser))
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{to_browser} 4>&{from_browser}', "bash", PROGRAM, *OPTIONS,
             f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}",
             f"--host-resolver-rules={hosts}", "about:blank"],
            pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.waiting = b""
        self.number = 0
        self.session = None
        self.faults = []
        self.requests = []
        self.loaded = False
        pages = [target for target in self.call("Target.getTargets")["targetInfos"] if target["type"] == "page"]
        self.session = self.call("Target.attachToTarget", targetId=pages[0]["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    @staticmethod
    def moved_up(descriptor):
        above = fcntl.fcntl(descriptor, fcntl.F_DUPFD, 10)
        os.close(descriptor)
        return above

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(10)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.out)
        os.close(self.into)
        self.profile.cleanup()

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def receive(self, seconds=180):
        while b"\0" not in self.waiting:
            if not select.select([self.into], [], [], seconds)[0]:
                raise RuntimeError("the browser does not answer")
            read = os.read(self.into, 1 << 20)
            if not read:
                raise RuntimeError("the browser has ended")
            self.waiting += read
        text, self.waiting = self.waiting.split(b"\0", 1)
        message = json.loads(text)
        self.note(message.get("method"), message.get("params", {}))
        return message

    def note(self, event, detail):
        if event == "Page.loadEventFired":
            self.loaded = True
        elif event == "Runtime.exceptionThrown":
            self.faults.append(detail["exceptionDetails"].get("exception", {}).get("description", "exception"))
        elif event == "Runtime.consoleAPICalled" and detail["type"] in ("error", "warning", "assert"):
            self.faults.append(str(detail["args"]))
        elif event == "Log.entryAdded" and detail["entry"]["level"] in ("error", "warning"):
            self.faults.append(detail["entry"]["text"])
        elif event == "Network.requestWillBeSent":
            self.requests.append(detail["request"]["url"])

    def open(self, path):
        """Shows a file; complaints and requests are those since then."""
        self.visit(path.as_uri())

    def visit(self, url):
        self.loaded, self.faults, self.requests = False, [], []
        self.call("Page.navigate", url=url)
        begin = time.monotonic()
        while not self.loaded:
            self.receive()
            if time.monotonic() - begin > 180:
                raise RuntimeError("the page does not load")
        self.settle()

    def theme(self, name):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])
        self.settle()

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(str(result["exceptionDetails"]))
        return result["result"].get("value")

    def settle(self):
        """Waits until what was asked for is painted."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def place(self, selector):
        box = self.evaluate(f"(() => {{ const e = document.querySelector({json.dumps(selector)}); e.scrollIntoView({{block: 'center'}});"
                            "const b = e.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        return box

    def click(self, selector):
        x, y, width, height = self.place(selector)
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x + width / 2, y=y + height / 2, button="left", clickCount=1)
        self.settle()

    def drag(self, selector, across, up):
        x, y, width, height = self.place(selector)
        x, y = x + width / 2, y + height / 2
        for kind, dx, dy in (("mousePressed", 0, 0), ("mouseMoved", across, up), ("mouseReleased", across, up)):
            self.call("Input.dispatchMouseEvent", type=kind, x=x + dx, y=y + dy, button="left", buttons=1, clickCount=1)
        self.settle()

    def wheel(self, selector, amount):
        x, y, width, height = self.place(selector)
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=x + width / 2, y=y + height / 2, deltaX=0, deltaY=amount)
        time.sleep(0.1)
        self.settle()

    def key(self, name, text=""):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name, text=text if kind == "keyDown" else "")
        self.settle()

    def screenshot(self, selector=None):
        """PNG of an element, or of the whole page."""
        if selector is None:
            return base64.b64decode(self.call("Page.captureScreenshot", captureBeyondViewport=True)["data"])
        self.place(selector)
        # Whole pixels: a picture of parts of them would be blurred.
        box = self.evaluate(f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                            "const [x, y, width, height] = [b.x + scrollX, b.y + scrollY, b.width, b.height].map(Math.round);"
                            "return {x, y, width, height, scale: 1}; })()")
        return base64.b64decode(self.call("Page.captureScreenshot", clip=box, optimizeForSpeed=True)["data"])

    def pixels(self, selector):
        return pixels_of(self.screenshot(selector))


class Picture(list):
    """Pixels as tuples of red, green and blue, row by row."""

    def __init__(self, width):
        super().__init__()
        self.width = width

    @property
    def height(self):
        return len(self) // self.width

    def around(self, x, y):
        """The nine pixels at a place in pixels."""
        column, row = int(x), int(y)
        return [self[k * self.width + i] for k in range(row - 1, row + 2) for i in range(column - 1, column + 2)]


def pixels_of(png):
    """The picture of a PNG of eight bits a channel."""
    at, data, header = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            data += body
        at += length + 12
    width, height, channels = header[0], header[1], {2: 3, 6: 4}[header[3]]
    raw, stride, last, pixels = zlib.decompress(data), width * channels, bytes(width * channels), Picture(width)
    for row in range(height):
        kind, line = raw[row * (stride + 1)], bytearray(raw[row * (stride + 1) + 1:(row + 1) * (stride + 1)])
        if kind == 1:
            for channel in range(channels):
                line[channel::channels] = bytes(total & 255 for total in itertools.accumulate(line[channel::channels]))
        elif kind == 2:
            line = bytearray((x + b) & 255 for x, b in zip(line, last))
        elif kind == 3:
            for i in range(stride):
                line[i] = (line[i] + ((line[i - channels] if i >= channels else 0) + last[i]) // 2) & 255
        elif kind == 4:
            for i in range(channels):
                line[i] = (line[i] + last[i]) & 255
            for i, b, c in zip(range(channels, stride), last[channels:], last):
                a = line[i - channels]
                to_a, to_b, to_c = abs(b - c), abs(a - c), abs(a + b - c - c)
                add = a if to_a <= to_b and to_a <= to_c else b if to_b <= to_c else c
                line[i] = (line[i] + add) & 255
        last = bytes(line)
        pixels += zip(*(last[channel::channels] for channel in range(3)))
    return pixels
