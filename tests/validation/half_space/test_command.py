"""`python -m validation.half_space`: what it tells machines."""

import json
from types import SimpleNamespace

import mdr
from validation.half_space import __main__ as command


def test_friction_across_the_pull_is_told(tmp_path, capsys, monkeypatch):
    told = {"cof": 0.2, "cof_y": -0.05, "mean_F_x": 0.02, "mean_F_y": -0.005, "mean_F_z": 0.1}
    errors = {"grid_error": 1e-3, "step_error": 2e-3, "cycle_error": 0.0}
    monkeypatch.setattr(mdr.half_space, "slide", lambda *_, **__: SimpleNamespace(**told, **errors))
    path, motion = tmp_path / "case.toml", mdr.NormalOscillation(20e-6, 6e-6, 300.0)
    path.write_text(mdr.write_case(mdr.SlidingContact(mdr.Paraboloid(5e-3), mdr.Elastic(3e6, 0.3), 0.3, motion)))
    assert command.main([str(path), "--v-0", "1e-4", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert {name: printed[name] for name in told} == told
    assert command.main([str(path), "--v-0", "1e-4"]) == 0
    assert "cof_y          -0.05" in capsys.readouterr().out
