"""How far to trust contact in three dimensions (mdr/half_space), and what it says of the springs.

Contacts that are known (benchmarks.py) and equations that are solved in another way (rings.py, last_stick.py, and, for
a shear strength, growing.py) test it; springs.py takes the very same steps with springs, for comparison. Friction that
falls, which it refuses, is solved by weakening.py. The claims judge, uncoupled, coupled, end_of_stick, coupling_law and
transverse_slip rest on it, with tables that are kept (tables.py) and maps (pictures.py).
`python -m validation.half_space case.toml --v-0 0.001` runs it on a case file.
"""
