"""The commands of the command line, one file each; `mdr/__main__.py` puts them together."""
