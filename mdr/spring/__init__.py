"""One spring over one step of time: its material, contact and friction, exact for a motion that is a parabola."""
