"""Nets of SUMO against SUMO itself.

    python sumo_nets.py LANEWEAVE NET...

For every net, and for ten that netgenerate makes, each connection that a passenger car may use is looked for in the graph
that `LANEWEAVE check NET --graph` writes, and each static light is compared with what SUMO 1.28 shows in every second of two
cycles. The package laneweave has to be importable. Ends with 1 if anything differs.
"""

import gzip
import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

import laneweave as lw
import sumo
import sumolib

BIN = Path(sumo.SUMO_HOME) / "bin"
SHOWN = {**dict.fromkeys("GgOos", "green"), **dict.fromkeys("yY", "yellow"), **dict.fromkeys("ruRU", "red")}
# Kinds, lights, lanes for turns, and the side of the road.
GENERATED = [
    ["--grid", "--grid.number=4", "-L=2", "-j=traffic_light"],
    ["--grid", "--grid.number=3", "-L=3", "-j=priority", "--turn-lanes=1"],
    ["--grid", "--grid.number=5", "-L=1", "-j=right_before_left"],
    ["--grid", "--grid.number=4", "-L=2", "-j=traffic_light", "--turn-lanes=1", "--lefthand"],
    ["--spider", "--spider.arm-number=6", "--spider.circle-number=3", "-L=2", "-j=traffic_light"],
    ["--spider", "--spider.arm-number=5", "--spider.circle-number=2", "-L=1", "-j=allway_stop"],
    ["--spider", "--spider.arm-number=8", "--spider.circle-number=4", "-L=2", "-j=priority", "--lefthand"],
    ["--grid", "--grid.number=3", "-L=1", "-j=traffic_light_right_on_red"],
    ["--rand", "--rand.iterations=80", "--rand.min-distance=100", "--rand.max-distance=300", "-L=2", "-j=traffic_light", "--turn-lanes=1"],
    ["--rand", "--rand.iterations=60", "--rand.min-distance=100", "--rand.max-distance=300", "-L=2", "-j=priority"],
]


def connections(net):
    """Pairs of lanes between which a car may drive."""
    may = lambda lane: lane is None or lane.allows("passenger")  # noqa: E731
    for edge in net.getEdges(withInternal=False):
        for outgoing in edge.getOutgoing().values():
            for it in outgoing:
                ends = [it.getFromLane(), it.getToLane()]
                via = net.getLane(it.getViaLaneID()) if it.getViaLaneID() else None
                if all(map(may, [*ends, via])):
                    yield tuple(lane.getID() for lane in ends)


def lost_connections(program, path, folder):
    net = sumolib.net.readNet(str(path), withInternal=True)
    file = folder / "graph.json"
    subprocess.run([program, "check", path, "--graph", file], check=True, stdout=subprocess.DEVNULL)
    graph = json.loads(file.read_text())
    found = set()
    for lanelet, entry in graph.items():
        for next_one in entry["following"]:
            found.add((lanelet, next_one))
            found |= {(lanelet, beyond) for beyond in graph[next_one]["following"]}
    expected = list(connections(net))
    return [it for it in expected if it not in found], len(expected)


def static_programs(path):
    """For each static program its cycle [s]."""
    with (gzip.open(path) if path.suffix == ".gz" else path.open("rb")) as file:
        root = xml.etree.ElementTree.parse(file).getroot()
    logics = [it for it in root.iter("tlLogic") if it.get("type") == "static"]
    return {it.get("id"): sum(float(phase.get("duration")) for phase in it.iter("phase")) for it in logics}


def states_of_sumo(path, ids, seconds, folder):
    """For each second and program what SUMO shows."""
    events = "".join(f'<timedEvent type="SaveTLSStates" source="{it}" dest="states.xml"/>' for it in ids)
    (folder / "events.add.xml").write_text(f"<additional>{events}</additional>")
    command = [BIN / "sumo", "-n", path.resolve(), "-a", "events.add.xml", "--begin", "0", "--end", str(seconds)]
    subprocess.run([*command, "--no-step-log", "--no-warnings"], check=True, cwd=folder, stdout=subprocess.DEVNULL)
    states = xml.etree.ElementTree.parse(folder / "states.xml").getroot().iter("tlsState")
    return {(int(float(it.get("time"))), it.get("id")): it.get("state") for it in states}


def wrong_states(path, folder):
    """What lights show where they differ, and the number of comparisons."""
    programs = static_programs(path)
    if not programs:
        return [], 0
    seconds = int(2 * max(programs.values())) + 1
    expected = states_of_sumo(path, programs, seconds, folder)
    simulation = lw.Simulation(path, vehicles_per_hour=0, duration_s=seconds + 1)
    wrong, count = [], 0
    simulation.step(5)
    for second in range(seconds):
        for light, shown in simulation.lights.items():
            program, index = light.rsplit(":", 1)
            state = expected.get((second, program))
            if state is None:
                continue
            count += 1
            if SHOWN[state[int(index)]] != shown:
                wrong.append(f"light {light} after {second} s: {state[int(index)]} there, {shown} here")
        simulation.step(10)
    return wrong, count


def compare(program, path):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        lost, total = lost_connections(program, path, folder)
        wrong, count = wrong_states(path, folder)
    print(f"{path.name}: {total} connections, {len(lost)} lost; {count} states of lights, {len(wrong)} differ")
    for line in [*[f"{one} to {other} is lost" for one, other in lost], *wrong][:10]:
        print(f"    {line}")
    return not lost and not wrong


def main(program, *nets):
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(it) for it in nets]
        for seed, options in enumerate(GENERATED, 1):
            path = Path(folder) / f"{options[0].strip('-')}_{seed}.net.xml"
            command = [BIN / "netgenerate", *options, "--seed", str(seed), "-o", path]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            paths.append(path)
        return all([compare(program, it) for it in paths])


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
