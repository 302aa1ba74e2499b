"""Forces, mobilities, flows and integrators on arrays of bead positions; no module knows a scene."""
