"""Tools without physics: checks, array records, messages, compilation, memoisation, progress, atomic writes."""
