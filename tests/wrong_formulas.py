#!/usr/bin/env python3
"""Makes formulas wrong by a few per cent, one at a time, and sees to it that a fast test fails for each.

usage: tests/wrong_formulas.py [NAME...]

Without names all formulas of tests/wrong_formulas.txt, which says how it is read. They are made wrong in a copy of the
sources below the build folder, never here. The copy is compiled once: in it each formula has a factor, which is 1 but
for the formula whose number is in the environment when a test starts.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "tests" / "wrong_formulas.txt"
TARGET = Path(os.environ.get("CARGO_TARGET_DIR") or ROOT / "target").resolve()
PLACE = TARGET / "wrong-formulas"
COPY = PLACE / "copy"
# What cargo needs to compile the tests, and what these read.
COPIED = ["Cargo.toml", "Cargo.lock", "build.rs", "src", "tests", "benches", "studies", "schemas"]
VARIABLE = "CGAFT_WRONG_FORMULA"
# A test that takes longer hangs, s.
LONGEST = 600

# What the library gets in the copy: the factors, and the tests of the suite, so that there is one program to compile.
ADDED = f"""
#[cfg(test)]
extern crate self as cgaft;

#[cfg(test)]
#[allow(dead_code, unused_imports)]
mod suite;

mod wrong_formulas {{
    use std::sync::LazyLock;

    static WRONG: LazyLock<(usize, f64)> = LazyLock::new(|| {{
        let told = std::env::var("{VARIABLE}").unwrap_or_default();
        let (number, factor) = told.split_once(' ').unwrap_or(("0", "1"));
        (number.parse().unwrap(), factor.parse().unwrap())
    }});

    /// 1 unless this formula is to be wrong.
    #[inline(always)]
    pub fn factor(number: usize) -> f64 {{
        let (wrong, factor) = *WRONG;
        if number == wrong {{ factor }} else {{ 1.0 }}
    }}
}}
"""

Formula = namedtuple("Formula", "number name source percent place text test line")


def main(names):
    formulas, complaints = read_table()
    sources = {str(path.relative_to(ROOT)): path.read_text() for path in sorted((ROOT / "src").rglob("*.rs"))}
    insertions = {}
    for formula in formulas:
        complaint = locate(formula, sources, insertions)
        complaints += [complaint] if complaint else []
    unknown = [name for name in names if name not in {formula.name for formula in formulas}]
    complaints += [f"no formula is called '{name}'" for name in unknown]
    if complaints:
        return fail(complaints)

    start = time.monotonic()
    make_copy(sources, insertions)
    program = build()
    print(f"compiled in {time.monotonic() - start:.0f} s", flush=True)

    wanted = [formula for formula in formulas if not names or formula.name in names]
    complaints = right(program, {formula.test for formula in wanted})
    if complaints:
        return fail(complaints)
    survivors = wrong(program, wanted)
    caught = len(wanted) - len(survivors)
    print(f"{caught} of {len(wanted)} wrong formulas caught in {time.monotonic() - start:.0f} s")
    return fail(survivors) if survivors else 0


def fail(complaints):
    print("\n".join(["", *complaints]), file=sys.stderr)
    return 1


def read_table():
    formulas, complaints, place = [], [], None
    for number, line in enumerate(TABLE.read_text().splitlines(), 1):
        if line.startswith("## "):
            place = line[3:].strip()
        elif line.strip() and not line.startswith("#"):
            cells = [cell.strip() for cell in line.split(" | ")]
            if len(cells) != 5 or cells[3].count("⟨") != 1 or cells[3].count("⟩") != 1:
                complaints.append(f"{TABLE.name}:{number}: name | source | per cent | text with ⟨ and ⟩ | test")
                continue
            name, source, percent, text, test = cells
            formulas.append(Formula(len(formulas) + 1, name, source, float(percent), place, text, test, number))
    names = [formula.name for formula in formulas]
    complaints += [f"{TABLE.name}: two formulas are called '{name}'" for name in {n for n in names if names.count(n) > 1}]
    return formulas, complaints


def locate(formula, sources, insertions):
    """Notes where the factor goes; the complaint if the text is not there exactly once, lines broken as they may be."""
    before, inside, after = re.split("[⟨⟩]", formula.text)
    pieces = [re.sub(r"(\\ )+", r"\\s+", re.escape(piece)) for piece in (before, inside, after)]
    pattern = re.compile("({})({})({})".format(*pieces))
    files = [file for file in sources if file == formula.place or file.startswith(f"{formula.place}/")]
    found = [(file, match) for file in files for match in pattern.finditer(sources[file])]
    if len(found) != 1:
        return (
            f"{TABLE.name}:{formula.line}: the text of '{formula.name}' is {len(found)} times in {formula.place}, not once;"
            f" mend this line: {before}{inside}{after}"
        )
    [(file, match)] = found
    at = insertions.setdefault(file, [])
    at.append((match.start(2), 1, "(("))
    at.append((match.end(2), 0, f") * crate::wrong_formulas::factor({formula.number}))"))
    return None


def make_copy(sources, insertions):
    """Files that are as they were keep their time, so that little is compiled again."""
    texts = {}
    for top in COPIED:
        files = [ROOT / top] if (ROOT / top).is_file() else (ROOT / top).rglob("*")
        texts |= {path.relative_to(ROOT): path.read_bytes() for path in files if path.is_file()}
    for file, places in insertions.items():
        text = sources[file]
        for at, _, inserted in sorted(places, reverse=True):
            text = text[:at] + inserted + text[at:]
        texts[Path(file)] = text.encode()
    texts[Path("src/lib.rs")] += ADDED.encode()
    suite = Path("tests/suite")
    texts |= {"src" / path.relative_to("tests"): text for path, text in texts.items() if suite in path.parents}
    texts[Path("src/suite.rs")] = suite_of(texts[Path("tests/suite.rs")].decode(), texts).encode()
    for path in [path for path in COPY.rglob("*") if path.is_file() and path.relative_to(COPY) not in texts]:
        path.unlink()
    for path, text in texts.items():
        path = COPY / path
        if not path.exists() or path.read_bytes() != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text)
    link_dependencies()


def suite_of(root, texts):
    """The modules of the suite but for those that start the programs, which are not there."""
    starts = {path.parts[2].removesuffix(".rs") for path, text in texts.items() if b"CARGO_BIN_EXE" in text and len(path.parts) > 2}
    modules = [name for name in re.findall(r"^ +mod (\w+);", root, re.MULTILINE) if name not in starts]
    return "".join(f"mod {name};\n" for name in modules)


def link_dependencies():
    """The crates of others are compiled already; only what is the project's own is not taken along."""
    own = re.compile(r"(lib)?(cgaft|suite|verify|steps|performance|one_rank_panics|build_script_build)\b|(lib)?cgaft")
    for folder in ["deps", "build", ".fingerprint"]:
        there = TARGET / "release" / folder
        for path in there.rglob("*") if there.exists() else []:
            relative = path.relative_to(TARGET)
            copy = PLACE / relative
            if path.is_file() and not own.match(relative.parts[2]) and not copy.exists():
                copy.parent.mkdir(parents=True, exist_ok=True)
                try:
                    os.link(path, copy)
                except OSError:
                    shutil.copy2(path, copy)


def build():
    """The program with the tests."""
    cargo = [os.environ.get("CARGO", "cargo"), "test", "--release", "--locked", "--lib", "--no-run"]
    # To compile takes longer than to run.
    quick = {"CARGO_TARGET_DIR": str(PLACE), "CARGO_PROFILE_RELEASE_OPT_LEVEL": "1", "CARGO_INCREMENTAL": "1"}
    told = subprocess.run(
        [*cargo, "--message-format", "json-render-diagnostics"],
        cwd=COPY,
        env={**os.environ, **quick},
        capture_output=True,
        text=True,
    )
    if told.returncode != 0:
        sys.exit(f"{told.stderr}\nthe copy with the factors does not compile: mend the line of the formula named above")
    made = [json.loads(line) for line in told.stdout.splitlines() if line.startswith("{")]
    [program] = [one["executable"] for one in made if one.get("executable")]
    return program


def run(program, test, told, workers):
    """The exit code of a test, and what it printed."""
    environment = {**os.environ, VARIABLE: told, "RAYON_NUM_THREADS": str(max(1, (os.cpu_count() or 1) // workers))}
    command = [program, *test.split(", "), "--test-threads", "1"]
    try:
        ended = subprocess.run(
            command, cwd=COPY, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=LONGEST
        )
    except subprocess.TimeoutExpired:
        return None, f"it took more than {LONGEST} s"
    return ended.returncode, ended.stdout


def side_by_side(program, asked):
    """Runs (test, told) several at a time: exit code, what was printed, time."""
    workers = os.cpu_count() or 1

    def one(test, told):
        start = time.monotonic()
        return *run(program, test, told, workers), time.monotonic() - start

    with ThreadPoolExecutor(workers) as pool:
        yield from pool.map(lambda job: one(*job), asked)


def right(program, tests):
    """With all formulas right every test passes; else what to say."""
    tests = sorted(tests)
    complaints = []
    for test, (code, text, _) in zip(tests, side_by_side(program, [(test, "") for test in tests])):
        if code != 0:
            complaints.append(f"with all formulas right {test} fails:\n{text}")
    return complaints


def wrong(program, formulas):
    """The lines on those that no test tells from the right ones."""
    asked = [(formula.test, f"{formula.number} {1.0 + formula.percent / 100.0}") for formula in formulas]
    survivors = []
    for formula, (code, text, seconds) in zip(formulas, side_by_side(program, asked)):
        is_caught = code == 101 and "test result: FAILED" in text
        change = f"{formula.percent:+g} %"
        print(f"{'caught  ' if is_caught else 'SURVIVED'} {seconds:5.1f} s  {formula.name}, {change}: {formula.test}", flush=True)
        if not is_caught:
            what = f"does not fail (it ended with {code})" if re.search("running [1-9]", text) else "is not there"
            survivors.append(
                f"{TABLE.name}:{formula.line}: '{formula.name}' ({formula.source}) is {change} off in {formula.place},"
                f" and the test {formula.test} {what}"
            )
    return survivors


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
