//! Tests that take minutes: `bash tests/long.sh`.

mod calibrate;
mod interrupted;
mod restart;
