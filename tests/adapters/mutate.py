#!/usr/bin/env python3
"""Mutants of the two example adapters, each asked the conformance suite: what no case sees is a hole in the suite.

    cargo build --release -p stackless-cli
    python3 tests/adapters/mutate.py c                     # of traverse.c, py of traverse.py
    python3 tests/adapters/mutate.py --shard 1/4 --json 1.json c  # a part; `stackless merge` adds them up
    python3 tests/adapters/mutate.py --sample 100 py       # so many of all, the same ones each time

A mutant is one change: an operator for another, a constant one more or one less, a condition that always or never
holds or is negated, a statement left out. What only reads and writes lines is left alone, and so is what the C adapter does
with input that is not as it must be: the suite does not ask about that. Mutants that behave as the original does are listed
in equivalent.txt, each with its reason. The exit code is 1 if others survive, or if there are none at all.

Python 3.9 or newer, standard library only; a C compiler for traverse.c.
"""

import argparse
import ast
import hashlib
import json
import os
import platform
import re
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
SUITE = HERE.parent.parent / "spec/suite"

SECONDS = 60  # for a mutant; the original takes 4
SILENCE = 4  # seconds for a case; the original takes less than one
BYTES = 2 << 30  # of memory, for whoever asks and for whoever answers

# What an operator is exchanged for. In C, unary ones are tried as well: most of these do not compile.
SWAPS = {
    "+": ["-"], "-": ["+"], "*": ["+"], "/": ["*"], "%": ["/"], "<<": [">>"], ">>": ["<<"], "&": ["|"], "|": ["&"],
    "^": ["|", "&"], "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="],
    "!=": ["=="], "&&": ["||"], "||": ["&&"], "!": [""], "~": [""], "++": ["--"], "--": ["++"], "+=": ["-=", "="],
    "-=": ["+=", "="], "|=": ["&=", "="], "&=": ["|=", "="], ">>=": ["<<=", "="], "<<=": [">>=", "="],
    "true": ["false"], "false": ["true"], "break": ["continue"], "continue": ["break"],
}  # fmt: skip

TOKEN = re.compile(
    r"""(?P<skip>\s+|/\*.*?\*/|^\#[^\n]*)|(?P<text>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')|(?P<name>[A-Za-z_]\w*)"""
    r"""|(?P<number>0x[0-9a-f]+|[0-9]+)|(?P<operator><<=|>>=|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+|&]=|.)""",
    re.DOTALL | re.MULTILINE,
)


def mutants_of_c(source):
    """Line, change, and text of each mutant."""
    tokens = [token for token in TOKEN.finditer(source) if token.lastgroup != "skip"]
    # The sizes of buffers, the parser of JSON, and the protocol.
    places = [("MAX_LINE", "MAX_DEPTH"), ("/* JSON:", "/* Level key."), ("/* Protocol. */", "")]
    begins = [source.index(first) for first, _ in places]
    left_out = [(at, source.index(last, at) if last else len(source)) for at, (_, last) in zip(begins, places)]
    left_out += [guard.span() for guard in GUARD.finditer(source) if is_reader(source[: guard.start()])]

    def mutant(begin, end, new):
        if any(first <= begin < last for first, last in left_out):
            return
        old = " ".join(source[begin:end].split())
        line = source.count("\n", 0, begin)
        column = begin - source.rfind("\n", 0, begin)
        place = f"{function(source[:begin])}: {source.split(chr(10))[line].strip()}"
        yield line + 1, place, f"{column}: {old} -> {new or 'nothing'}", source[:begin] + new + source[end:]

    for i, token in enumerate(tokens):
        text, (begin, end) = token.group(), token.span()
        for new in SWAPS.get(text, ()):
            yield from mutant(begin, end, new)
        if token.lastgroup == "number":
            is_hexadecimal, value = text.startswith("0x"), int(text, 0)
            for new in (value + 1, value - 1):
                yield from mutant(begin, end, f"{new:#x}" if is_hexadecimal else str(new))
        if text == "?":
            yield from mutant(begin, end, "&& 0 ?")
            yield from mutant(begin, end, "|| 1 ?")
        if text in ("if", "while"):
            first, last = tokens[i + 1].end(), tokens[matching(tokens, i + 1)].start()
            constants = ("0",) if text == "while" else ("0", "1")
            for new in (*constants, f"!({source[first:last]})"):
                yield from mutant(first, last, new)
        if begins_statement(tokens, i) and text not in ("if", "for", "while", "else", "static", "typedef", "const"):
            last = i
            while last < len(tokens) and tokens[last].group() not in (";", "{", "}"):
                last = matching(tokens, last) + 1 if tokens[last].group() == "(" else last + 1
            if last < len(tokens) and tokens[last].group() == ";" and last > i:
                yield from mutant(begin, tokens[last].start(), "")


# What comes of input that is not as it must be, which the suite does not ask about.
GUARD = re.compile(r"(if \([^{};]*\)\s*)?return (false|UNKNOWN);")


def function(before):
    """The function that a text ends in or after."""
    return ["", *re.findall(r"^static [\w ]+[ *](\w+)\([^;{]*\) \{", before, re.MULTILINE)][-1]


def is_reader(before):
    """Whether a text ends in a function that reads input."""
    return function(before).startswith(("is_script", "read_", "get_", "answer_"))


def matching(tokens, at):
    """The token that closes the bracket."""
    depth = 0
    for i in range(at, len(tokens)):
        depth += {"(": 1, ")": -1}.get(tokens[i].group(), 0)
        if depth == 0:
            return i
    raise ValueError("a bracket is not closed")


def begins_statement(tokens, i):
    if i == 0 or tokens[i].group() in ("{", "}", ";"):
        return False
    before = tokens[i - 1].group()
    if before in ("{", "}", ";", "else"):
        return True
    if before != ")":
        return False
    depth, at = 0, i - 1
    while True:
        depth += {")": 1, "(": -1}.get(tokens[at].group(), 0)
        if depth == 0:
            return at > 0 and tokens[at - 1].group() in ("if", "for", "while")
        at -= 1


OPERATORS = {
    ast.Add: [ast.Sub], ast.Sub: [ast.Add], ast.Mult: [ast.Add], ast.FloorDiv: [ast.Mult], ast.Div: [ast.Mult],
    ast.Mod: [ast.FloorDiv], ast.Pow: [ast.Mult], ast.LShift: [ast.RShift], ast.RShift: [ast.LShift],
    ast.BitAnd: [ast.BitOr], ast.BitOr: [ast.BitAnd], ast.BitXor: [ast.BitOr, ast.BitAnd], ast.And: [ast.Or],
    ast.Or: [ast.And], ast.Lt: [ast.LtE, ast.GtE], ast.LtE: [ast.Lt, ast.Gt], ast.Gt: [ast.GtE, ast.LtE],
    ast.GtE: [ast.Gt, ast.Lt], ast.Eq: [ast.NotEq], ast.NotEq: [ast.Eq], ast.Is: [ast.IsNot], ast.IsNot: [ast.Is],
    ast.In: [ast.NotIn], ast.NotIn: [ast.In],
}  # fmt: skip

# What reads lines, and what says what is answered.
PROTOCOL = {"answer", "main", "HELLO", "PROFILES", "WORDS", "OPERATIONS"}


def mutants_of_python(source):
    """Line, change, and text of each mutant."""
    tree = ast.parse(source)
    lines = source.split("\n")
    texts = [written(top) for top in tree.body]
    for number, top in enumerate(tree.body):
        names = {getattr(top, "name", None)} | {getattr(it, "id", None) for it in getattr(top, "targets", ())}
        if names & PROTOCOL or not isinstance(top, (ast.FunctionDef, ast.ClassDef, ast.Assign)):
            continue
        for node in ast.walk(top):
            # The same places again and again, so that each change is undone before the next.
            for holder, place, new in changes(node):
                old, before = holder[place], shown(node)
                holder[place] = new
                is_statement = isinstance(old, ast.stmt)
                change = f"{shown(old)} -> {shown(new)}" if is_statement else f"{before} -> {shown(node)}"
                line, column = place_of(node, old)
                name = getattr(top, "name", "")
                # What is not changed is not written again: it would take most of the time.
                text = "\n".join([*texts[:number], written(top), *texts[number + 1 :]])
                yield line, f"{name}: {lines[line - 1].strip()}", f"{column}: {change}", text
                holder[place] = old


def written(top):
    """A statement of a module, as `ast.unparse` writes it there."""
    return "\n" * isinstance(top, (ast.FunctionDef, ast.ClassDef)) + ast.unparse(ast.Module([top], []))


def place_of(node, old):
    """Line and column. Operators have none, and neither has what is between `for` and its list."""
    at = next(it for it in (old, node, getattr(node, "target", None)) if hasattr(it, "lineno"))
    return at.lineno, at.col_offset + 1


def shown(node):
    return " ".join(ast.unparse(node).split())


def changes(node):
    """Where something is exchanged, and for what: a dictionary or list, the place in it, and what stands there then."""
    fields = vars(node)
    true, false = ast.Constant(True), ast.Constant(False)
    if isinstance(node, (ast.BinOp, ast.AugAssign, ast.BoolOp)):
        yield from ((fields, "op", new()) for new in OPERATORS[type(node.op)])
    if isinstance(node, ast.Compare):
        for i, operator in enumerate(node.ops):
            yield from ((node.ops, i, new()) for new in OPERATORS[type(operator)])
    if isinstance(node, ast.Constant) and type(node.value) is int:
        yield from ((fields, "value", new) for new in (node.value + 1, node.value - 1))
    if isinstance(node, ast.Constant) and type(node.value) is bool:
        yield fields, "value", not node.value
    if isinstance(node, (ast.If, ast.IfExp, ast.While)):
        if not isinstance(node.test, ast.Constant):
            constants = [false] if isinstance(node, ast.While) else [true, false]
            yield from ((fields, "test", new) for new in (*constants, ast.UnaryOp(ast.Not(), node.test)))
    if isinstance(node, ast.comprehension):
        yield from ((node.ifs, i, true) for i in range(len(node.ifs)))
    for place, value in list(fields.items()):
        if isinstance(value, ast.UnaryOp):
            yield fields, place, value.operand
        if not isinstance(value, list):
            continue
        for i, it in enumerate(value):
            if isinstance(it, ast.UnaryOp):
                yield value, i, it.operand
            is_text = isinstance(it, ast.Expr) and isinstance(it.value, ast.Constant)
            if isinstance(it, ast.stmt) and not is_text and not isinstance(it, (ast.FunctionDef, ast.ClassDef)):
                yield value, i, ast.Pass()
            if isinstance(it, (ast.Break, ast.Continue)):
                yield value, i, ast.Continue() if isinstance(it, ast.Break) else ast.Break()


def of_levels(folder, is_ray):
    """A suite of the level ray alone, or of all the others: exact rays take longest, and share no code with them."""
    index = json.loads((SUITE / "index.json").read_text())
    index["files"] = [it for it in index["files"] if it["profile"].startswith("ray/") == is_ray]
    for name in ["VERSION", *(it["file"] for it in index["files"])]:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).symlink_to(SUITE / name)
    (folder / "index.json").write_text(json.dumps(index))
    return folder


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))


def ask(stackless, suite, command):
    """What came of it."""
    asked = [stackless, "conform", "--fail-fast", "--show", "1", "--timeout", str(SILENCE), "--suite", str(suite), "--"]
    try:
        done = subprocess.run(
            asked + command, capture_output=True, text=True, errors="replace", timeout=SECONDS, preexec_fn=limit
        )
    except subprocess.TimeoutExpired:
        return "timed out"
    if done.returncode == 0:
        return "survived"
    return "timed out" if ": timeout: " in done.stdout.partition("\n")[0] else "caught"


class Language:
    def __init__(self, name, folder):
        self.is_c = name == "c"
        self.path = SUITE / "adapters" / ("traverse.c" if self.is_c else "traverse.py")
        self.source = self.path.read_text()
        self.folder = folder
        self.first_of_ray = self.source.count("\n", 0, self.source.index("\ndef ray(")) + 2 if not self.is_c else 0

    def mutants(self):
        return (mutants_of_c if self.is_c else mutants_of_python)(self.source)

    def command(self, text):
        """The command that runs a text; None where it does not compile."""
        written = self.folder / self.path.name
        written.write_text(text)
        if not self.is_c:
            return [sys.executable, "-B", str(written)]
        program = str(self.folder / "mutant")
        compiled = subprocess.run(["cc", "-std=c11", "-w", "-O1", "-o", program, str(written)], capture_output=True)
        return [program] if compiled.returncode == 0 else None

    def is_ray(self, line):
        return not self.is_c and line >= self.first_of_ray


def shard(text):
    """I/N, as `stackless` has it: with I from 1 to N."""
    index, _, count = text.partition("/")
    if not (index.isdecimal() and count.isdecimal() and 1 <= int(index) <= int(count)):
        raise argparse.ArgumentTypeError("expected I/N with I from 1 to N, as in 3/64")
    return int(index), int(count)


def record(arguments, whole, numbers, counts, lines):
    """The record of a part, for `stackless merge`. Lines are the survivors, and what is listed and caught."""
    version = subprocess.run([arguments.stackless, "--version"], capture_output=True, text=True, check=True).stdout
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    machine = f"{platform.system().lower()} {platform.machine()}, {os.cpu_count()} threads"
    survivors, stale = lines
    suite = (SUITE / "VERSION").read_text().strip()
    return {
        "run": {
            "command": "mutants",
            "version": version.split()[1],
            "commit": os.environ.get("STACKLESS_COMMIT"),
            "asked": {"language": arguments.language, "sample": arguments.sample, "suite": suite},
            "parts": {"mutants": {"of": whole, "done": [[numbers.start, numbers.stop]] if numbers else []}},
            "machines": {machine: sum(it.ru_utime + it.ru_stime for it in used)},
        },
        "mutants": len(numbers),
        "not_compiled": counts["did not compile"],
        "caught": counts["caught"] + counts["timed out"],
        "timed_out": counts["timed out"],
        "equivalent": counts["equivalent"],
        "survivors": sorted(survivors),
        "stale": sorted(stale),
    }


def equivalent():
    """Those that are listed: file, line's text, change. Changes stand below their line, and the reason above both."""
    listed, place = set(), ""
    for line in (HERE / "equivalent.txt").read_text().split("\n"):
        if line.startswith("    "):
            listed.add((*place, line.strip()))
        elif line.startswith("  "):
            place = tuple(line.strip().split(": ", 1))
    return listed


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("language", choices=["c", "py"])
    parser.add_argument("--shard", default=(1, 1), type=shard, metavar="I/N", help="one of N parts")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the counts: a record for `stackless merge`")
    parser.add_argument("--sample", type=int, metavar="N", help="so many, chosen by a hash of their text")
    parser.add_argument("--stackless", default=str(HERE.parent.parent / "target/release/stackless"))
    parser.add_argument("--list", action="store_true", help="print the mutants, and ask nothing")
    arguments = parser.parse_args()
    index, parts = arguments.shard
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        suites = []
        for is_ray in (False, True):
            suites.append(of_levels(folder / str(is_ray), is_ray))
        language = Language(arguments.language, folder)
        for suite in suites[: 1 if language.is_c else 2]:
            original = language.command(language.source)
            control = "survived" if arguments.list else ask(arguments.stackless, suite, original)
            if control != "survived":
                raise SystemExit(f"{language.path.name} itself: {control}")
        # Some changes are one.
        mutants = list({it[3]: it for it in reversed(list(language.mutants()))}.values())[::-1]
        whole = len(mutants)
        if arguments.sample is not None:
            mutants.sort(key=lambda it: hashlib.sha256(it[3].encode()).digest())
            mutants = sorted(mutants[: arguments.sample], key=lambda it: it[:3])
        all_of_them = len(mutants)
        numbers = range(all_of_them * (index - 1) // parts, all_of_them * index // parts)
        mutants = mutants[numbers.start : numbers.stop]
        counts, known, survivors, stale = Counter(), equivalent(), [], []
        for line, place, change, text in mutants:
            if arguments.list:
                print(f"{line}: {place}\n    {change}")
                continue
            command = language.command(text)
            entry = (language.path.name, place, change)
            outcome = "did not compile"
            if command:
                outcome = ask(arguments.stackless, suites[language.is_ray(line)], command)
            if outcome == "survived" and entry in known:
                outcome = "equivalent"
            elif entry in known:
                print(f"line {line}: {change}: is listed as equivalent, and {outcome}", flush=True)
                stale.append(f"line {line}: {place}: {change}")
            counts[outcome] += 1
            if outcome == "survived":
                print(f"line {line}\n  {language.path.name}: {place}\n    {change}", flush=True)
                survivors.append(f"line {line}: {place}: {change}")
    if arguments.list:
        return
    if arguments.json:
        found = record(arguments, all_of_them, numbers, counts, (survivors, stale))
        arguments.json.write_text(json.dumps(found, indent=2) + "\n")
    made = len(mutants)
    compiled = made - counts["did not compile"]
    caught = counts["caught"] + counts["timed out"]
    print(f"{language.path.name}: {made} mutants of {whole} ({100 * made / max(whole, 1):.1f} %):", end=" ")
    print(f"{counts['did not compile']} did not compile, {caught} were caught,", end=" ")
    print(f"{counts['timed out']} of them timed out,", end=" ")
    print(f"{counts['equivalent']} are equivalent, {counts['survived']} survived", end=" ")
    others = max(compiled - counts["equivalent"], 1)
    print(f"({100 * caught / others:.1f} % of those that are not equivalent were caught)")
    sys.exit(made == 0 or counts["survived"] + len(stale) > 0)


if __name__ == "__main__":
    main()
