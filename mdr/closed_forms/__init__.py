"""Closed forms and quadratures of friction, which share no code with the march."""
