"""The third dimension as judge: a rigid indenter on an elastic or Kelvin half-space, with friction as a vector.

Shares nothing with the springs: tractions on a grid of cells (influence.py), the pressure and the tractions of a step
(normal.py, tangential.py), the march (march.py), friction of a case (friction.py), and, for comparison, springs that
take the very same steps (springs.py). `python -m validation.half_space case.toml --v-0 0.001` runs it on a case file.

Contacts that are known (benchmarks.py) and equations that are solved in another way (rings.py, last_stick.py) say how
far to trust it; the claims judge, uncoupled, coupled, end_of_stick, coupling_law and transverse_slip rest on it, with
tables that are kept (tables.py) and maps (pictures.py).
"""
