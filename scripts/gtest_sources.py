"""Which source has which unit test or claim."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEST = re.compile(r"^(?:RC_GTEST_PROP|TEST|TEST_F|TEST_P)\((\w+),\s*(\w+)", re.MULTILINE)


def tests_of(source):
    """The suite and the name of each test of a source."""
    return TEST.findall(source.read_text())


def source_of_each():
    """By the name that GoogleTest gives to a test, without what it gives to its parameters, the source."""
    return {f"{suite}.{name}": source for folder in ("unit", "claims") for source in sorted((ROOT / "tests" / folder).rglob("*.cpp"))
            for suite, name in tests_of(source)}
