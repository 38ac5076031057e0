"""A damaged file holds a sound record or is refused by name and fault."""

import warnings

import damage
import pytest

EACH = 60  #: files of a kind


@pytest.mark.parametrize("kind", damage.READERS)
def test_a_damaged_file_holds_a_sound_record_or_says_what_is_wrong(kind, tmp_path):
    read = 0
    for seed in range(EACH):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            _, _, record, words = damage.one(seed, tmp_path, [kind])
            assert (record is None) == bool(words)
            assert damage.is_sound(record), f"seed {seed}"
            read += record is not None
    assert 0 < read < EACH  # neither all nor nothing gets through


@pytest.mark.parametrize("seed", range(12))
def test_the_command_line_ends_with_a_status_and_words_on_any_file(seed, tmp_path):
    _, path, record, _ = damage.one(seed, tmp_path, ["case"])
    assert damage.command("velocity", path) in ((2,) if record is None else (0, 1))


@pytest.mark.parametrize("kind", damage.READERS)
def test_whole_files_are_read(kind, tmp_path):
    for name, data in damage.files()[kind]:
        (tmp_path / name).write_bytes(data)
        assert damage.read(kind, tmp_path / name)[0] is not None
