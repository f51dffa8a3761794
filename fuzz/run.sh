#!/usr/bin/env bash
# Fuzzes one target for some time: fuzz/run.sh TARGET SECONDS [FOLDER WITH FURTHER SEEDS ...]
# What is new goes into fuzz/corpus/TARGET, from where the next run goes on; a finding into fuzz/artifacts/TARGET.
set -euo pipefail
if [ $# -lt 2 ]; then
    echo "usage: fuzz/run.sh TARGET SECONDS [FOLDER WITH FURTHER SEEDS ...]" >&2
    exit 2
fi
target=$1 seconds=$2
shift 2
fuzz=$(cd "$(dirname "$0")" && pwd)

# Coverage and sanitizers are open to a stable compiler, too, if it is told so.
export RUSTC_BOOTSTRAP=1
# Another thread's work would count for the wrong input.
export RAYON_NUM_THREADS=1

mkdir -p "$fuzz/corpus/$target"
cargo fuzz build --fuzz-dir "$fuzz" "$target"
# Largest input [B]; longest time for one [s]; most memory for all, and for one allocation [MB].
time cargo fuzz run --fuzz-dir "$fuzz" "$target" "$fuzz/corpus/$target" "$fuzz/seeds/$target" "$@" -- \
    -dict="$fuzz/dictionaries/$target.dict" -max_len=65536 \
    -timeout=10 -report_slow_units=2 -rss_limit_mb=2048 -malloc_limit_mb=256 \
    -max_total_time="$seconds" -print_final_stats=1
