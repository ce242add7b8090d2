"""A program that serves the editor, with a page that stands for the built one."""
import http.client
import os
import signal
import subprocess
import urllib.parse

from support import PROGRAM, Case


class Served(Case):
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
