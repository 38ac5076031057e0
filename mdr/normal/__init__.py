"""The normal problem, in which friction has no part: springs, their forces, the depth under a load."""
