"""What `./check --quick` runs for what has changed since it last passed: test programs and documents by the paths that changed, unit
tests and claims by the objects of build/dev whose code did."""
import hashlib
import json
import pathlib
import re
import subprocess
import sys

from gtest_sources import tests_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/dev"
RECORD = ROOT / "build/check/quick-passed.json"

# Tests of the command line that take half a minute at most.
QUICK_COMMAND_LINE = "bad_input edit fair fill measure options refine remesh scalars terminal weld"

# Paths, all of which a row matches from end to end; the step, and what it is given: names of tests, or nothing for all of them.
CHOICE = [
    # All that is compiled by the preset dev. What it leaves out is compiled by another step.
    (r"(include|src|cli|benchmarks(?!/peers)|tests/(unit|claims|support|corpus|sessions))/.*\.[ch]pp|CMakePresets\.json", "build", ""),
    (r"((cli|benchmarks|tests|tests/cli|tests/corpus|tests/sessions)/)?CMakeLists\.txt|cmake/.*\.(cmake|in|map|hxx)", "build", ""),
    (r"cli/.*\.[ch]pp|tests/cli/(support|polylines)\.py", "command line", QUICK_COMMAND_LINE),
    (r"tests/cli/test_(\w+)\.py", "command line", r"\1"),
    (r"tests/cli/(cases|faults)/.*", "command line", r"\1"),
    (r"tests/cli/served\.py|edit", "command line", "edit"),
    (r"page/(?!picture/).*|tests/cli/browser\.py", "command line", "html"),
    (r"page/picture/.*", "command line", "picture"),
    (r"(docs/.*|README|CHANGELOG)\.md|docs/pictures/.*|examples/.*|scripts/option-reference", "command line", "docs"),
    (r"scripts/(manual|program_help\.py)", "command line", "manual"),
    (r"scripts/program_help\.py", "command line", "docs"),
    (r"bindings/python/.*|tests/python/support\.py", "Python", ""),
    (r"tests/python/(test_\w+)\.py", "Python", r"\1"),
    (r"setup\.py|pyproject\.toml|MANIFEST\.in", "Python", "test_install"),
    (r"bindings/wasm/.*|tests/wasm/(support|draw|shapes)\.mjs", "WebAssembly", "core sequences threads"),
    (r"tests/wasm/test_(\w+)\.mjs", "WebAssembly", r"\1"),
    (r"editor/(src|test)/.*|editor/[^/]*", "editor: modules", ""),
    (r"editor/e2e/(\w+)\.test\.mjs", "editor: in a browser", r"\1"),
    (r"editor/e2e/(support|run|frames|pictures)\.mjs", "editor: in a browser", "editor"),
    (r"blender/.*|tests/blender/(run|support\.py|in_\w+\.py)", "Blender", ""),
    (r"tests/blender/(test_\w+)\.py", "Blender", r"\1"),
    (r"tests/corpus/.*|scripts/same-bits", "the same bits by every way in", ""),
    (r"tests/consumer/.*|cmake/.*\.in", "installed library", ""),
    (r"tests/packages/(test_\w+)\.py", "packages", r"\1"),
    (r"tests/packages/(run|support\.py|debian_root)|scripts/package", "packages", ""),
    (r"fuzz/.*", "fuzzers", ""),
    (r"scripts/curve-families", "families of curves", ""),
    (r"scripts/ordinary(-tasks|/)", "ordinary tasks", ""),
    (r"scripts/pinned-results", "pinned results", ""),
    (r"scripts/mutations\.py|scripts/mutate|scripts/(quick_choice|include_graph|gtest_sources)\.py|tests/scripts/.*", "includes", ""),
    (r"((scripts|\.ci)/.*|check|demo|edit|bench|tests/consumer/run|benchmarks/(blender/.*|python-call))", "scripts", r"\1"),
    (r"\.clang-format", "formatting", ""),
]
CHOICE = [(re.compile(paths), step, given) for paths, step, given in CHOICE]


def choose(changed):
    """By step what it is given: the names of tests, or none for all. With it the paths that no row of CHOICE knows."""
    steps, unknown = {}, []
    for path in sorted(changed):
        matches = [(step, row.expand(given)) for paths, step, given in CHOICE if (row := paths.fullmatch(path))]
        for step, given in matches:
            steps.setdefault(step, []).append(given)
        if not matches:
            unknown.append(path)
    return {step: set() if "" in given else {name for names in given for name in names.split()} for step, given in steps.items()}, unknown


def dependent(tests, changed, defines, needs):
    """Of the objects `tests` those that have changed or are linked with one that has. defines, needs: by object the names of functions
    and variables."""
    place = {name: object for object in defines if object not in tests for name in defines[object]}
    linked = {object: {place[name] for name in needs[object] if name in place} for object in needs}
    # Backwards, from what has changed to all that is linked with it.
    users = {}
    for object, others in linked.items():
        for other in others:
            users.setdefault(other, set()).add(object)
    found, left = set(changed), list(changed)
    while left:
        new = users.get(left.pop(), set()) - found
        found |= new
        left += new
    return found & set(tests)


def digest(path):
    return hashlib.sha1(path.read_bytes()).hexdigest()


def files():
    """By path what every file of the project is now."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True, capture_output=True, text=True)
    return {path: digest(ROOT / path) for path in listed.stdout.split("\0") if path and (ROOT / path).is_file()}


def source_of(object):
    folder, path = object.removesuffix(".o").split(".dir/")
    return ROOT / folder.split("CMakeFiles/")[0] / path


def objects():
    """By path what every object of the library and of unit tests and claims is now."""
    folders = ["CMakeFiles/vspring_objects.dir/src", "tests/CMakeFiles/unit_tests.dir", "tests/CMakeFiles/claim_tests.dir", "tests/CMakeFiles/test_main.dir"]
    paths = {path: str(path.relative_to(BUILD)) for folder in folders for path in (BUILD / folder).rglob("*.cpp.o")}
    return {name: digest(path) for path, name in paths.items() if source_of(name).exists()}


def read_record():
    return json.loads(RECORD.read_text()) if RECORD.exists() else None


def write_record(files, build_was_run):
    before = read_record()
    RECORD.write_text(json.dumps({"files": files, "objects": objects() if build_was_run else before["objects"] if before else {}}))


def changed_files(now):
    """Those that differ from when it last passed, or if it never did, from the last commit."""
    record = read_record()
    if record:
        return {path for path in {*now, *record["files"]} if now.get(path) != record["files"].get(path)}
    said = subprocess.run(["git", "status", "--porcelain", "-z", "--no-renames", "--untracked-files=all"], cwd=ROOT, check=True, capture_output=True, text=True)
    return {line[3:] for line in said.stdout.split("\0") if line}


def names_of_objects(paths):
    """By object the names that it defines and those that it needs of others."""
    defines, needs = {path: set() for path in paths}, {path: set() for path in paths}
    listed = subprocess.run(["nm", "-A", "-P", *paths], cwd=BUILD, check=True, capture_output=True, text=True)
    for line in listed.stdout.splitlines():
        path, name, kind, *_ = line.split()
        (needs if kind == "U" else defines)[path.rstrip(":")].add(name)
    return defines, needs


def main():
    """Prints a filter for GoogleTest: all suites of the sources of tests whose object, or one that it is linked with, has changed."""
    now = objects()
    before = (read_record() or {"objects": {}})["objects"]
    changed = {path for path in now if now[path] != before.get(path)}
    starts = {path for path in now if "test_main" in path}
    tests = {path for path in now if path.startswith("tests/")} - starts
    chosen = tests if changed & starts else dependent(tests, changed, *names_of_objects(sorted(now)))
    suites = sorted({suite for path in chosen for suite, _ in tests_of(source_of(path))})
    print(f"{len(changed)} objects have changed; {len(chosen)} of {len(tests)} sources of unit tests and claims are linked with them", file=sys.stderr)
    print(":".join(f"{suite}.*:*/{suite}.*" for suite in suites))


if __name__ == "__main__":
    main()
