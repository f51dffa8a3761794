"""A folder with a small sound input of every kind, made by the program and from the seeds of the fuzz targets."""

import csv
import gzip
import math
import shutil
import signal
import subprocess
import time
from pathlib import Path

SEEDS = Path(__file__).resolve().parents[2] / "fuzz/seeds"
FEET = 0.3048

FULL = """map = "lights.osm"
made_signals = "actuated"
commands = "commands.csv"
[map_options]
origin = [49.0, 8.4]
law = "germany"
driving_side = "right"
joins_ends = true
max_size_mb = 100.0
[demand]
trucks = 0.1
buses = 0.05
entrances = { 12 = 300.0, 13 = [[0.0, 200.0], [5.0, 400.0]] }
exits = { 2 = 2.0, 14 = 1.0 }
profile = [[0.0, 1.0], [5.0, 1.5]]
headways = { law = "cowan-m3", minimum_s = 1.2, free = 0.7 }
od = [{ from = "1", to = "14", vehicles_per_hour = 300.0 }]
[[demand.line]]
name = "12"
class = "bus"
from = "24"
to = "11"
first_s = 0.0
every_s = 10.0
until_s = 100.0
stops = [{ lanelet = 24, position_m = 40.0, rest_s = 3.0 }]
[[signals]]
offset_s = 5.0
cycle_s = 55.0
phases = [{ green = [37, 39], green_s = 20.0, yellow_s = 3.0, all_red_s = 2.0 }, { green = [38, 40], green_s = 25 }]
[[obstacle]]
lanelet = 13
position_m = 50.0
length_m = 4.0
width_m = 1.8
from_s = 1.0
until_s = 8.0
[guidance]
interval_s = 5.0
[run]
duration_s = 10.0
step_s = 0.1
seed = 1
warmup_s = 1.0
audit = true
threads = 1
[styles]
"own.toml" = 1.0
conservative = 7.4
[output]
dir = "out"
record_s = 1.0
flows_s = 5.0
format = "csv"
checkpoint_s = 5.0
sumo = ["fcd", "tripinfo", "lanechange"]
"""
TURNS = """map = "lights.osm"
model = "lmrs"
demand = { vehicles_per_hour = 900.0, headways = { law = "erlang", stages = 3 } }
turns = [{ from = 12, left = 1.0, straight = 2.5, right = 1 }]
styles = { conservative = 1.0 }
output = { dir = "out", record_s = 0.5 }
run = { duration_s = 10.0 }
[[signals]]
phases = [{ green = [37, 39], max_green_s = 40, min_green_s = 5, gap_s = 2 }, { green = [38, 40], max_green_s = 20 }]
[[external]]
name = "guest"
time_s = 0.5
lanelet = 1
position_m = 30.0
speed_mps = 8.0
class = "car"
style = "conservative"
destination = 14
held_speed_mps = 7.0
keeps_lane = true
"""
REPLAY = """map = "road.osm"
run = { duration_s = 10.0, seed = 1, threads = 1 }
styles = { conservative = 1.0 }
output = { dir = "out", format = "csv" }
[replay]
recording = ["rec.csv"]
reactive_ids = [1, 2, 3]
reactive_from_s = 2.0
"""
COMMANDS = [
    (0.0, "style", "", "set_share", '{"style":"conservative","weight":2.0}'),
    (0.5, "vehicle", 0, "insert",
     '{"lanelet":1,"position_m":30.0,"speed_mps":8.0,"class":"car","style":"conservative","destination":14}'),
    (1.0, "light", 37, "set_light", '{"light":37,"shows":"red"}'),
    (2.0, "light", 38, "set_offset", '{"light":38,"offset_s":12.5}'),
    (2.5, "origin", 12, "set_demand", '{"origin":12,"vehicles_per_hour":600.0}'),
    (3.5, "style", "", "set_parameter", '{"style":"conservative","parameter":"change.courtesy.weight","value":2.0}'),
    (4.0, "vehicle", 0, "control", '[0,{"drive":{"longitudinal":{"speed":10.0},"lateral":"keep"}}]'),
    (5.0, "vehicle", 0, "control", '[0,{"pose":{"x":12.5,"y":-3.25,"heading":0.1,"speed":8.0}}]'),
    (6.0, "vehicle", 0, "remove", "0"),
]
ROAD_COMMANDS = [
    (1.0, "lanelet", 5, "close_lanelet", '{"lanelet":5,"is_closed":true}'),
    (2.0, "vehicle", 0, "insert",
     '{"lanelet":3,"position_m":30.0,"speed_mps":20.0,"class":"truck","style":"conservative"}'),
    (4.0, "vehicle", 0, "set_style", '[0,"conservative"]'),
    (5.0, "vehicle", 0, "control", '[0,{"drive":{"longitudinal":"driver","lateral":{"change":"left"}}}]'),
    (8.0, "lanelet", 5, "close_lanelet", '{"lanelet":5,"is_closed":false}'),
]
COLUMNS = """point = "centre"
axes = "y_up"
reused_after_s = 30
[columns]
track = "vehicle"
time = "time_s"
x = "x_m"
y = "y_m"
speed = "speed_mps"
heading = "heading_rad"
[units]
length = "m"
angle = "rad"
time = "s"
[classes]
passenger = "car"
hgv = "truck"
"""
TEXT_COLUMNS = """frames_per_second = 5
point = "front"
header = ["who", "when", "east", "north", "what"]
[columns]
track = "who"
frame = "when"
x = "east"
y = "north"
class = "what"
[units]
length = "ft"
[classes]
car = "car"
"""


def table(path, rows, header=None, separator=","):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, delimiter=separator, lineterminator="\n")
        writer.writerows([header.split()] if header else [])
        writer.writerows(rows)


def tables(home):
    """The recording in the layouts of other datasets."""
    rows = list(csv.DictReader(open(home / "rec.csv")))
    for row in rows:
        for key in ("x", "y", "vx", "vy", "psi_rad", "length", "width"):
            row[key] = float(row[key])
    ids = {row["track_id"]: row["agent_type"] for row in rows}
    for name in ("01", "02"):
        table(home / f"{name}_tracksMeta.csv", [(it, what.title()) for it, what in ids.items()], "trackId class")
        table(home / f"{name}_recordingMeta.csv", [(1, 5, 0.0, 0.0)], "id frameRate xUtmOrigin yUtmOrigin")
    table(home / "01_tracks.csv", [
        (it["frame_id"], it["track_id"], it["x"] - it["length"] / 2, -it["y"] - it["width"] / 2, it["length"],
         it["width"], it["vx"], -it["vy"]) for it in rows], "frame id x y width height xVelocity yVelocity")
    table(home / "02_tracks.csv", [
        (0, it["track_id"], it["frame_id"], it["x"], it["y"], math.degrees(it["psi_rad"]), it["width"], it["length"],
         it["vx"], it["vy"]) for it in rows],
        "recordingId trackId frame xCenter yCenter heading width length xVelocity yVelocity")

    def front(it):
        return [(it["x"] + math.cos(it["psi_rad"]) * it["length"] / 2) / FEET,
                (it["y"] + math.sin(it["psi_rad"]) * it["length"] / 2) / FEET]
    table(home / "ngsim.csv", [
        (it["track_id"], it["frame_id"], 1118846980200 + int(it["timestamp_ms"]), *front(it), it["length"] / FEET,
         it["width"] / FEET, 3 if it["agent_type"] == "truck" else 2, math.hypot(it["vx"], it["vy"]) / FEET)
        for it in rows], "Vehicle_ID Frame_ID Global_Time Local_X Local_Y v_Length v_Width v_Class v_Vel")
    table(home / "other.csv", [
        ("veh_" + it["track_id"], it["frame_id"], *(f"{n:.3f}".replace(".", ",") for n in front(it)), "car")
        for it in rows], separator=";")


def commonroad(home):
    """A map with vehicles on it, in one file."""
    def state(step, x, kind, vehicle):
        # One of them changes lanes.
        y = 2 if vehicle != 1 else 4 + 2 * math.cos(min(max(x - 12, 0), 30) / 30 * math.pi)
        return (f"<{kind}><position><point><x>{x:.2f}</x><y>{y:.2f}</y></point></position><orientation><exact>0</exact>"
                f"</orientation><time><exact>{step}</exact></time><velocity><exact>10</exact></velocity></{kind}>\n")
    obstacles = ""
    for vehicle in range(3):
        states = [(step, step - 12 * vehicle) for step in range(12 * vehicle, 12 * vehicle + 80)]
        obstacles += (
            f'<dynamicObstacle id="{70 + vehicle}"><type>car</type><shape><rectangle><length>4.5</length><width>1.8'
            "</width></rectangle></shape>" + state(states[0][0], 2.0, "initialState", vehicle) + "<trajectory>"
            + "".join(state(step, 2.0 + run, "state", vehicle) for step, run in states[1:])
            + "</trajectory></dynamicObstacle>\n")
    fork = (home / "fork.xml").read_text()
    (home / "both.xml").write_text(fork.replace("</commonRoad>", obstacles + "</commonRoad>"))


def interrupted(program, home):
    """A run that was ended by force after it had left a checkpoint, before its end."""
    options = "--duration 300 --demand 1500 --threads 1 --checkpoint 20 --flows 20 --out ck --quiet".split()
    for _ in range(100):
        shutil.rmtree(home / "ck", ignore_errors=True)
        run = subprocess.Popen([program, "run", "road.osm", *options], cwd=home)
        while run.poll() is None and not (home / "ck/checkpoint").exists():
            time.sleep(0.001)
        run.send_signal(signal.SIGKILL)
        run.wait()
        if not (home / "ck/summary.json").exists():
            return
    raise SystemExit("no run could be ended between its first checkpoint and its end")


def make(program, home):
    """Makes it in the folder `home`."""
    def laneweave(line):
        done = subprocess.run([program, *line.split()], cwd=home, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"laneweave {line}: {done.returncode}\n{done.stderr}")
    for seed, name in [("lanelet2/on_ramp.osm", "road.osm"), ("lanelet2/crossing.osm", "crossing.osm"),
                       ("commonroad_map/fork_2020a.xml", "fork.xml"), ("style/mobil.toml", "mobil.toml")]:
        shutil.copyfile(SEEDS / seed, home / name)
    (home / "road.osm.gz").write_bytes(gzip.compress((home / "road.osm").read_bytes(), mtime=0))
    for name, text in [("full.toml", FULL), ("turns.toml", TURNS), ("replay.toml", REPLAY), ("columns.toml", COLUMNS),
                       ("other.toml", TEXT_COLUMNS)]:
        (home / name).write_text(text)
    (home / "full_parquet.toml").write_text(FULL.replace("commands.csv", "commands.parquet"))
    table(home / "commands.csv", COMMANDS, "time_s target id act values")
    table(home / "road.csv", ROAD_COMMANDS, "time_s target id act values")
    laneweave("generate grid --rows 1 --columns 1 --lanes 1 lights.osm")
    laneweave("scenario new lights.osm --out new.toml")
    laneweave("styles new own --from aggressive")
    run = "--demand 1500 --threads 1 --quiet"
    laneweave(f"run road.osm --duration 30 --warmup 5 --out run --style own.toml=1 --style conservative=1 {run}")
    laneweave("run road.osm --duration 200 --out long --demand 600 --threads 1 --quiet")
    laneweave("observe run --rate 5 --to rec.csv")
    laneweave("observe long --rate 2 --to long.csv")
    laneweave("observe run --rate 5 --until 15 --to a.csv")
    laneweave("observe run --rate 5 --from 15 --to b.csv")
    laneweave("run full.toml --out byhand --quiet")
    laneweave("run full.toml --out byhand_parquet --format parquet --quiet")
    shutil.copyfile(home / "run/trajectories.parquet", home / "rec.parquet")
    shutil.copyfile(home / "byhand_parquet/commands.parquet", home / "commands.parquet")
    laneweave("fit rec.csv --map road.osm --draws 2 --repetitions 1 --classes 1 --out fit")
    shutil.copyfile(home / "fit/fitted.toml", home / "fitted.toml")
    tables(home)
    commonroad(home)
    interrupted(program, home)
