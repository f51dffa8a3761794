//! Examples at the end of the help texts. A test runs all of them in a folder with the built-in maps and scenarios;
//! the examples of one text may build on each other.

pub(super) const LANEWEAVE: &str = "\
Examples:
  # The demo
  laneweave
  # A bare map, in heavy traffic
  laneweave run maps/on_ramp.osm --demand 4000
  # A scenario to edit, then run
  laneweave scenario new maps/on_ramp.osm --out mine.toml
  laneweave run mine.toml";

pub(super) const RUN: &str = "Options override the scenario. The results folder then contains summary.json, tables of lane changes and trajectories, and figures.

Examples:
  # Half an hour of heavy traffic on a motorway with an on-ramp
  laneweave run maps/on_ramp.osm --demand 4000 --duration 1800
  # A scenario with another seed, its results elsewhere, its tables as CSV
  laneweave run scenarios/demo.toml --seed 2 --out second --format csv
  # One egoist to three altruists, after four minutes of warm-up; only the summary, as JSON
  laneweave run maps/ramps.osm --style egoistic=1 --style altruistic=3 --warmup 240 --json";

pub(super) const VIEW: &str =
    "The page is served on this machine only. Its address carries a token: whoever knows it can do
what you can do there.

Examples:
  # The demo
  laneweave view
  # A map of your own; scenarios with what was done by hand are saved in mine/
  laneweave view maps/ramps.osm --save mine
  # A run that has ended, and beside it its twin: from one minute on, speed has more weight
  laneweave run maps/ramps.osm --duration 120
  laneweave view out --at 60 --set style.speed.weight=2";

pub(super) const RENDER: &str =
    "Pictures are PNG files, numbered from 0 on. Tools such as ffmpeg make a film of them.

Examples:
  laneweave run maps/ramps.osm --duration 120
  # Two pictures a second of the whole map
  laneweave render out --until 10
  # A vehicle, ten times a second
  laneweave render out --camera vehicle:20 --every 0.1 --from 40 --until 42 --out followed";

pub(super) const EXPLAIN: &str =
    "The run is repeated; no log is needed. Vehicle ids and times are those of the tables.

Examples:
  laneweave run maps/ramps.osm --duration 120
  # For what reasons drivers changed lanes, and why they did not
  laneweave explain out --summary
  # One trip, and what would have changed each decision
  laneweave explain out --vehicle 4 --flip
  # All inputs of one decision
  laneweave explain out --vehicle 4 --time 60";

pub(super) const OBSERVE: &str =
    "The run is repeated. Speeds and headings are those of a tracker: a straight line through the noisy
positions half a second before and after. Coordinates are those of the map.

Examples:
  laneweave run maps/ramps.osm --duration 120
  # 25 frames a second, errors of 10 cm
  laneweave observe out
  # 300 m of the road, and what it shows of lane changes
  laneweave observe out --above 900,0 --view 300 --to drone.csv
  laneweave check drone.csv --map maps/ramps.osm";

pub(super) const REPLAY: &str =
    "Coordinates of the recording are those of the map. The results folder contains the tables of a run,
and replay.html: how far the drivers part from what was recorded of them, their collisions by fault,
and how likely the recording is under many rollouts, beside other lane-change models.

Examples:
  laneweave run maps/ramps.osm --duration 120
  laneweave observe out
  # As it was recorded
  laneweave replay observed.csv --map maps/ramps.osm
  # Three in ten react
  laneweave replay observed.csv --map maps/ramps.osm --reactive 0.3 --rollouts 2";

pub(super) const FIT: &str =
    "Recorded drivers are seen as simulated ones see: what each knew in every second, and when it began a
change. The results are styles that the command run takes, fit.html and fit.json.

Examples:
  laneweave run maps/ramps.osm --duration 120
  laneweave observe out
  # What can the recording tell?
  laneweave fit observed.csv --map maps/ramps.osm --plan
  # The styles are written into fit/
  laneweave fit observed.csv --map maps/ramps.osm --draws 50";

pub(super) const RECORDING: &str = "Examples:
  laneweave recording join --help";

pub(super) const RECORDING_JOIN: &str =
    "Vehicles with the same id go on from one recording to the next, if they are where they would be.
Frames are counted on from the first recording; a window whose frames begin at 0 again is moved to
its place in time. The command check joins what it is given, too.

Examples:
  laneweave run maps/ramps.osm --duration 60
  laneweave observe out --until 40 --to a.csv
  laneweave observe out --from 40 --to b.csv
  laneweave recording join a.csv b.csv --to whole.csv";

pub(super) const BRANCH: &str =
    "Both runs use common random numbers, so every difference between them is caused by the setting.

Examples:
  laneweave run maps/ramps.osm --duration 120
  # From one minute on, speed has more weight for all drivers
  laneweave branch out --at 60 --set style.speed.weight=2
  # Aggressive drivers keep a larger gap at standstill
  laneweave branch out --at 60 --set aggressive.follow.jam_gap=3 --into further";

pub(super) const COMPARE: &str = "Drivers, their desired speeds and all random numbers are the same for each model; only the lane-change decision differs. The results are means over the seeds, with 95 % intervals (Student's t).

Examples:
  # The paper's model, MOBIL, LMRS and two null-model controls on a motorway and in a town
  laneweave compare maps/motorway_3_lanes.osm maps/town.osm --seeds 3 --duration 120
  # Two ways to follow a route
  laneweave compare maps/ramps.osm --model mobil --model mobil-lanes --seeds 3 --duration 120";

pub(super) const SWEEP: &str =
    "A plan names a scenario or a map, and which keys of it have which values:

  scenario = \"maps/ramps.osm\"
  seeds = 10                                      # or a list of them
  [grid]                                          # all combinations
  demand.vehicles_per_hour = [2000, 3000]
  model = [\"mcdm\", \"mobil\"]
  [latin_hypercube]                               # points spread evenly over ranges
  samples = 20
  keys.demand.trucks = [0, 0.3]
  [[list]]                                        # rows of values
  styles = { aggressive = 1 }

A sweep that was ended goes on with the same command. Then the folder has runs.parquet, a row for each run, and variants.parquet, means with 95 % intervals.

Examples:
  laneweave sweep scenarios/sweep.toml
  # Three parts, on as many machines that share the folder
  laneweave sweep scenarios/sweep.toml --out shared --shard 1/3
  laneweave sweep scenarios/sweep.toml --out shared --shard 2/3
  laneweave sweep scenarios/sweep.toml --out shared --shard 3/3";

pub(super) const REPRODUCE: &str = "The same command gives the same files, byte for byte, on any machine. Each experiment writes its words (.md), its data (.csv) and its figures (.svg).

Examples:
  # A try of everything
  laneweave reproduce --quick
  # Are the drivers plausible? With ten seeds
  laneweave reproduce plausibility --seeds 10
  # On a motorway, is the rate of lane changes like MOBIL's?
  laneweave reproduce C1 --out claims";

pub(super) const CHECK: &str = "Problems of a map are not errors of the command: its exit code is 0.

Examples:
  # The contents of a map, its problems, and a picture of it
  laneweave check maps/ramps.osm --svg ramps.svg
  # The routing graph, and the report as JSON
  laneweave check maps/town.osm --graph graph.json --json
  # With the speed limits of the USA where the map gives none
  laneweave check maps/on_ramp.osm --law usa";

pub(super) const ROUTES: &str =
    "Routes over the same roads that differ only in their lanes count as one: the fastest is listed.

Examples:
  # From the motorway in the west to the main street in the south
  laneweave routes maps/town.osm 97 241
  # The three fastest routes only, as JSON
  laneweave routes maps/ramps.osm 1 90 --most 3 --json";

pub(super) const SCENARIO: &str = "\
Examples:
  laneweave scenario new maps/on_ramp.osm --out mine.toml
  laneweave run mine.toml";

pub(super) const SCENARIO_NEW: &str = "The file contains every key with its meaning (keys with their default value are commented out), and the entrances, exits and traffic lights of the map. Without edits it runs like the bare map.

Examples:
  # Writes ramps.toml
  laneweave scenario new maps/ramps.osm
  laneweave run ramps.toml
  # Another name; an existing file is replaced
  laneweave scenario new maps/town.osm --out mine.toml --force";

pub(super) const GENERATE: &str = "\
Examples:
  laneweave generate motorway --lanes 3 --on-ramp-at 2500 road.osm
  laneweave generate grid --rows 3 --columns 4 grid.osm
  laneweave run grid.osm";

pub(super) const MOTORWAY: &str = "Examples:
  # Three lanes, an on-ramp, and a lane that ends after it
  laneweave generate motorway --length 8000 --on-ramp-at 3000 --lane-drop-at 6000 road.osm
  # Two lanes with an off-ramp; traffic drives on the left
  laneweave generate motorway --lanes 2 --off-ramp-at 2500 --driving-side left road.osm";

pub(super) const WEAVING: &str = "Examples:
  # A weaving section of 300 m
  laneweave generate weaving --length 300 weaving.osm
  laneweave run weaving.osm --demand 4500";

pub(super) const GRID: &str = "Examples:
  # Three by four junctions with traffic lights
  laneweave generate grid --rows 3 --columns 4 grid.osm
  # One junction at which the street that runs east and west has priority
  laneweave generate grid --rows 1 --columns 1 --lanes 1 --control priority crossing.osm";

pub(super) const ARTERIAL: &str = "\
Examples:
  laneweave generate arterial --junctions 5 main-street.osm
  laneweave generate arterial --junctions 3 --block-length 200 --speed-limit 60 main-street.osm";

pub(super) const ROUNDABOUT: &str = "\
Examples:
  laneweave generate roundabout ring.osm
  laneweave generate roundabout --arms 5 --lanes 2 --radius 32 ring.osm
  laneweave generate roundabout --driving-side left ring-left.osm";

pub(super) const APPROACH: &str = "\
Examples:
  laneweave generate approach approach.osm
  laneweave generate approach --driving-side left approach-left.osm";

pub(super) const TOWN: &str = "\
Examples:
  laneweave generate town town.osm
  laneweave generate town --driving-side left town-left.osm
  # Seven streets in each direction, without a motorway
  laneweave generate town --size 7 large.osm";

pub(super) const RANDOM: &str = "\
Examples:
  laneweave generate random --seed 17 random.osm
  laneweave run random.osm --demand 600 --duration 300";

pub(super) const STYLES: &str = "\
Examples:
  laneweave styles list
  laneweave styles new hasty --from aggressive
  laneweave run maps/on_ramp.osm --style hasty.toml=1 --style conservative=3";

pub(super) const STYLES_LIST: &str = "\
Examples:
  laneweave styles list
  # One of them in full
  laneweave styles show altruistic";

pub(super) const STYLES_SHOW: &str = "\
Examples:
  laneweave styles show aggressive
  laneweave styles show constant-hazard";

pub(super) const STYLES_NEW: &str = "Examples:
  # Writes hasty.toml, every key with its meaning and source
  laneweave styles new hasty --from aggressive
  laneweave run maps/on_ramp.osm --style hasty.toml=1 --style conservative=3
  # Start from another file
  laneweave styles new hastier --from hasty.toml --file even-more.toml";

pub(super) const SCHEMA: &str = "An editor that supports TOML schemas completes keys and shows their meaning if the first line of a scenario is #:schema scenario.schema.json

Examples:
  laneweave schema > scenario.schema.json";

pub(super) const COMPLETIONS: &str = "\
Examples:
  # Bash
  laneweave completions bash > ~/.local/share/bash-completion/completions/laneweave
  # Zsh, in a folder of $fpath
  laneweave completions zsh > ~/.zfunc/_laneweave
  # Fish
  laneweave completions fish > ~/.config/fish/completions/laneweave.fish";

pub(super) const MAN: &str = "\
Examples:
  # Then: man laneweave-run
  laneweave man ~/.local/share/man/man1
  # Without installing them: man -l pages/laneweave-run.1
  laneweave man pages";
