"""What SUMO's own tools read from our files, against our tables and summary.

    python sumo_tools.py LANEWEAVE MAP...

For every map the command runs twice with `--sumo fcd,tripinfo,lanechange`. The files must satisfy SUMO's schemas; its parsers
(sumolib) must find in them the vehicles, positions, trips and lane changes of the tables; and its scripts plot_trajectories,
fcdDiff, tripStatistics, tripinfoByType and attributeStats the same numbers as the summary. Needs eclipse-sumo and sumolib
1.28.0, pandas, pyarrow, matplotlib, lxml. Ends with 1 if anything differs.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

import lxml.etree
import numpy
import pandas
import sumo
import sumolib.xml

SUMO = Path(sumo.SUMO_HOME)
# Numbers in SUMO's files have two decimals.
ROUNDING = 0.005 + 1e-9
RUN = ["--duration", "200", "--warmup", "20", "--quiet", "--sumo", "fcd,tripinfo,lanechange"]


class Comparison:
    """Counts what was compared, and keeps what differs."""

    def __init__(self):
        self.compared, self.wrong = 0, []

    def equal(self, what, ours, theirs):
        self.compared += 1
        if ours != theirs:
            self.wrong.append(f"{what}: {ours} here, {theirs} there")

    def near(self, what, ours, theirs, tolerance=ROUNDING):
        ours, theirs = numpy.asarray(ours, float), numpy.asarray(theirs, float)
        self.compared += ours.size
        if ours.shape != theirs.shape:
            self.wrong.append(f"{what}: {ours.shape} numbers here, {theirs.shape} there")
        elif ours.size and not (numpy.abs(ours - theirs) <= tolerance).all():
            worst = numpy.nanargmax(numpy.abs(ours - theirs)) if ours.ndim else ()
            self.wrong.append(f"{what}: {ours[worst]} here, {theirs[worst]} there")


def script(name, *arguments, folder):
    """What one of SUMO's scripts prints."""
    environment = {**os.environ, "SUMO_HOME": str(SUMO), "MPLBACKEND": "Agg"}
    environment["PYTHONPATH"] = str(SUMO / "tools")
    command = [sys.executable, SUMO / "tools" / name, *arguments]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{name}: {done.stderr}")
    return done.stdout


def table(path, element, attributes, texts):
    """The elements of a file; `attributes` in the order in which they stand there, `texts` those that are no numbers."""
    # The parser renames what is a word of the language.
    found = sumolib.xml.parse_fast(str(path), element, attributes)
    rows = [[getattr(it, "attr_from" if name == "from" else name) for name in attributes] for it in found]
    frame = pandas.DataFrame(rows, columns=attributes)
    return frame.astype({name: float for name in attributes if name not in texts})


def schemas_hold(folder, result):
    for file, schema in [("fcd.xml", "fcd_file.xsd"), ("tripinfo.xml", "tripinfo_file.xsd")]:
        rules = lxml.etree.XMLSchema(file=str(SUMO / "data" / "xsd" / schema))
        rules.validate(lxml.etree.parse(str(folder / file)))
        result.equal(f"{file}: breaches of {schema}", [], [str(it) for it in rules.error_log][:3])


def positions_agree(folder, lanes, result):
    """fcd.xml against the table of trajectories."""
    numbers = ["id", "x", "y", "angle", "speed", "pos", "acceleration"]
    found = [
        [float(time.time), *(float(getattr(it, name)) for name in numbers), it.lane, it.type]
        for time, it in sumolib.xml.parse_fast_nested(
            str(folder / "fcd.xml"), "timestep", ["time"], "vehicle",
            ["id", "x", "y", "angle", "type", "speed", "pos", "lane", "acceleration"],
        )
    ]
    theirs = pandas.DataFrame(found, columns=["time", *numbers, "lane", "type"])
    ours = pandas.read_parquet(folder / "trajectories.parquet")
    result.equal("fcd: samples", len(ours), len(theirs))
    if len(ours) != len(theirs):
        return
    result.near("fcd: times", ours.time_s, theirs.time, 0.0006)
    result.near("fcd: vehicles", ours.vehicle, theirs.id, 0)
    result.near("fcd: speeds", ours.speed_mps, theirs.speed)
    result.near("fcd: accelerations", ours.acceleration_mps2, theirs.acceleration)
    result.near("fcd: positions on lanes", ours.position_m, theirs.pos)
    result.equal("fcd: lanes", list(ours.lanelet.map(lanes)), list(theirs.lane))
    result.equal("fcd: types", list(ours["class"]), list(theirs.type))
    # Clockwise from north [°].
    turn = (90.0 - numpy.degrees(ours.heading_rad) - theirs.angle + 180.0) % 360.0 - 180.0
    result.near("fcd: angles", turn, 0 * turn)
    # The front bumper, half a length ahead of the centre; in bends the chord is shorter, in a lane change longer by a little.
    ahead = [theirs.x - ours.x_m, theirs.y - ours.y_m]
    along = ahead[0] * numpy.cos(ours.heading_rad) + ahead[1] * numpy.sin(ours.heading_rad)
    beside = ahead[1] * numpy.cos(ours.heading_rad) - ahead[0] * numpy.sin(ours.heading_rad)
    result.near("fcd: fronts beside the axis", beside, 0 * beside, 2 * ROUNDING)
    result.near("fcd: fronts ahead of the centre", along / ours.length_m, 0.5 + 0 * along, 0.05)
    straight = numpy.abs(along - 0.5 * ours.length_m) < 2 * ROUNDING
    result.equal("fcd: most fronts are half a length ahead", True, bool(straight.mean() > 0.5))


def trips_agree(folder, summary, lanes, result):
    """tripinfo.xml against the table of trips and the summary."""
    attributes = ["id", "depart", "departLane", "departDelay", "arrival", "arrivalLane", "duration", "routeLength"]
    attributes += ["waitingTime", "waitingCount", "timeLoss", "rerouteNo", "vType"]
    theirs = table(folder / "tripinfo.xml", "tripinfo", attributes, ["departLane", "arrivalLane", "vType"])
    trips = pandas.read_parquet(folder / "trips.parquet")
    ours = trips[trips.completed_s.notna()].reset_index()
    result.equal("trips that began", summary["entered"], len(trips))
    result.equal("trips that ended", summary["completed"], len(theirs))
    result.near("tripinfo: mean duration", summary["mean_trip_duration_s"], theirs.duration.mean())
    result.near("tripinfo: mean number of stops", summary["mean_stops"], theirs.waitingCount.mean(), 1e-9)
    # Delays of our summary count free times in tenths; those of SUMO are never negative.
    result.near("trips: mean delay", summary["mean_delay_s"], ours.delay_s.mean(), 0.05)
    delay = ours.delay_s.clip(lower=0.0)
    pairs = [
        ("id", ours.vehicle), ("depart", ours.entered_s), ("departDelay", ours.insertion_delay_s), ("arrival", ours.completed_s),
        ("duration", ours.duration_s), ("routeLength", ours.length_m), ("waitingTime", ours.standing_s),
        ("waitingCount", ours.stops), ("timeLoss", delay), ("rerouteNo", ours.route_changes + ours.missed_turns),
    ]
    for name, column in pairs:
        result.near(f"tripinfo: {name}", column, theirs[name])
    result.equal("tripinfo: vType", list(ours["class"]), list(theirs.vType))
    result.equal("tripinfo: departLane", list(ours.from_lanelet.map(lanes)), list(theirs.departLane))
    result.equal("tripinfo: arrivalLane", list(ours.to_lanelet.map(lanes)), list(theirs.arrivalLane))

    printed = script("output/tripStatistics.py", "-t", "tripinfo.xml", "-o", "moe.txt", folder=folder)
    text = (folder / "moe.txt").read_text() + printed
    of = lambda name: float(re.search(re.escape(name) + r":([-\d.e]+)", text)[1])
    result.equal("tripStatistics: vehicles", float(len(ours)), of("total number of vehicles"))
    result.near("tripStatistics: travel time", ours.duration_s.mean(), of("average vehicular travel time(s)"))
    result.near("tripStatistics: travel length", ours.length_m.mean(), of("average vehicular travel length(m)"))
    waiting = (ours.insertion_delay_s + ours.standing_s).mean()
    result.near("tripStatistics: waiting time", waiting, of("average vehicular waiting time(s)"), 2 * ROUNDING)

    script("output/tripinfoByType.py", "-t", "tripinfo.xml", "-o", "types.xml", folder=folder)
    types = {it.get("vType"): it for it in xml.etree.ElementTree.parse(folder / "types.xml").iter("typeInfo")}
    by_class = ours.groupby("class").duration_s
    result.equal("tripinfoByType: classes", sorted(by_class.groups), sorted(types))
    for name, durations in by_class:
        result.equal(f"tripinfoByType: {name}", len(durations), int(types[name].get("count")))
        result.near(f"tripinfoByType: {name}", durations.mean(), float(types[name].get("mean")), 0.01)


def lane_changes_agree(folder, lanes, result):
    """lanechanges.xml against the table of lane changes."""
    texts = ["type", "from", "to", "reason", "leaderGap", "followerGap"]
    attributes = ["id", "type", "time", "from", "to", "dir", "speed", "reason", "leaderGap", "followerGap"]
    theirs = table(folder / "lanechanges.xml", "change", attributes, texts)
    changes = pandas.read_parquet(folder / "lane_changes.parquet")
    ours = changes[changes.outcome == "completed"].reset_index()
    result.equal("lanechange: changes", len(ours), len(theirs))
    result.near("lanechange: vehicles", ours.vehicle, theirs.id, 0)
    result.near("lanechange: times", ours.time_s, theirs.time)
    result.near("lanechange: speeds", ours.speed_mps, theirs.speed)
    result.near("lanechange: sides", ours.side.map({"left": 1, "right": -1}), theirs.dir, 0)
    for column, name in [(ours.from_lanelet, "from"), (ours.to_lanelet, "to")]:
        result.equal(f"lanechange: {name}", list(column.map(lanes)), list(theirs[name]))
    for column, name in [(ours.gap_ahead_m, "leaderGap"), (ours.gap_behind_m, "followerGap")]:
        gaps = pandas.to_numeric(theirs[name].replace("None", numpy.nan))
        result.equal(f"lanechange: nobody by {name}", list(column.isna()), list(gaps.isna()))
        result.near(f"lanechange: {name}", column.dropna(), gaps.dropna())
    lanelets = pandas.read_parquet(folder / "lanelets.parquet")
    counted = lanelets[["changes_to_left", "changes_to_right", "changes_from_left", "changes_from_right"]].sum()
    result.equal("lanelets: lane changes", [len(ours)] * 2, [counted.iloc[:2].sum(), counted.iloc[2:].sum()])
    if len(ours):
        script("output/attributeStats.py", "lanechanges.xml", "-e", "change", "-a", "speed", "-x", "speeds.xml", folder=folder)
        found = xml.etree.ElementTree.parse(folder / "speeds.xml").find("change/speed")
        result.equal("attributeStats: changes", len(ours), int(found.get("count")))
        result.near("attributeStats: mean speed", ours.speed_mps.mean(), float(found.get("mean")), 0.01)


def plots_and_repeats(folder, again, result):
    """plot_trajectories draws every vehicle; a second run is the same."""
    options = ["-t", "td", "--csv-output", "plot.csv", "-o", "plot.png", "--blind", "-v"]
    printed = script("plot_trajectories.py", *options, "fcd.xml", folder=folder)
    ours = pandas.read_parquet(folder / "trajectories.parquet")
    result.equal("plot_trajectories: points", f"Found {len(ours)} datapoints", printed[: printed.find(" in ")])
    drawn = re.findall(r'^"(\d+)"$', (folder / "plot.csv").read_text(), re.MULTILINE)
    result.equal("plot_trajectories: vehicles", sorted(map(str, ours.vehicle.unique())), sorted(drawn))
    result.equal("plot_trajectories: picture", True, (folder / "plot.png").stat().st_size > 10_000)
    printed = script("output/fcdDiff.py", folder / "fcd.xml", again / "fcd.xml", folder=folder)
    found = re.search(r"count (\d+), min ([\d.]+) .*?max ([\d.]+)", printed)
    result.equal("fcdDiff: two runs", [str(len(ours)), "0.00", "0.00"], list(found.groups()))


def compare(program, path):
    result = Comparison()
    with tempfile.TemporaryDirectory() as temporary:
        folders = [Path(temporary) / name for name in ("one", "two")]
        for folder, threads in zip(folders, ("1", "2")):
            subprocess.run([program, "run", path, *RUN, "--out", folder, "--threads", threads], check=True)
        folder, again = folders
        summary = json.loads((folder / "summary.json").read_text())
        lanelets = pandas.read_parquet(folder / "lanelets.parquet")
        lanes = dict(zip(lanelets.lanelet, lanelets.sumo_lane))
        result.equal("lanes are told apart", len(lanelets), len(set(lanes.values())))
        schemas_hold(folder, result)
        positions_agree(folder, lanes, result)
        trips_agree(folder, summary, lanes, result)
        lane_changes_agree(folder, lanes, result)
        plots_and_repeats(folder, again, result)
    print(f"{Path(path).name}: {result.compared} numbers and names compared, {len(result.wrong)} differences")
    for line in result.wrong[:10]:
        print(f"    {line[:300]}")
    return not result.wrong


if __name__ == "__main__":
    program, *maps = sys.argv[1:]
    sys.exit(not all([compare(program, path) for path in maps]))
