"""The motion in scaled form: body and springs over a step, a period, and many periods."""
