"""Our Parquet tables as pandas and DuckDB read them, against the book and the CSV of the same run.

    python tables.py LANEWEAVE TABLES.md MAP...

Every table must have the columns that the book documents, of the same types in both readers, the same rows as the CSV, and
where the summary counts them as many. Needs pandas, pyarrow and duckdb. Ends with 1 if anything differs.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import duckdb
import pandas
import pyarrow.parquet

TABLES = ["trajectories", "lane_changes", "incidents", "commands", "trips", "lanelets", "flows"]
RUN = ["--duration", "150", "--warmup", "20", "--flows", "60", "--quiet"]
NOTES = ["laneweave.command", "laneweave.scenario", "laneweave.seed", "laneweave.version"]
SQL = {"double": "DOUBLE", "int64": "BIGINT", "string": "VARCHAR"}


def documented(book):
    """The columns of each table in the book."""
    found = {}
    for part in re.split(r"^## (?=`)", Path(book).read_text().split("## Files")[0], flags=re.MULTILINE)[1:]:
        rows = [line.split("|")[1] for line in part.splitlines() if line.startswith("| `")]
        found[part.split("`")[1]] = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    return found


def same(ours, theirs):
    """Whether two columns hold the same, missing values included."""
    if len(ours) != len(theirs) or not (ours.isna().to_numpy() == theirs.isna().to_numpy()).all():
        return False
    ours, theirs = ours.dropna().to_numpy(), theirs.dropna().to_numpy()
    return bool((ours == theirs).all())


def differences(name, folders, columns, summary):
    path = folders["parquet"] / f"{name}.parquet"
    schema = pyarrow.parquet.read_schema(path)
    frame = pandas.read_parquet(path)
    yield from (f"no note {key}" for key in NOTES if key.encode() not in (schema.metadata or {}))
    if (schema.metadata or {}).get(b"laneweave.seed") != str(summary["seed"]).encode():
        yield "the seed is not noted"
    if list(frame.columns) != columns:
        yield f"columns {list(frame.columns)}, in the book {columns}"
    sql = duckdb.sql(f"SELECT * FROM read_parquet('{path}')")
    types = {field.name: SQL[str(field.type)] for field in schema}
    if dict(zip(sql.columns, map(str, sql.types))) != types:
        yield f"types {dict(zip(sql.columns, sql.types))}, not {types}"
    other = sql.df()
    numbers = {field.name for field in schema if str(field.type) != "string"}
    texts = {column: str for column in frame.columns if column not in numbers}
    csv = pandas.read_csv(folders["csv"] / f"{name}.csv", dtype=texts, keep_default_na=False, na_values=[""])
    for column in frame.columns:
        if not same(frame[column], other[column]):
            yield f"{column} is not the same in DuckDB"
        if not same(frame[column], csv[column]):
            yield f"{column} is not the same in the CSV"
    if name == "trips":
        if [len(frame), frame.completed_s.notna().sum()] != [summary["entered"], summary["completed"]]:
            yield f"{len(frame)} trips for {summary['entered']} vehicles"
        mean = frame.duration_s.mean()
        if abs(mean - summary["mean_trip_duration_s"]) > 1e-9 * mean:
            yield f"a mean duration of {mean} s"
    if name == "incidents" and len(frame) != summary["collisions"] + summary["overlaps"]:
        yield f"{len(frame)} rows for {summary['collisions']} collisions and {summary['overlaps']} overlaps"
    if name == "lanelets":
        driven = (frame.flow_veh_h * frame.length_m).sum() / 3600 * summary["duration_s"] / 1000
        if not 0.99 * summary["veh_km"] < driven <= summary["veh_km"] * 1.0001:
            yield f"{driven} veh-km of {summary['veh_km']}"
    if name == "trajectories" and frame.time_s.nunique() != round(summary["duration_s"]):
        yield f"{frame.time_s.nunique()} instants"


def compare(program, book, path):
    wrong, rows = [], {}
    with tempfile.TemporaryDirectory() as temporary:
        folders = {it: Path(temporary) / it for it in ("parquet", "csv")}
        for form, folder in folders.items():
            subprocess.run([program, "run", path, *RUN, "--format", form, "--out", folder], check=True)
        summary = json.loads((folders["parquet"] / "summary.json").read_text())
        columns = documented(book)
        found = sorted(it.stem for it in folders["parquet"].glob("*.parquet"))
        if found != sorted(TABLES) or sorted(columns) != found:
            wrong.append(f"tables {found}, in the book {sorted(columns)}")
        for name in TABLES:
            wrong += [f"{name}: {it}" for it in differences(name, folders, columns.get(name), summary)]
            rows[name] = pyarrow.parquet.read_metadata(folders["parquet"] / f"{name}.parquet").num_rows
    counts = ", ".join(f"{count} {name}" for name, count in rows.items())
    print(f"{Path(path).name}: {counts}; {len(wrong)} differences")
    for line in wrong[:10]:
        print(f"    {line[:300]}")
    return not wrong


if __name__ == "__main__":
    program, book, *maps = sys.argv[1:]
    sys.exit(not all([compare(program, book, path) for path in maps]))
