"""The third dimension as judge: a rigid indenter on an elastic or Kelvin half-space, with friction as a vector.

Shares nothing with the springs: tractions on a grid of cells (influence.py), the pressure and the tractions of a step
(normal.py, tangential.py), the march (march.py), friction of a case (friction.py), and, for comparison, springs that
take the very same steps (springs.py). `python -m validation.half_space case.toml --v-0 0.001` runs it on a case file.
"""
