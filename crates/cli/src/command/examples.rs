//! Examples at the end of the help texts. A test runs every one of them in a folder with the maps and scenarios that
//! come with the program; those of one text may build on each other.

pub(super) const LANEWEAVE: &str = "\
Examples:
  # The demo
  laneweave
  # A bare map, in heavy traffic
  laneweave run maps/on_ramp.osm --demand 4000
  # A scenario to edit, then run
  laneweave scenario new maps/on_ramp.osm --out mine.toml
  laneweave run mine.toml";

pub(super) const RUN: &str = "\
Options go before what the scenario says. The folder of the results then holds summary.json, tables of lane changes \
and trajectories, and figures.

Examples:
  # Half an hour of heavy traffic on a motorway with an on-ramp
  laneweave run maps/on_ramp.osm --demand 4000 --duration 1800
  # A scenario with another seed, its results elsewhere, its tables as CSV
  laneweave run scenarios/demo.toml --seed 2 --out second --format csv
  # One egoist to three altruists, after four minutes of warm-up; nothing but the summary, as JSON
  laneweave run maps/ramps.osm --style egoistic=1 --style altruistic=3 --warmup 240 --json";

pub(super) const EXPLAIN: &str = "\
Nothing is logged for it: the run is repeated. Vehicles are named by their ids in the tables, times as there.

Examples:
  laneweave run maps/ramps.osm --duration 120
  # For what drivers changed lanes, and why they did not
  laneweave explain out --summary
  # One trip, and what would have turned each decision
  laneweave explain out --vehicle 4 --flip
  # All that went into one decision
  laneweave explain out --vehicle 4 --time 60";

pub(super) const BRANCH: &str = "\
All draws are equal, so every difference between the two is caused by what is set.

Examples:
  laneweave run maps/ramps.osm --duration 120
  # All drivers gain more from speed, from one minute on
  laneweave branch out --at 60 --set style.speed.weight=2
  # The aggressive ones stop further behind others
  laneweave branch out --at 60 --set aggressive.follow.jam_gap=3 --into further";

pub(super) const COMPARE: &str = "\
Drivers, their wishes and all draws are the same for each model; what differs is how they decide on lane changes. The means \
are those over the seeds, with 95 % intervals of Student's t.

Examples:
  # The paper's model, MOBIL, LMRS and two controls on a motorway and in a town
  laneweave compare maps/motorway_3_lanes.osm maps/town.osm --seeds 3 --duration 120
  # Two ways to follow a route
  laneweave compare maps/ramps.osm --model mobil --model mobil-lanes --seeds 3 --duration 120";

pub(super) const CHECK: &str = "\
Problems of a map are no mistakes of the command: it ends with 0.

Examples:
  # What a map holds, what is wrong with it, and a picture of it
  laneweave check maps/ramps.osm --svg ramps.svg
  # The routing graph, and the report for programs
  laneweave check maps/town.osm --graph graph.json --json
  # With the limits of the USA where the map gives none
  laneweave check maps/on_ramp.osm --law usa";

pub(super) const ROUTES: &str = "\
Of ways over the same roads, which differ in their lanes only, the fastest is named.

Examples:
  # From the motorway in the west to the main street in the south
  laneweave routes maps/town.osm 97 241
  # The three fastest ways only, for programs
  laneweave routes maps/ramps.osm 1 90 --most 3 --json";

pub(super) const SCENARIO: &str = "\
Examples:
  laneweave scenario new maps/on_ramp.osm --out mine.toml
  laneweave run mine.toml";

pub(super) const SCENARIO_NEW: &str = "\
The file holds every key with its meaning, those that are the default behind a #, and of the map its entrances, exits \
and lights. As it is, it runs like the bare map.

Examples:
  # Writes ramps.toml
  laneweave scenario new maps/ramps.osm
  laneweave run ramps.toml
  # Another name; a file of that name is replaced
  laneweave scenario new maps/town.osm --out mine.toml --force";

pub(super) const GENERATE: &str = "\
Examples:
  laneweave generate motorway --lanes 3 --on-ramp-at 2500 road.osm
  laneweave generate grid --rows 3 --columns 4 grid.osm
  laneweave run grid.osm";

pub(super) const MOTORWAY: &str = "\
Examples:
  # Three lanes, an on-ramp, and a lane that ends after it
  laneweave generate motorway --length 8000 --on-ramp-at 3000 --lane-drop-at 6000 road.osm
  # Two lanes with an exit, driven on the left
  laneweave generate motorway --lanes 2 --off-ramp-at 2500 --driving-side left road.osm";

pub(super) const WEAVING: &str = "\
Examples:
  # 300 m to change places
  laneweave generate weaving --length 300 weaving.osm
  laneweave run weaving.osm --demand 4500";

pub(super) const GRID: &str = "\
Examples:
  # Three by four junctions with lights
  laneweave generate grid --rows 3 --columns 4 grid.osm
  # One junction at which the street that runs east and west goes first
  laneweave generate grid --rows 1 --columns 1 --lanes 1 --control priority crossing.osm";

pub(super) const ARTERIAL: &str = "\
Examples:
  laneweave generate arterial --junctions 5 main-street.osm
  laneweave generate arterial --junctions 3 --block-length 200 --speed-limit 60 main-street.osm";

pub(super) const ROUNDABOUT: &str = "\
Examples:
  laneweave generate roundabout ring.osm
  laneweave generate roundabout --driving-side left ring-left.osm";

pub(super) const APPROACH: &str = "\
Examples:
  laneweave generate approach approach.osm
  laneweave generate approach --driving-side left approach-left.osm";

pub(super) const TOWN: &str = "\
Examples:
  laneweave generate town town.osm
  laneweave generate town --driving-side left town-left.osm";

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

pub(super) const STYLES_NEW: &str = "\
Examples:
  # Writes hasty.toml, every key with its meaning and source
  laneweave styles new hasty --from aggressive
  laneweave run maps/on_ramp.osm --style hasty.toml=1 --style conservative=3
  # Like another file
  laneweave styles new hastier --from hasty.toml --file even-more.toml";

pub(super) const SCHEMA: &str = "\
An editor that knows TOML schemas completes keys and shows their meaning where the first line of a scenario reads \
#:schema scenario.schema.json

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
