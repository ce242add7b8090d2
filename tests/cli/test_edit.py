"""The editor as it is served: who is answered and who is not, what is written and when, and how it ends."""
import http.client
import os
import shutil
import signal
import socket
import subprocess
import urllib.parse

from support import PROGRAM, Case, hat, run


class Edit(Case):
    def setUp(self):
        super().setUp()
        self.page = self.folder / "page"
        self.page.mkdir()
        (self.page / "index.html").write_text("<!doctype html>the page")
        (self.page / "vspring_core.wasm").write_bytes(b"\0asm")
        self.environment = {"VSPRING_EDITOR": str(self.page), "PATH": str(self.folder)}

    def start(self, *arguments, program=PROGRAM):
        """Starts it; reads the address that it prints."""
        process = subprocess.Popen([program, "edit", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, env={**os.environ, **self.environment})
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.process = process
        self.address = urllib.parse.urlsplit(process.stdout.readline().strip())
        self.query = urllib.parse.parse_qs(self.address.query)

    def ask(self, method, path, body=None, **headers):
        connection = http.client.HTTPConnection(self.address.hostname, self.address.port, timeout=60)
        connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer, content

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        _, errors = self.process.communicate(timeout=60)
        self.assertEqual(self.process.returncode, 0, errors)
        return errors

    def test_serves_page_and_file_and_saves_when_told(self):
        path = self.write("a hat & more.obj", hat())
        self.start(path, "--no-browser")
        self.assertEqual(self.address.hostname, "127.0.0.1")
        answer, content = self.ask("GET", self.address.path)
        self.assertEqual(content, b"<!doctype html>the page")
        self.assertEqual(answer.headers["Cross-Origin-Opener-Policy"], "same-origin")
        self.assertEqual(answer.headers["Cross-Origin-Embedder-Policy"], "require-corp")
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
