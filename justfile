# Shortcuts for what is done often; each is one command that can be typed as well.

# Ten minutes of our own motorway, into out/
demo:
    cargo run --release

# All tests
test:
    cargo test --workspace

# All checks, as for a release
ci:
    .ci/run

# How fast the step is
bench:
    cargo run --release -p laneweave-bench

# The book, into docs/book
book:
    mdbook build docs
