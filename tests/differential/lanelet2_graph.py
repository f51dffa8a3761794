"""Routing graphs against those of the reference library.

    python lanelet2_graph.py LANEWEAVE MAP...

For every map the graph that `LANEWEAVE check MAP --graph` writes is compared with that of the package lanelet2 1.2.3 for
vehicles under German rules: following, previous and conflicting lanelets as sets, neighbours with and without a lane change,
in both directions of two-way lanelets, and speed limits to 0.02 m/s. Ends with 1 if anything differs.
"""

import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

from lanelet2 import io, projection, routing, traffic_rules

SPEED_TOLERANCE_MPS = 0.02
KMH_PER_MPS = 3.6
# Maps with metric coordinates, which the reference does not read, beside the same map in degrees.
METRIC = ".osm_xy"


def ids(lanelets):
    return [str(it) for it in sorted({lanelet.id for lanelet in lanelets})]


def id_of(lanelet):
    return None if lanelet is None else str(lanelet.id)


def links(graph, lanelet):
    """What lies around a lanelet in the direction in which it is given."""
    return {
        "following": ids(graph.following(lanelet)),
        "previous": ids(graph.previous(lanelet)),
        "left": id_of(graph.left(lanelet)),
        "right": id_of(graph.right(lanelet)),
        "adjacent_left": id_of(graph.adjacentLeft(lanelet)),
        "adjacent_right": id_of(graph.adjacentRight(lanelet)),
    }


def reference(path):
    """The graph of the reference library, in the form of ours."""
    if path.suffix == METRIC:
        path = path.with_suffix(".osm")
    first = xml.etree.ElementTree.parse(path).getroot().find("node")
    origin = io.Origin(*(round(float(first.get(key)), 1) for key in ("lat", "lon")))
    lanelet_map, _ = io.loadRobust(str(path), projection.UtmProjector(origin))
    rules = traffic_rules.create(traffic_rules.Locations.Germany, traffic_rules.Participants.Vehicle)
    graph = routing.RoutingGraph(lanelet_map, rules)
    found = {}
    for lanelet in lanelet_map.laneletLayer:
        if rules.canPass(lanelet):
            entry = links(graph, lanelet)
            entry["conflicting"] = ids(graph.conflicting(lanelet))
            entry["speed_limit_mps"] = rules.speedLimit(lanelet).speedLimit / KMH_PER_MPS
            if rules.canPass(lanelet.invert()):
                entry["backward"] = links(graph, lanelet.invert())
            found[str(lanelet.id)] = entry
    return found


def ours(program, path):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "graph.json"
        subprocess.run([program, "check", path, "--graph", file], check=True, stdout=subprocess.DEVNULL)
        return json.loads(file.read_text())


def differences(expected, found):
    for key in sorted(expected.keys() ^ found.keys()):
        yield f"lanelet {key} is in one graph only"
    for key in sorted(expected.keys() & found.keys()):
        theirs, own = dict(expected[key]), dict(found[key])
        own.pop("length_m")
        apart = abs(theirs.pop("speed_limit_mps") - own.pop("speed_limit_mps"))
        if apart > SPEED_TOLERANCE_MPS:
            yield f"lanelet {key}: speed limits are {apart:.3f} m/s apart"
        for name in sorted(theirs.keys() | own.keys()):
            if theirs.get(name) != own.get(name):
                yield f"lanelet {key}: {name} is {theirs.get(name)} there, {own.get(name)} here"


def main(program, *maps):
    failed = False
    for path in map(Path, maps):
        expected, found = reference(path), ours(program, path)
        wrong = list(differences(expected, found))
        failed |= bool(wrong)
        conflicts = sum(len(entry["conflicting"]) for entry in found.values())
        following = sum(len(entry["following"]) for entry in found.values())
        print(f"{path.name}: {len(found)} lanelets, {following} following, {conflicts} conflicting, {len(wrong)} differences")
        for line in wrong[:10]:
            print(f"    {line}")
    sys.exit(failed)


if __name__ == "__main__":
    main(*sys.argv[1:])
