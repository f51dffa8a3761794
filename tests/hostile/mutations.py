"""Damaged inputs of every command: whatever it is given, it ends soon, with 0 or 2, and says what is wrong.

    python3 tests/hostile/mutations.py target/release/laneweave --runs 10000

For each command and each kind of its inputs there is a small sound case. Its input is changed: bits, bytes, numbers,
words, lines and parts of it. Where a file has a hash, this is mended, so that what is behind it is read. A run must end

* with 0, or with 2 and a message that names an input or an option,
* without a panic and without "report this as a bug",
* within 10 s of CPU time, or three times that of the sound input,
* with at most 1 GB of memory.

What fails is kept with its command line, to be run again; then the exit code is 1.
"""

import argparse
import random
import re
import shlex
import shutil
import sys
import tempfile
import time
import tomllib
from pathlib import Path

# No folder of byte code in the repository.
sys.dont_write_bytecode = True

import cases
import home as homes
import limited
import mutate

SECONDS, TIMES, MEMORY_MB = 10.0, 3.0, 1000.0
# Other work on the machine may take so much longer by the clock.
PATIENCE = 12.0
# A sound input may take so long by the clock [s].
LONGEST = 600.0


def copied(case, home, folder):
    """The case in a folder of its own."""
    for name in case.needs(home):
        if (home / name).is_dir():
            shutil.copytree(home / name, folder / name)
        else:
            shutil.copyfile(home / name, folder / name)


def asks_for_long(path, case):
    """Whether a changed scenario itself asks for much more steps than the sound one, which then take their time."""
    try:
        run = tomllib.loads((path / case.victim).read_text()).get("run", {})
        return (run.get("duration_s", 600) + run.get("warmup_s", 0)) / run.get("step_s", 0.1) > 5_000
    except (OSError, ValueError, TypeError, AttributeError, ZeroDivisionError):
        return False


def fault(case, done, limit_s, folder):
    """What is wrong with how it ended, or None."""
    if done.was_killed or done.cpu_s > limit_s:
        if case.victim and case.victim.endswith(".toml") and asks_for_long(folder, case):
            return None
        return f"{done.cpu_s:.1f} s of CPU, {done.wall_s:.1f} s" + " and no end" * done.was_killed
    if done.memory_mb > MEMORY_MB:
        return f"{done.memory_mb:.0f} MB"
    if "panicked" in done.err:
        return "panic"
    if "; report this as a bug" in done.err:
        return "a bug by its own words"
    if done.code not in (0, 2):
        return f"exit code {done.code}"
    if done.code == 2 and not is_named(case, done.err):
        return "the message names no input"
    return None


def is_named(case, err):
    """Whether the message names an input or an option."""
    names = re.findall(r"[\w.]+\.\w+|--[\w-]+", case.line)
    folders = [it for it in case.line.split() if it in cases.BESIDE and "." not in it]
    # Of a generator it is enough to say what it was to make, and with which number.
    names += [" ".join(case.line.split()[:2])] * case.line.startswith("generate")
    names += [it + end for it in folders for end in ("/", ":")]
    names += [case.victim.split("/")[-1]] if case.victim else []
    names += ["FROM", "TO", "unexpected argument '-"] * case.line.startswith("routes")
    # Files named in others, and those of which a checkpoint consists.
    names += cases.BESIDE.get(case.victim, []) + ["checkpoint"] * (case.line.startswith("run ck"))
    return "error:" in err and (any(it in err for it in names) or "for '<" in err)


class Pair:
    """The runs of a command with one kind of input."""

    def __init__(self, name, cases_of_it):
        self.name, self.cases = name, cases_of_it
        self.runs = self.zeros = self.twos = self.failures = self.by_hash = 0
        self.slowest = self.largest = 0.0

    def count(self, done, wrong):
        self.runs += 1
        self.zeros += done.code == 0
        self.twos += done.code == 2
        self.failures += wrong is not None
        self.by_hash += done.code == 2 and ("damaged" in done.err or "has changed since" in done.err)
        self.slowest, self.largest = max(self.slowest, done.cpu_s), max(self.largest, done.memory_mb)


class Test:
    def __init__(self, given):
        self.given = given
        self.program = str(Path(given.program).resolve())
        self.work = Path(tempfile.mkdtemp(prefix="mutations"))
        self.home = self.work / "home"
        self.home.mkdir()
        homes.make(self.program, self.home)
        self.kept, self.sound = 0, {}

    def one(self, case, number):
        """Runs the case with the mutations of this number; 0: as it is."""
        draw = random.Random(f"{self.given.seed} {number} {case.line} {case.victim}")
        folder = self.work / "case"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        copied(case, self.home, folder)
        line, ways = case.line, []

        def change(data):
            changed, names = mutate.mutated(draw, data, case.is_text)
            ways.extend(names)
            return changed
        messages = [it.encode() for it in case.messages]
        if number and messages:
            draw.shuffle(messages)
            messages = [mutate.mutated(draw, it, True)[0][:4000] if draw.random() < 0.7 else it for it in messages]
        elif number and case.victim:
            path = folder / case.victim
            path.write_bytes(case.wrap(draw, path.read_bytes(), change))
            if case.mends and draw.random() < 0.5:
                self.mend(folder, case.mends)
        elif number:
            line, ways = cases.changed_line(draw, line), ["numbers"]
        limit = max(SECONDS, TIMES * self.sound.get(case.line, 0.0))
        patience = limit * PATIENCE if number else LONGEST
        done = limited.run(self.program, shlex.split(line), folder, patience, self.given.cpu,
                           messages if case.serves else None)
        return done, fault(case, done, limit, folder), folder, f"laneweave {line}", ways

    def mend(self, folder, run):
        """Gives a run the summary, with its fingerprint, of what now lies in its folder, if that can be run."""
        line = f"run {run}/scenario.toml --out mended --quiet"
        limited.run(self.program, line.split(), folder, SECONDS, self.given.cpu)
        summary = folder / "mended/summary.json"
        if summary.exists():
            shutil.copyfile(summary, folder / run / "summary.json")
        shutil.rmtree(folder / "mended", ignore_errors=True)

    def keep(self, folder, line, wrong, done, ways):
        """Keeps a failing case."""
        self.kept += 1
        to = Path(self.given.keep) / f"{self.kept:04}"
        shutil.rmtree(to, ignore_errors=True)
        shutil.copytree(folder, to)
        (to / "COMMAND").write_text(f"{line}\n{wrong}\n{' '.join(ways)}\n{done.err[-4000:]}")
        print(f"{to}: {line}: {wrong}: {done.err.strip()[:200]!r}", flush=True)

    def run(self):
        chosen = re.compile(self.given.only)
        pairs = [Pair(name, it) for name, it in cases.pairs().items() if chosen.search(": ".join(name))]
        unsound = []
        for pair in pairs:
            for case in pair.cases:
                done, wrong, *_ = self.one(case, 0)
                # Twice the same recording may be refused: it does not continue itself.
                if wrong or done.code and pair.name[0] != "recording join":
                    unsound.append(f"laneweave {case.line}: sound, but {wrong or done.code}: {done.err}")
                self.sound[case.line] = done.cpu_s
                if done.cpu_s > 0.3:
                    print(f"laneweave {case.line}: {done.cpu_s:.1f} s as it is", file=sys.stderr)
        if unsound:
            raise SystemExit("\n".join(unsound))
        begun = time.monotonic()
        for number in range(self.given.first, self.given.first + self.given.runs):
            if time.monotonic() - begun > self.given.seconds:
                break
            pair = pairs[number % len(pairs)]
            case = pair.cases[number // len(pairs) % len(pair.cases)]
            done, wrong, folder, line, ways = self.one(case, number + 1)
            pair.count(done, wrong)
            if wrong:
                self.keep(folder, line, wrong, done, ways)
            if number % 200 == 199:
                passed = time.monotonic() - begun
                print(f"{number + 1} runs, {passed:.0f} s, {self.kept} failures", file=sys.stderr, flush=True)
        report(pairs, self.given.table)
        shutil.rmtree(self.work)
        return 1 if self.kept else 0


def report(pairs, path):
    lines = ["| command | input | runs | exit 0 | exit 2 | by a hash alone | failures | CPU [s] | memory [MB] |",
             "|---|---|--:|--:|--:|--:|--:|--:|--:|"]
    for it in sorted(pairs, key=lambda it: it.name):
        counts = f"{it.runs} | {it.zeros} | {it.twos} | {it.by_hash} | {it.failures}"
        lines.append(f"| {it.name[0]} | {it.name[1]} | {counts} | {it.slowest:.2f} | {it.largest:.0f} |")
    total = [sum(getattr(it, key) for it in pairs) for key in ("runs", "zeros", "twos", "by_hash", "failures")]
    most = [max(getattr(it, key) for it in pairs) for key in ("slowest", "largest")]
    lines.append(f"| all | {len(pairs)} pairs | " + " | ".join(map(str, total)) + f" | {most[0]:.2f} | {most[1]:.0f} |")
    text = "\n".join(lines) + "\n"
    print(text)
    if path:
        Path(path).write_text(text)


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("program", help="the program, built for release")
    reader.add_argument("--runs", type=int, default=10_000, help="number of changed inputs [default: 10000]")
    reader.add_argument("--first", type=int, default=0, help="number of the first of them [default: 0]")
    reader.add_argument("--seconds", type=float, default=float("inf"), help="end after this time [default: never]")
    reader.add_argument("--seed", default="1", help="seed of the changes [default: 1]")
    reader.add_argument("--only", default="", help='a pattern of "COMMAND: KIND OF INPUT" [default: all]')
    reader.add_argument("--keep", default="mutations-failed", help="folder of what fails [default: mutations-failed]")
    reader.add_argument("--table", help="file for the table of all runs")
    reader.add_argument("--cpu", type=int, default=0, help="the core on which commands run [default: 0]")
    return Test(reader.parse_args()).run()


if __name__ == "__main__":
    sys.exit(main())
