"""The editor as it is served: who is answered and who is not, what is written and when, and how it ends."""
import gzip
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess

from served import Served
from support import PROGRAM, hat, run


class Edit(Served):
    def test_serves_page_and_file_and_saves_when_told(self):
        path = self.write("a hat & more.obj", hat())
        self.start(path, "--no-browser")
        self.assertEqual(self.address.hostname, "127.0.0.1")
        answer, content = self.ask("GET", self.address.path)
        self.assertEqual(content, b"<!doctype html>the page")
        self.assertEqual(answer.headers["Cross-Origin-Opener-Policy"], "same-origin")
        self.assertEqual(answer.headers["Cross-Origin-Embedder-Policy"], "require-corp")
        self.assertEqual(answer.headers["X-Frame-Options"], "DENY")
        self.assertEqual(self.ask("GET", self.address.path + "vspring_core.wasm")[0].headers["Content-Type"], "application/wasm")

        file = self.address.path + self.query["file"][0]
        self.assertTrue(file.endswith("/a%20hat%20%26%20more.obj"), file)
        self.assertEqual(self.ask("GET", file)[1].decode(), hat())
        self.assertEqual(self.ask("GET", self.address.path + "shape/other.obj")[0].status, 404)
        self.assertEqual(self.ask("PUT", self.address.path + "shape/other.obj", b"v")[0].status, 404)
        self.assertEqual(self.ask("PUT", file, b"")[0].status, 400)
        self.assertEqual(path.read_text(), hat())

        self.assertEqual(self.ask("PUT", self.address.path + self.query["save"][0], b"v 1 2 3\n")[0].status, 204)
        self.assertEqual(path.read_bytes(), b"v 1 2 3\n")
        self.assertEqual(self.ask("GET", file)[1], b"v 1 2 3\n")
        self.assertEqual(self.files(), ["a hat & more.obj", "page"])
        self.assertIn(f"Saved {path}", self.end())

    def test_saves_to_another_file_and_says_why_it_cannot(self):
        path = self.write("in.obj", hat())
        folder = self.folder / "results"
        folder.mkdir()
        self.start(path, "-o", folder / "out.ply", "--no-browser")
        save = self.address.path + self.query["save"][0]
        self.assertTrue(save.endswith("/out.ply"))
        self.assertEqual(self.ask("PUT", save, b"ply\n")[0].status, 204)
        self.assertEqual((folder / "out.ply").read_bytes(), b"ply\n")
        self.assertEqual(path.read_text(), hat())
        self.assertEqual(self.ask("PUT", self.address.path + "shape/in.obj", b"v")[0].status, 404)
        (folder / "out.ply").unlink()
        folder.rmdir()
        answer, content = self.ask("PUT", save, b"ply\n")
        self.assertEqual(answer.status, 500)
        self.assertIn(b"out.ply: cannot be written", content)
        self.end(signal.SIGTERM)

    def test_answers_nobody_else(self):
        path = self.write("in.obj", hat())
        self.start(path, "--no-browser")
        word = self.address.path.strip("/")
        self.assertRegex(word, "^[0-9a-f]{32}$")
        file = self.address.path + self.query["file"][0]
        here = f"127.0.0.1:{self.address.port}"
        self.assertEqual(self.ask("GET", file, Origin=f"http://{here}")[0].status, 200)
        for method in ("GET", "PUT"):
            for path_asked, headers in (("/", {}), ("/" + "0" * 32 + "/", {}), (file.replace(word, "0" * 32), {}), ("/" + file.split("/", 2)[2], {}),
                                        (file, {"Origin": "http://elsewhere.example"}), (file, {"Origin": "null"}),
                                        (file, {"Origin": f"https://{here}"}), (file, {"Origin": "http://127.0.0.1:1"}),
                                        (file, {"Host": f"elsewhere.example:{self.address.port}"}), (file, {"Host": "127.0.0.1:1"})):
                answer, content = self.ask(method, path_asked, b"v" if method == "PUT" else None, **headers)
                self.assertEqual(answer.status, 403, (method, path_asked, headers))
                self.assertNotIn(b"v 0", content)
        self.assertEqual(self.ask("GET", self.address.path + "../in.obj")[0].status, 404)
        self.assertEqual(path.read_text(), hat())
        self.end()

    def test_another_word_each_time_and_no_file_needed(self):
        words = []
        for _ in range(2):
            self.start("--no-browser", "--quiet")
            self.assertEqual(self.address.query, "")
            self.assertEqual(self.ask("PUT", self.address.path + "shape/", b"v")[0].status, 404)
            words.append(self.address.path)
            self.assertEqual(self.end(), "")
        self.assertNotEqual(*words)

    def test_opens_the_browser_with_the_address(self):
        opened = self.folder / "opened"
        script = self.write("xdg-open", f"#!/bin/sh\necho \"$1\" > '{opened}.part'\n/bin/mv '{opened}.part' '{opened}'\n")
        script.chmod(0o755)
        os.mkfifo(self.folder / "wait")
        script.write_text(script.read_text() + f": > '{self.folder}/wait'\n")
        self.start(self.write("in.obj", hat()))
        (self.folder / "wait").read_bytes()
        self.assertEqual(opened.read_text().strip(), self.address.geturl())
        self.end()
        script.unlink()
        self.start()
        self.assertIn("open this address in a browser", self.end())

    def test_finds_the_page_that_is_installed_with_it(self):
        program = self.folder / "bin" / "vspring"
        program.parent.mkdir()
        shutil.copy(PROGRAM, program)
        self.environment["VSPRING_EDITOR"] = ""
        result = subprocess.run([program, "edit", "--no-browser"], capture_output=True, env={**os.environ, **self.environment}, timeout=60)
        self.assertEqual(result.returncode, 2)
        self.assertIn("run ./edit", self.assert_one_line(result))
        (self.folder / "share" / "vspring").mkdir(parents=True)
        self.page.rename(self.folder / "share" / "vspring" / "editor")
        self.start("--no-browser", program=program)
        self.assertEqual(self.ask("GET", self.address.path)[1], b"<!doctype html>the page")
        self.end()

    def test_refusals(self):
        path = self.write("in.obj", hat())

        def refused(status, words, *arguments, environment=None):
            result = run("edit", *arguments, "--no-browser", environment={**self.environment, **(environment or {})})
            self.assertEqual(result.returncode, status)
            self.assertIn(words, self.assert_one_line(result))
            self.assertEqual(result.stdout, b"")

        refused(2, "none.obj: cannot be read: No such file", self.folder / "none.obj")
        refused(2, "page.obj: cannot be read: No such file", self.folder / "page.obj")
        refused(2, "name one that ends in .obj", self.write("in.txt", hat()))
        refused(2, "name one that ends in .obj", path, "-o", self.folder / "out.txt")
        refused(2, "out.obj: cannot be written", path, "-o", self.folder / "none" / "out.obj")
        refused(2, "not the built editor", path, environment={"VSPRING_EDITOR": str(self.folder)})
        refused(1, "--port", path, "--port", "0")
        refused(1, "shape", "-o", self.folder / "out.obj")
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            refused(2, "choose another by --port", path, "--port", str(taken.getsockname()[1]))
        self.assertEqual(path.read_text(), hat())


class Hostile(Served):
    """Other programs of this machine, with the address and without."""

    def setUp(self):
        super().setUp()
        self.path = self.write("in.obj", hat())
        self.start(self.path, "--no-browser")
        self.file = self.address.path + self.query["file"][0]
        self.here = f"127.0.0.1:{self.address.port}"
        self.addCleanup(lambda: self.assertEqual(self.path.read_text(), hat(), "nothing has been written"))

    def connect(self):
        connection = socket.create_connection((self.address.hostname, self.address.port), timeout=60)
        self.addCleanup(connection.close)
        return connection

    def send(self, request):
        """The whole answer to those bytes, as far as the server takes them."""
        connection = self.connect()
        answer = b""
        try:
            connection.sendall(request)
            connection.shutdown(socket.SHUT_WR)
            while piece := connection.recv(65536):
                answer += piece
        except (BrokenPipeError, ConnectionResetError):
            pass
        connection.close()
        return answer

    def head(self, method, path=None, *lines):
        return "\r\n".join((f"{method} {path or self.file} HTTP/1.1", f"Host: {self.here}", *lines, "", "")).encode()

    def assert_still_serves(self):
        self.assertEqual(self.ask("GET", self.file)[1].decode(), hat())

    def memory(self):
        """The most that the server has taken, in MiB."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1]) / 1024

    def test_paths_lead_nowhere_else(self):
        secret = self.write("secret.txt", "secret")
        word = self.address.path
        for path in ("../secret.txt", "shape/../../secret.txt", "%2e%2e/secret.txt", "..%2fsecret.txt", "%2e%2e%2fsecret.txt", "..\\secret.txt",
                     "./../secret.txt", "shape/..%2f..%2fsecret.txt", "//" + str(secret), str(secret), "%2f" + str(secret), "shape/secret.txt",
                     "index.html/../../secret.txt", "..%00/secret.txt", "shape/in.obj%00.txt", "shape/in.obj/", "%", "%zz", "?file=../secret.txt",
                     "a" * 8000, "../" * 2000 + "etc/passwd"):
            for asked in (word + path, "/" + path):
                for method in ("GET", "HEAD", "PUT"):
                    answer = self.send(self.head(method, asked, "Content-Length: 1", "Connection: close") + b"v")
                    self.assertNotIn(b"secret\r", answer + b"\r", (method, asked))
                    self.assertNotIn(b"root:", answer, (method, asked))
                    if method == "PUT":
                        self.assertNotRegex(answer, rb"^HTTP/1.1 2", (method, asked))
        self.assertEqual(secret.read_text(), "secret")
        self.assertEqual(self.files(), ["in.obj", "page", "secret.txt"])
        self.assert_still_serves()
        self.end()

    def test_half_a_file_is_not_saved(self):
        save = self.address.path + self.query["save"][0]
        for lines, body in ((["Content-Length: 1000"], b"v 0 0 0\n"), (["Transfer-Encoding: chunked"], b"8\r\nv 0 0 0\n\r\n"),
                            (["Transfer-Encoding: chunked"], b"8\r\nv 0 0"), (["Transfer-Encoding: chunked"], b"zz\r\nv 0 0 0\r\n0\r\n\r\n"),
                            (["Content-Length: -1"], b"v"), (["Content-Length: 1000000000000000000"], b"v"),
                            (["Content-Length: 99999999999999999999999"], b"v"), (["Content-Length: ten"], b"v"), ([], b""),
                            (["Content-Encoding: gzip", "Content-Length: 30"], gzip.compress(b"v 0 0 0\n" * 1000)[:30])):
            answer = self.send(self.head("PUT", save, *lines) + body)
            self.assertNotRegex(answer, rb"^HTTP/1.1 2", (lines, answer))
            self.assertEqual(self.path.read_text(), hat(), lines)
        bomb = gzip.compress(bytes(200_000_000), 1)
        answer = self.send(self.head("PUT", save, "Content-Encoding: gzip", f"Content-Length: {len(bomb)}") + bomb)
        self.assertRegex(answer, rb"^HTTP/1.1 415")
        self.assertLess(self.memory(), 150)
        self.assert_still_serves()
        self.end()

    def test_what_is_no_request_is_answered_or_dropped_and_takes_no_memory(self):
        draw = random.Random(11)
        whole = self.head("GET")
        requests = [draw.randbytes(draw.randrange(1, 400)) for _ in range(60)]
        for _ in range(100):
            broken = bytearray(whole)
            for _ in range(draw.randrange(1, 6)):
                broken[draw.randrange(len(broken))] = draw.randrange(256)
            requests.append(bytes(broken))
        requests += [b"", b"\r\n" * 100, b"GET", whole[:-2], b"GET / HTTP/9.9\r\n\r\n", whole.replace(b"Host", b"Hos"), whole.replace(b"GET", b"BREW"),
                     whole.replace(b"\r\n\r\n", b"\r\nRange: bytes=9-1,-,x\r\n\r\n"), b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"]
        for request in requests:
            answer = self.send(request)
            if request.splitlines()[:2] != whole.splitlines()[:2]:
                self.assertNotIn(b"\nv 0 0 1", answer, request)
        line = b"X: " + bytes(16_000_000)
        for endless in (line, b"GET /" + line, b"X: y\r\n" * 2_000_000):
            self.assertNotIn(b"\nv 0 0 1", self.send(whole[:-2] + endless))
        self.assertLess(self.memory(), 150)
        self.assert_still_serves()
        self.end()

    def test_those_who_take_their_time_keep_nobody_waiting(self):
        slow = [self.connect() for _ in range(24)]
        for k, connection in enumerate(slow):
            connection.sendall(self.head("PUT", None, "Content-Length: 9")[:20 * (k % 3)])
        self.assert_still_serves()
        # A byte now and then does not help: whoever has not said what it wants in time is shown out.
        trickling = slow[0]
        letters = 0
        trickling.settimeout(0.3)
        while True:
            try:
                trickling.sendall(b"x")
                letters += 1
                if trickling.recv(1) == b"":
                    break
            except socket.timeout:
                self.assertLess(letters, 1000, "it is never shown out")
            except OSError:
                break
        for connection in slow[1:]:
            try:
                self.assertEqual(connection.recv(1), b"")
            except ConnectionResetError:
                pass
        self.assert_still_serves()
        self.end()

    def test_ends_whoever_is_connected(self):
        save = self.address.path + self.query["save"][0]
        connections = [self.connect() for _ in range(6)]
        for connection in connections:
            connection.sendall(self.head("PUT", save, "Content-Length: 1000") + b"v 0")
        self.assert_still_serves()
        self.end()
