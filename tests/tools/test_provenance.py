"""What made a file, as files keep it."""

from importlib.metadata import version

from mdr.tools.provenance import commented, figure_metadata, version_of, versions


def test_versions_name_all_that_can_move_a_digit():
    told = versions()
    assert told.startswith(f"mdr {version('mdr-friction')}, ")
    for name in ("numpy", "scipy", "numba", "matplotlib"):
        assert f"{name} {version(name)}" in told
    assert "Python 3." in told


def test_what_is_not_installed_says_so():
    assert version_of("no-such-distribution") == "(not installed)"


def test_a_head_of_comments_leaves_no_line_out():
    assert commented("one\ntwo", "", "three") == "# one\n# two\n#\n# three\n"


def test_figures_carry_no_date():
    assert figure_metadata("svg", "mdr curve")["Date"] is None
    assert set(figure_metadata("png", "mdr curve")) == {"Software", "Description"}
