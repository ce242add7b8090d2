"""Shapes of every size and number: huge and tiny coordinates, faces of many sides, hubs, many components, and files that
promise more than they have."""
import json
import math
import os
import resource
import signal
import struct
import subprocess

from support import PROGRAM, Case, grid, run, vertex_lines


def scaled(text, factor):
    """An OBJ with every coordinate times a power of ten, in the digits that it has."""
    lines = []
    for line in text.splitlines():
        if line.startswith("v "):
            line = "v " + " ".join(repr(float(part) * factor) for part in line.split()[1:])
        lines.append(line)
    return "\n".join(lines) + "\n"


def places(path):
    return [tuple(map(float, line.split()[1:4])) for line in vertex_lines(path.read_text())]


class Limits(Case):
    def fair(self, text, *options, status=0):
        path, out, report = self.write("in.obj", text), self.folder / "out.obj", self.folder / "report.json"
        result = run("fair", path, "-o", out, "--quiet", "--report", report, *options)
        self.assertEqual(result.returncode, status, result.stderr)
        return places(out), json.loads(report.read_text())

    def test_huge_and_tiny_coordinates_give_the_same_shape(self):
        text = grid(12)
        plain, _ = self.fair(text)
        for factor in (1e150, 1e-150, 1e30, 1e-30):
            large, report = self.fair(scaled(text, factor))
            self.assertEqual(report["outcome"], "converged", factor)
            for a, b in zip(plain, large, strict=True):
                self.assertLess(math.dist(a, [part / factor for part in b]), 1e-4, factor)

    def test_a_small_shape_far_from_the_origin(self):
        text = grid(12)
        plain, _ = self.fair(text)
        lines = [f"v {float(x) + 1e6} {float(y) - 1e6} {float(z) + 1e6}" for _, x, y, z in (line.split() for line in vertex_lines(text))]
        moved, report = self.fair("\n".join(lines + [line for line in text.splitlines() if line.startswith("f")]) + "\n")
        self.assertEqual(report["outcome"], "converged")
        for a, b in zip(plain, moved, strict=True):
            self.assertLess(math.dist(a, (b[0] - 1e6, b[1] + 1e6, b[2] - 1e6)), 1e-4)

    def test_a_face_of_many_sides(self):
        path = self.folder / "polygon.obj"
        self.assertEqual(run("generate", "polygon-patch", "--sides", "300", "--rings", "2", "--half-angle", "60", "-o", path).returncode, 0)
        after, report = self.fair(path.read_text(), "--fix-normals", "boundary")
        self.assertEqual((report["outcome"], report["nodes"], report["moving_nodes"]), ("converged", 900, 600))
        self.assertTrue(all(math.isfinite(part) for place in after for part in place))

    def test_a_node_of_a_thousand_neighbours(self):
        count = 1000
        angles = [2 * math.pi * k / count for k in range(count)]
        lines = ["v 0 0 0.7"] + [f"v {math.cos(a)!r} {math.sin(a)!r} 0" for a in angles]
        lines += [f"f 1 {k + 2} {(k + 1) % count + 2}" for k in range(count)]
        after, report = self.fair("\n".join(lines) + "\n")
        self.assertEqual(report["outcome"], "converged")
        self.assertLess(math.dist(after[0], (0, 0, 0)), 1e-4, "the hub lies in the plane of the rim")

    def test_a_thousand_components(self):
        lines = []
        for part in range(1000):
            lines += [f"v {5 * (part % 40) + k % 4} {5 * (part // 40) + k // 4} {1 if k == 5 else 0}" for k in range(16)]
            lines += [f"f {a} {a + 1} {a + 5} {a + 4}" for a in (16 * part + 4 * y + x + 1 for y in range(3) for x in range(3))]
        after, report = self.fair("\n".join(lines) + "\n")
        self.assertEqual((report["outcome"], report["moving_nodes"]), ("converged", 4000))
        self.assertLess(max(abs(z) for _, _, z in after), 1e-3, "each is flat, as its rim is")

    def test_eight_at_once_give_the_same_bits(self):
        path = self.write("in.obj", grid(40))
        outputs = [self.folder / f"out{k}.obj" for k in range(8)]
        processes = [subprocess.Popen([PROGRAM, "fair", path, "-o", out, "--quiet", "--threads", str(1 + k % 4)]) for k, out in enumerate(outputs)]
        self.assertEqual([process.wait(timeout=300) for process in processes], [0] * 8)
        self.assertEqual({out.read_bytes() for out in outputs}, {outputs[0].read_bytes()})

    def test_a_time_limit_ends_fits_and_curves_with_a_shape(self):
        surface = self.write("in.obj", grid(100))
        curve = self.write("wave.csv", "x,y\n" + "".join(f"{k},{(k * k * k) % 11}\n" for k in range(30000)))
        report = self.folder / "report.json"
        for command, path, options in (("fit", surface, ("--points", surface, "--weight", "0.001", "--method", "sweep", "--step-tolerance", "1e-30",
                                                         "--max-iterations", "100000000")),
                                       ("curve", curve, ("--method", "sweep", "--step-tolerance", "1e-30", "--max-iterations", "100000000"))):
            out = self.folder / ("out" + path.suffix)
            result = run(command, path, "-o", out, "--quiet", "--time-limit", "3", "--report", report, *options)
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertEqual(json.loads(report.read_text())["outcome"], "work-limit", command)
            self.assertIn("--time-limit", result.stderr.decode())
            self.assertEqual(len(out.read_text().splitlines()), len(path.read_text().splitlines()))
            self.assertNotEqual(out.read_text(), path.read_text())

    def test_promises_are_refused_before_memory_is_taken(self):
        head = "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n" \
               "element face {}\nproperty list uchar int vertex_indices\nend_header\n"
        nodes = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        files = {
            "faces.ply": head.format(3, 4_000_000_000).encode() + nodes,
            "nodes.ply": head.format(4_000_000_000, 1).encode() + nodes,
            "list.ply": head.format(3, 1).replace("uchar", "uint").encode() + nodes + struct.pack("<I", 4_000_000_000),
            "text.ply": head.format(3, 4_000_000_000).replace("binary_little_endian", "ascii").encode() + b"0 0 0\n1 0 0\n0 1 0\n",
            "facets.stl": bytes(80) + struct.pack("<I", 4_000_000_000) + bytes(50),
            "faces.off": b"OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "nodes.off": b"OFF\n4000000000 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "corners.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
            # Numbers of nodes above 2^31 and 2^63.
            "index.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2147483651\n",
            "wide.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 18446744073709551619\n",
            "back.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4294967295\n",
            "index.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 4294967298\n",
            "index.ply": (head.format(3, 1).replace("int vertex", "uint vertex").encode() + nodes + struct.pack("<B3I", 3, 0, 1, 2**32 - 1)),
        }
        for name, content in files.items():
            with self.subTest(name):
                path = self.write(name, content)
                # An address space of 2 GiB is half of what the promise would take, and more than sanitizers bear.
                limit = None if "asan" in PROGRAM else lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 31, 1 << 31))
                result = subprocess.run([PROGRAM, "fair", path, "-o", self.folder / "out.obj"], capture_output=True, timeout=60, preexec_fn=limit)
                self.assertEqual(result.returncode, 2, result.stderr)
                line = self.assert_one_line(result)
                self.assertIn(name, line)
                self.assertNotIn("memory", line)
                self.assertNotIn("out.obj", self.files())

    def test_what_never_ends_is_refused(self):
        path, out, pipe = self.write("in.obj", grid(3)), self.folder / "out.obj", self.folder / "pipe"
        os.mkfifo(pipe)
        for arguments, name in ((("fair", "/dev/zero"), "/dev/zero"), (("curve", "-"), "standard input"),
                                (("fair", path, "--constraints", pipe), str(pipe)), (("fair", path, "--region", "/dev/zero"), "/dev/zero")):
            with self.subTest(arguments):
                with subprocess.Popen([PROGRAM, *map(str, arguments), "-o", out], stdin=subprocess.PIPE, stderr=subprocess.PIPE) as program:
                    feeder = subprocess.Popen(f"yes > '{pipe}'" if pipe in arguments else "yes", shell=True, stderr=subprocess.DEVNULL,
                                              stdout=program.stdin, start_new_session=True)
                    program.stdin.close()
                    line = program.stderr.read().decode()
                    self.assertEqual((program.wait(timeout=60), line.count("\n")), (2, 1), line)
                    os.killpg(feeder.pid, signal.SIGKILL)
                    feeder.wait()
                self.assertIn(f"{name}: gives more than 1 GiB; save it as a file", line)
                self.assertEqual(self.files(), ["in.obj", "pipe"])

    def test_rules_of_many_and_deep_levels_are_refused(self):
        path = self.write("in.obj", grid(3))
        for text in ("[" * 100_000, '{"rules": ' * 50_000, '{"rules": [{"nodes": [' + "0," * 100_000 + "0]}]}",
                     '{"rules": [{"nodes": [4294967296], "position": "fixed"}]}', '{"rules": [{"nodes": [1e300], "position": "fixed"}]}'):
            result = run("fair", path, "-o", self.folder / "out.obj", "--constraints", self.write("rules.json", text))
            self.assertEqual(result.returncode, 2, text[:40])
            self.assertLess(len(self.assert_one_line(result)), 1000, text[:40])
