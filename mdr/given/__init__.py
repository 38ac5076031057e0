"""From what users give to a case: settings of a rig, a case file, another value at a path. All that must be solved."""
