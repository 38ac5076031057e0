"""The contact as a force element with memory: a state in, a state out; and friction under a recorded motion."""
