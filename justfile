# The project's chores. `just` lists them; each is a plain command that can be typed as well.

# the main job: the report of Loop's scheme
analyze scheme="loop" valences="3..12":
    cargo run --release -- analyze {{scheme}} --valence {{valences}}

# every test
test:
    cargo test --release

# everything that must hold before a change lands
check:
    .ci/run

# make the committed reports again
atlas:
    cargo run --release --example atlas

# the speed figures of the documentation
bench:
    cargo bench

# licences and advisories of the dependencies (cargo install cargo-deny)
deny:
    cargo deny check

# look for input that the readers can't take (cargo install cargo-fuzz, a nightly toolchain)
fuzz target="scheme" seconds="60":
    cargo +nightly fuzz run {{target}} -- -max_total_time={{seconds}}
