#!/usr/bin/env bash
# Whether the recipes still hold: each patch applies to the tree as it is, is formatted, builds without a warning, and the
# lines of its head that begin with `$` succeed. The tree is what git has, with changes that are not committed yet; new
# files have to be added first (`git add`).
#
#     recipes/check.sh                  all recipes: each is applied alone, then all together are built and tried
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
    printf '%s\n\n%s\n' "$head" "$changes" > "$patch"
    exit
fi

names=("$@")
if [ $# -eq 0 ]; then
    mapfile -t names < <(basename -s .patch recipes/*.patch)
fi

fail() { echo "recipe $1: $2" >&2; exit 1; }
for name in "${names[@]}"; do
    [ -f "recipes/$name.patch" ] || fail "$name" "there is no recipes/$name.patch"
done

# A copy elsewhere: inside of a repository, git would leave out what it applies.
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
commit=$(git stash create)
git archive "${commit:-HEAD}" | tar -x -m -C "$copy"
# Crates of the copy have another version, so that they never pass for those of this tree in the common target folder.
sed -i '/^\[workspace.package\]/,/^\[/ s/^version = "\([^"]*\)"/version = "\1+recipes"/' "$copy/Cargo.toml"

export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target}
cd "$copy"
for name in "${names[@]}"; do
    git apply --check "$root/recipes/$name.patch" || fail "$name" "its patch does not apply"
done
for name in "${names[@]}"; do
    git apply "$root/recipes/$name.patch" || fail "$name" "its patch does not apply together with the others"
    cargo fmt --all --check || fail "$name" "it is not formatted"
done

cargo build --offline -p laneweave-cli 2>&1 | tee build.log || fail "${names[*]}" "they do not build"
if grep -q '^warning' build.log; then fail "${names[*]}" "a warning above"; fi
PATH=$CARGO_TARGET_DIR/debug:$PATH
for name in "${names[@]}"; do
    printf '\n== recipe %s (after %d s)\n' "$name" "$SECONDS"
    rm -rf out
    sed -n '/^diff --git /q; s/^ *\$ //p' "$root/recipes/$name.patch" > commands.sh
    bash -euxo pipefail commands.sh || fail "$name" "a command of its head fails"
done
echo "recipes hold: ${names[*]} (after $SECONDS s)"
