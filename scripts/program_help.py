"""What `vspring COMMAND --help` says, taken apart. The program is $VSPRING, or build/release/vspring."""
import os
import pathlib
import re
import subprocess

PROGRAM = os.environ.get("VSPRING", pathlib.Path(__file__).resolve().parent.parent / "build/release/vspring")
FAIRING = ["fair", "curve", "fit", "fill", "span", "measure"]
# How the help is laid out: descriptions begin at this column, or on the next line.
COLUMN = 30
# Names of kinds of values in the help.
KINDS = {"POSITIVE": "more than 0", "NONNEGATIVE": "0 or more", "WHOLE": "a whole number"}


def say(*words):
    return subprocess.run([PROGRAM, *words, "--help"], check=True, capture_output=True, text=True).stdout


def sections(text):
    """Title and entries (head, description) of each section of a help text."""
    lines = text.splitlines()
    title = None
    for number, line in enumerate(lines):
        if re.match(r"\S.*:$", line):
            title = line.rstrip(":")
        elif title and line.startswith("  ") and not line.startswith(" " * COLUMN):
            below = lines[number + 1] if number + 1 < len(lines) else ""
            if below.startswith(" " * COLUMN):
                yield title, line.strip(), below.strip()
            else:
                yield title, line[:COLUMN].strip(), line[COLUMN:].strip()


def without_default(text):
    """The text without its "(default: …)", and what stands there."""
    begin = text.find("(default: ")
    if begin < 0:
        return text, ""
    depth = 0
    for end in range(begin, len(text)):
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        if depth == 0:
            break
    rest = (text[:begin].rstrip() + text[end + 1:]).strip()
    return rest, text[begin + len("(default: "):end]


def entry(head, description):
    """How to write an option, what it means, and its default."""
    head, _, excluded = head.partition(" Excludes: ")
    head, _, needed = head.partition(" Needs: ")
    required = head.endswith(" REQUIRED")
    head = head.removesuffix(" REQUIRED")
    name, _, value = head.partition(" ")
    value, _, kind = value.partition(":")
    meaning, default = without_default(description)
    notes = [f"{value}: {KINDS.get(kind, kind)}"] if kind and kind not in meaning and "less than" not in meaning else []
    notes += [f"Not with {excluded}"] if excluded else []
    notes += [f"Needs {needed.upper()}"] if needed else []
    meaning = ". ".join([meaning.rstrip("."), *notes])
    return f"{name} {value}".strip().replace(",--", ", --"), meaning, "needed" if required else default


class Table:
    """Options that several commands may share: those that they explain in the same words are one row."""

    def __init__(self):
        self.found = {}

    def add(self, command, option):
        self.found.setdefault(option, []).append(command)

    def rows(self):
        """Name, meaning, default and commands of each row; those of one option stand together, where the first of them came."""
        flag = lambda option: option[0].split()[0]
        order = list(dict.fromkeys(map(flag, self.found)))
        for (name, meaning, default), commands in sorted(self.found.items(), key=lambda row: order.index(flag(row[0]))):
            yield name, meaning, default, commands


def tables(commands, ask):
    """The tables of some commands by the titles of their sections."""
    found = {}
    for command in commands:
        for title, head, description in sections(ask(command)):
            if title in ("Positionals", "Subcommands", "Example") or head.startswith(("-h,", "vspring ")):
                continue
            title = re.sub(r"^How (the nodes of the input|points) pull.*", "How points pull", title)
            found.setdefault(title, Table()).add(command, entry(head, description))
    return found


def subcommands(*words):
    """Names and what they do."""
    return {head: meaning for title, head, meaning in sections(say(*words)) if title == "Subcommands" and not head.startswith("vspring ")}
