//! Settling grains: the drag laws and what follows from them for a grain alone and for a suspension.

mod drag_curves;
