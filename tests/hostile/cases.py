"""What is mutated: for each command and each kind of its inputs at least one sound command line, and the file of it."""

import gzip
import re
from dataclasses import dataclass, field
from typing import Callable

import mutate
import seal

# Files that a file names, or that have to lie beside it.
BESIDE = {
    "full.toml": ["lights.osm", "own.toml", "commands.csv"],
    "full_parquet.toml": ["lights.osm", "own.toml", "commands.parquet"],
    "turns.toml": ["lights.osm"],
    "new.toml": ["lights.osm"],
    "replay.toml": ["road.osm", "rec.csv"],
    "01_tracks.csv": ["01_tracksMeta.csv", "01_recordingMeta.csv"],
    "02_tracks.csv": ["02_tracksMeta.csv", "02_recordingMeta.csv"],
    "run": ["road.osm"], "ck": ["road.osm"], "byhand": ["lights.osm", "commands.csv"],
    "byhand_parquet": ["lights.osm", "commands.csv"],
}
MAPS = {
    "Lanelet2": ["road.osm", "crossing.osm", "lights.osm"],
    "Lanelet2, packed": ["road.osm.gz"],
    "CommonRoad": ["fork.xml"],
}
TRACKS = {
    "INTERACTION": ["rec.csv"],
    "highD": ["01_tracks.csv", "01_tracks.csv 01_tracksMeta.csv", "01_tracks.csv 01_recordingMeta.csv"],
    "inD": ["02_tracks.csv", "02_tracks.csv 02_tracksMeta.csv", "02_tracks.csv 02_recordingMeta.csv"],
    "NGSIM": ["ngsim.csv"],
    "other CSV": ["other.csv --columns other.toml"],
    "Parquet": ["rec.parquet --columns columns.toml"],
    "columns": ["rec.parquet --columns columns.toml columns.toml", "other.csv --columns other.toml other.toml"],
}
# Way of a map: its first and last lanelet.
ENDS = {"road.osm": "1 16", "crossing.osm": "21 21", "lights.osm": "1 14", "fork.xml": "1 2", "road.osm.gz": "1 16"}
SHORT_REPLAY = "replay rec.csv --map road.osm --rollouts 1 --against null --reactive 0.5 --duration 5"
MESSAGES = [
    '{"ready":0}', '{"play":10.0}', '{"play":null}', '{"pause":true}', '{"step":5}', '{"seek":2.0}', '{"select":["1"]}',
    '{"find":"1"}', '{"colour":"desire"}', '{"lanes":true}', '{"view":[0.0,-50.0,300.0,50.0]}', '{"twin":true}',
    '{"hand":{"put":{"x":100.0,"y":-3.0,"class":"car"}}}', '{"hand":{"remove":{"vehicle":"1"}}}',
    '{"hand":{"drive":{"vehicle":"1","speed_kmh":30.0,"side":"left"}}}', '{"undo":true}', '{"save":true}',
    '{"hand":{"set_style":{"vehicle":"1","style":"conservative"}}}',
    '{"hand":{"set_demand":{"origin":"1","vehicles_per_hour":600.0}}}',
    '{"hand":{"set_share":{"style":"conservative","weight":2.0}}}',
    '{"hand":{"set_light":{"light":"37","shows":"red"}}}', '{"hand":{"set_offset":{"light":"38","offset_s":12.5}}}',
    '{"hand":{"close_lanelet":{"lanelet":"5","is_closed":true}}}',
    '{"hand":{"set_parameter":{"style":"conservative","parameter":"courtesy.weight","value":2.0}}}',
]


def plain(random, data, change):
    return change(data)


def packed_again(random, data, change):
    """What is packed is changed, not the package."""
    return gzip.compress(change(gzip.decompress(data)), 1, mtime=0)


@dataclass
class Case:
    """A command line, and the file (or None: the numbers on the command line) that is changed."""
    line: str
    victim: str | None
    wrap: Callable = plain
    # The command serves a page until it is interrupted; these messages are changed and sent to it.
    serves: bool = False
    messages: list = field(default_factory=list)
    # The folder of the run whose fingerprint is mended half of the time, as if it had been run like this.
    mends: str | None = None

    @property
    def is_text(self):
        binary = (".parquet", ".gz", "checkpoint", "checkpoint.pages")
        return self.victim is None or not self.victim.endswith(binary) or self.wrap is packed_again

    def needs(self, home):
        """The files and folders of its folder."""
        words = {re.split("[/=]", it)[0] for it in self.line.split()} | {self.line.split("commands=")[-1].split()[0]}
        words |= {self.victim.split("/")[0]} if self.victim else set()
        words |= {it.split("=")[0] for it in self.line.split()}
        found, todo = set(), list(words)
        while todo:
            name = todo.pop()
            if name not in found and (home / name).exists():
                found.add(name)
                todo += BESIDE.get(name, [])
        return sorted(found)


def of_maps():
    for kind, maps in MAPS.items():
        wraps = [plain, packed_again] if "packed" in kind else [plain]
        for name, line in [
            ("check", "check {m} --json --svg a.svg --graph g.json --html a.html"),
            ("run", "run {m} --duration 10 --threads 1 --quiet --flows 5"),
            ("routes", "routes {m} {ends} --longest 3"),
            ("scenario new", "scenario new {m} --out made.toml"),
            ("compare", "compare {m} --seeds 1 --duration 5 --model mcdm --model lmrs"),
            ("render", "render {m} --until 3 --every 3 --size 160x90"),
            ("view", "view {m} --no-browser"),
        ]:
            cases = [Case(line.format(m=m, ends=ENDS[m]), m, wrap, name == "view") for m in maps for wrap in wraps]
            yield name, kind, cases
        recording = "both.xml" if kind == "CommonRoad" else "rec.csv"
        for name, line in [
            ("check", "check {r} --map {m}"),
            ("replay", "replay {r} --map {m} --rollouts 1 --against null --reactive 0.5 --duration 5 --quiet"),
            ("fit", "fit {r} --map {m} --plan"),
        ]:
            yield name, kind + " of a recording", [Case(line.format(r=recording, m=maps[0]), maps[0])]
    yield "explain", "map of a run", [Case("explain run --summary", "road.osm", mends="run")]


def of_recordings():
    for kind, tracks in TRACKS.items():
        for name, line in [
            ("check", "check {r} --map road.osm"),
            ("replay", "replay {r} --map road.osm --rollouts 1 --against null --reactive 0.5 --duration 10 --quiet"),
            ("fit", "fit {r} --map road.osm --plan"),
            ("fit in full", "fit {r} --map road.osm --draws 2 --repetitions 1 --classes 1"),
            ("render", "render {r} --map road.osm --every 10 --size 160x90"),
            ("view", "view {r} --map road.osm --no-browser"),
            ("view --export", "view {r} --map road.osm --export a.html --every 5"),
            ("recording join", "recording join {again} {r} --to joined.csv"),
        ]:
            cases = []
            for it in tracks:
                words = it.split()
                victim = words.pop() if len(words) in (2, 4) else words[0]
                text = line.format(r=" ".join(words), again=words[0])
                cases.append(Case(text, victim, plain, name == "view"))
            yield name, kind, cases
    for name, line in [("recording join", "recording join a.csv b.csv --to c.csv"),
                       ("check", "check a.csv b.csv --map road.osm")]:
        yield name, "two of INTERACTION", [Case(line, it) for it in ("a.csv", "b.csv")]
    line = "reproduce C2 --quick --seeds 1 --site long.csv --map road.osm"
    yield "reproduce", "INTERACTION, Lanelet2", [Case(line, "long.csv"), Case(line, "road.osm")]
    for name, line in [
        ("check", "check both.xml --json"),
        ("replay", "replay both.xml --rollouts 1 --against null --reactive 0.5 --quiet"),
        ("fit", "fit both.xml --plan"),
        ("render", "render both.xml --every 5 --size 160x90"),
        ("view", "view both.xml --no-browser"),
        ("view --export", "view both.xml --export a.html --every 5"),
    ]:
        yield name, "CommonRoad with tracks", [Case(line, "both.xml", plain, name == "view")]


def of_scenarios():
    files = ["full.toml", "turns.toml", "new.toml", "replay.toml"]
    for name, line in [
        ("run", "run {} --duration 10 --warmup 1 --threads 1 --quiet"),
        ("compare", "compare {} --seeds 1 --duration 5 --warmup 1 --model mcdm"),
        ("render", "render {} --until 3 --every 3 --size 160x90"),
        ("view", "view {} --no-browser"),
    ]:
        some = files[:3] if name == "compare" else files
        yield name, "scenario", [Case(line.format(it), it, plain, name == "view") for it in some]
    for name, line in [
        ("run", "run road.osm --duration 10 --threads 1 --quiet --style {}=1"),
        ("styles show", "styles show {}"),
        ("styles new", "styles new other --from {}"),
        ("fit", "fit rec.csv --map road.osm --plan --prior {}"),
        ("replay", f"{SHORT_REPLAY} --style {{}}=1"),
    ]:
        # A fit begins at weights, which MOBIL has not.
        styles = ["own.toml", "fitted.toml"] + ["mobil.toml"] * (name != "fit")
        yield name, "style", [Case(line.format(it), it) for it in styles]
    line = "run road.osm --duration 5 --threads 1 --quiet --style fitted.toml=1 --draw-parameters 2"
    yield "run", "fitted style", [Case(line, "fitted.toml")]
    run = "run {} --duration 10 --warmup 1 --threads 1 --quiet"
    yield "run", "commands", [Case(run.format("full.toml"), "commands.csv"),
                              Case(run.format("full_parquet.toml"), "commands.parquet")]
    yield "branch", "commands", [Case("branch run --at 0.5 --set commands=road.csv", "road.csv")]


def of_results():
    repeats = [
        ("explain", "explain {} --vehicle 3 --flip"),
        ("explain", "explain {} --summary"),
        ("observe", "observe {} --rate 5"),
        ("branch", "branch {} --at 5 --set conservative.follow.jam_gap=3"),
        ("render", "render {} --size 160x90 --every 10"),
        ("view", "view {} --no-browser"),
        ("view", "view {} --no-browser --at 5 --set conservative.follow.jam_gap=3"),
        ("view --export", "view {} --export a.html --every 5"),
        ("run --resume", "run {} --resume --quiet"),
    ]
    inside = [("run/summary.json", "summary"), ("run/scenario.toml", "scenario of a run"),
              ("run/styles/own.toml", "style of a run"), ("byhand/commands.csv", "commands of a run"),
              ("byhand_parquet/commands.parquet", "commands of a run")]
    by_pair = {}
    for name, line in repeats:
        for victim, kind in inside:
            folder = victim.split("/")[0]
            case = Case(line.format(folder), victim, plain, name == "view",
                        mends=folder if victim.endswith(".toml") else None)
            by_pair.setdefault((name, kind), []).append(case)
    for (name, kind), cases in by_pair.items():
        yield name, kind, cases
    resume = "run ck --resume --quiet --threads 1"
    yield "run --resume", "checkpoint", [Case(resume, "ck/checkpoint", seal.checkpoint)]
    yield "run --resume", "checkpoint, hash not mended", [Case(resume, "ck/checkpoint")]
    yield "run --resume", "log of tables", [Case(resume, "ck/checkpoint.pages", seal.pages),
                                            Case(resume, "ck/checkpoint.pages")]
    yield "run --resume", "scenario of an incomplete run", [Case(resume, "ck/scenario.toml")]
    yield "run --resume", "map of an incomplete run", [Case(resume, "road.osm")]


def of_options():
    lines = [
        "generate motorway --lanes 2 --length 900 --on-ramp-at 300 --lane-drop-at 600 --speed-limit 100 a.osm",
        "generate weaving --length 300 a.osm", "generate grid --rows 2 --columns 1 --lanes 1 a.osm",
        "generate arterial --junctions 2 --block-length 150 --speed-limit 60 a.osm",
        "generate roundabout --arms 4 --lanes 1 --radius 25 a.osm", "generate town --size 3 a.osm",
        "generate random --seed 17 a.osm",
    ]
    yield "generate", "numbers", [Case(it, None) for it in lines]
    for name, line in [
        ("run", "run road.osm --duration 10 --warmup 2 --step 0.1 --demand 900 --seed 3 --trucks 0.2 --record 1 "
                "--flows 5 --checkpoint 5 --threads 1 --quiet"),
        ("routes", "routes road.osm 1 16 --most 3 --longest 2"),
        ("compare", "compare road.osm --seeds 1 --demand 900 --duration 5 --warmup 1 --model mcdm"),
        ("render", "render run --every 10 --from 5 --until 20 --camera 100,-3,300 --size 160x90"),
        ("explain", "explain run --vehicle 3 --time 20"),
        ("observe", "observe run --rate 5 --from 2 --until 20 --above 100,0 --view 300 --noise 0.1 --lost-every 10 "
                    "--lost-for 1"),
        ("branch", "branch run --at 5 --set style.speed.weight=2"),
        ("replay", "replay rec.csv --map road.osm --rollouts 1 --against null --reactive-ids 1,2,3 --from 2 "
                   "--duration 10 --record 1 --seed 1 --quiet"),
        ("fit", "fit rec.csv --map road.osm --draws 2 --repetitions 1 --classes 1 --lead 1.5 --position-error 0.1 "
                "--seed 1"),
        ("check", "check crossing.osm --origin 49,8.4 --max-map-size 100MB"),
    ]:
        yield name, "numbers", [Case(line, None)]
    yield "view", "messages", [Case("view lights.osm --no-browser", None, plain, True, MESSAGES),
                               Case("view run --no-browser", None, plain, True, MESSAGES)]


def pairs():
    """All of them: {(command, kind of input): cases}."""
    found = {}
    for part in (of_maps, of_recordings, of_scenarios, of_results, of_options):
        for name, kind, cases in part():
            found.setdefault((name, kind), []).extend(cases)
    return found


def changed_line(random, line):
    """The command line with odd numbers."""
    words = line.split()
    is_number = [mutate.NUMBER.fullmatch(re.split("[,=]", it)[-1].encode()) for it in words]
    numbers = [it for it in range(2, len(words)) if is_number[it]]
    for it in random.sample(numbers, min(len(numbers), random.choice([1, 1, 2]))):
        words[it] = mutate.number(random, words[it].encode()).decode("utf-8", "replace") or "''"
    return " ".join(words)
