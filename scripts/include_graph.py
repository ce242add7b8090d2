"""Which source includes which header of the project."""
import hashlib
import os.path
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["src", "include/vspring", "cli", "tests", "benchmarks", "bindings/python", "bindings/wasm", "examples/cpp", "fuzz"]

# Where #include finds headers of the project, besides in the folder of the source.
INCLUDED_FROM = ["include", "src", "cli", "tests", "benchmarks", "benchmarks/peers"]

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)


def read_sources():
    """Every source and header of the project by its path."""
    folders = {*FOLDERS, *INCLUDED_FROM}
    return {path.relative_to(ROOT).as_posix(): path.read_text() for folder in folders for path in (ROOT / folder).rglob("*.[ch]pp")}


def direct_includes(where, sources):
    """What a source includes, headers of the project by their paths."""
    folders = [os.path.dirname(where), *INCLUDED_FROM]
    for name in INCLUDE.findall(sources[where]):
        paths = [os.path.normpath(f"{folder}/{name}") for folder in folders]
        yield next((path for path in paths if path in sources), name)


def all_includes(where, includes):
    """What a source includes itself and by headers of the project."""
    found, left = set(), [where]
    while left:
        new = includes.get(left.pop(), set()) - found
        found |= new
        left += new
    return found


def main():
    """Prints for each source that standard input names what stands for its text and that of all headers it includes."""
    sources = read_sources()
    includes = {where: set(direct_includes(where, sources)) for where in sources}
    digests = {where: hashlib.sha256(text.encode()).hexdigest() for where, text in sources.items()}
    for where in sys.stdin.read().split():
        parts = sorted(f"{name} {digests[name]}" for name in {where, *all_includes(where, includes)} if name in digests)
        print(where, hashlib.sha256("\n".join(parts).encode()).hexdigest())


if __name__ == "__main__":
    main()
