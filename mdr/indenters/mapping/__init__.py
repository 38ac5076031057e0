"""Numerics of the mapping from three dimensions to one, f(r) to g(x), and back."""
