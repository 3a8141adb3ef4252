//! The lab in a real browser: the tests in `tests/` start the `thinglab` command and headless
//! Chromium, and do what people do. `cargo verify` builds both and names them in the environment
//! (`THINGLAB`, `CHROMIUM`).
