//! Searches, regions and diagnosis.

mod bootstrap;
mod box_least_squares;
mod coverage;
mod descent;
mod diagnosis;
mod emulator;
mod explore;
mod identifiability;
mod loss;
mod posterior;
mod profile;
mod region;
mod scatter;
mod scores;
mod search;
mod sensitivity;
mod serial_correlation;
mod solve;
mod straight_line;
