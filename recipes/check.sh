#!/usr/bin/env bash
# Whether the recipes still hold. Each patch applies to a clean copy of the tree, is formatted, builds without a warning, and
# the lines of its head that begin with `$` succeed, with `--each` also those that begin with `$$`, which take long. The tree
# is what git has, with changes that are not committed yet; new files have to be added first (`git add`).
#
#     recipes/check.sh                  all recipes: each applies alone, and together they are built and tried once
#     recipes/check.sh --each           all recipes: each is built and tried alone, which takes about ten minutes
#     recipes/check.sh incentive …      these recipes
#     recipes/check.sh --renew NAME     writes NAME.patch anew from the changes of the working tree, and keeps its head
#
# A patch that does not apply any more: on a clean tree `git apply --3way recipes/NAME.patch`, mend what conflicts,
# `git reset -q`, `recipes/check.sh --renew NAME`, and take the changes back (`git stash -u -- crates docs`).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"

if [ "${1:-}" = --renew ]; then
    patch=recipes/$2.patch
    head=$(sed '/^diff --git /Q' "$patch")
    git add --intent-to-add -- . ':!recipes'
    changes=$(git diff -- . ':!recipes')
    git reset -q
    printf '%s\n\n%s\n' "$head" "$changes" > "$patch"
    exit
fi

each= command='\$'
if [ "${1:-}" = --each ]; then each=yes command='\$\$\?'; shift; fi
names=("$@")
if [ $# -eq 0 ]; then
    mapfile -t names < <(basename -s .patch recipes/*.patch)
fi

fail() { echo "recipe $1: $2" >&2; exit 1; }
for name in "${names[@]}"; do
    [ -f "recipes/$name.patch" ] || fail "$name" "there is no recipes/$name.patch"
done

# The copy is a repository of its own. So it is made clean again without touching files that did not change, and only
# what a recipe changes is built anew.
copy=$(mktemp -d)
programs=$(mktemp -d)
trap 'rm -rf "$copy" "$programs"' EXIT
commit=$(git stash create)
git archive "${commit:-HEAD}" | tar -x -m -C "$copy"
# What is compiled is shared with this tree, and its programs are not: its tests may run at the same time. Crates of the
# copy have another version, so that they never pass for those of this tree.
sed -i '/^\[workspace.package\]/,/^\[/ s/^version = "\([^"]*\)"/version = "\1+recipes"/' "$copy/Cargo.toml"

export CARGO_BUILD_BUILD_DIR=${CARGO_TARGET_DIR:-$root/target} CARGO_TARGET_DIR=$programs
PATH=$programs/debug:$PATH
cd "$copy"
cargo metadata --offline --format-version 1 >/dev/null
git init --quiet
git add --force --all
git -c user.name=recipes -c user.email=recipes@localhost commit --quiet --message "as it is"

# Applies some recipes to the clean copy, builds it, and tries the commands of their heads.
try() {
    local name
    printf '\n== recipes: %s (after %d s)\n' "$*" "$SECONDS"
    for name; do git apply "$root/recipes/$name.patch" || fail "$name" "its patch does not apply"; done
    cargo fmt --all --check || fail "$*" "it is not formatted"
    cargo build --locked --offline -p laneweave-cli 2>&1 | tee build.log || fail "$*" "it does not build"
    ! grep -q '^warning' build.log || fail "$*" "a warning above"
    for name; do
        bash -euxo pipefail <(sed -n "/^diff --git /q; s/^ *$command //p" "$root/recipes/$name.patch") ||
            fail "$name" "a command of its head fails"
    done
    git reset --quiet --hard
    git clean --quiet --force -d -x
}

if [ "$each" ]; then
    for name in "${names[@]}"; do try "$name"; done
else
    for name in "${names[@]}"; do
        git apply --check "$root/recipes/$name.patch" || fail "$name" "its patch does not apply"
    done
    try "${names[@]}"
fi
echo "recipes hold: ${names[*]} (after $SECONDS s)"
