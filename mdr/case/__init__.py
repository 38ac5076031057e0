"""The case: motion, pull, and the sliding contact as one record; a case with other values."""
