"""How much memory the program takes at its peak for each node. LIMITS=all fairs 4,000,000 nodes too, in three minutes."""
import json
import os
import resource
import unittest

from support import Case, run

GIBIBYTE = 2**30


class Memory(Case):
    def peak_of_fairing(self, nodes):
        """Bytes that the largest child so far had."""
        path, out, report = self.folder / "cap.ply", self.folder / "out.ply", self.folder / "report.json"
        edge = (3.14 / nodes)**0.5
        made = run("generate", "cap", "--nodes", str(nodes), "--jitter", "0.3", "--noise", str(0.01 * edge), "-o", path)
        self.assertEqual(made.returncode, 0, made.stderr)
        result = run("fair", path, "-o", out, "--fix-normals", "boundary", "--threads", "2", "--quiet", "--report", report)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(report.read_text())["springs"], "sphere")
        return 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss

    def test_a_node_takes_less_than_930_bytes(self):
        nodes = 250_000
        self.assertLess(self.peak_of_fairing(nodes), 930 * nodes)

    @unittest.skipUnless(os.environ.get("LIMITS") == "all", "takes three minutes")
    def test_four_million_nodes_take_less_than_three_gibibytes(self):
        self.assertLess(self.peak_of_fairing(4_000_000), 3 * GIBIBYTE)


if __name__ == "__main__":
    unittest.main()
