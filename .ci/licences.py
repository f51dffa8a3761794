#!/usr/bin/env python3
"""Prints the licences of all libraries that a package of this workspace is built with: `licences.py PACKAGE`.

The texts are those that stand in the sources of the libraries, each once.
"""

import json
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

NAMES = ("license", "licence", "copying", "copyright", "notice", "unlicense")


def built_with(package: str) -> set[str]:
    """The libraries, as `NAME VERSION`."""
    command = ["cargo", "tree", "--locked", "-p", package, "-e", "normal", "--prefix", "none", "--format", "{p}"]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return {" ".join(it.split()[:2]).replace(" v", " ") for it in lines if it}


def main(package: str) -> None:
    command = ["cargo", "metadata", "--locked", "--format-version", "1"]
    packages = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["packages"]
    wanted = built_with(package)
    users: dict[str, list[str]] = defaultdict(list)
    without: list[str] = []
    for it in packages:
        name = f"{it['name']} {it['version']}"
        if it["source"] is None or name not in wanted:
            continue
        folder = Path(it["manifest_path"]).parent
        files = sorted(file for file in folder.iterdir() if file.is_file() and file.name.lower().startswith(NAMES))
        told = f"{name} ({it['license'] or 'see its licence'})"
        if not files:
            without.append(told)
        for file in files:
            users[file.read_text(encoding="utf-8", errors="replace").strip()].append(told)
    print("laneweave is built with these libraries. Their licences follow, each after those that have it.\n")
    if without:
        print("Without a text of their own:\n  " + "\n  ".join(sorted(set(without))) + "\n")
    for text, names in sorted(users.items(), key=lambda it: sorted(it[1])):
        print("=" * 80 + "\n" + "\n".join(sorted(set(names))) + "\n" + "-" * 80 + "\n" + text + "\n")


main(*sys.argv[1:])
