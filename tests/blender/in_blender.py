"""Runs test_*.py of this folder in Blender; what stands after -- chooses tests."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

support.install()
names = sys.argv[sys.argv.index("--") + 1:]
loader = unittest.defaultTestLoader
suite = loader.loadTestsFromNames(names) if names else loader.discover(str(pathlib.Path(__file__).parent))
sys.exit(not unittest.TextTestRunner(verbosity=1).run(suite).wasSuccessful())
