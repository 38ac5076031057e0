"""The guide: its code runs and prints what is shown, its links lead somewhere, its formulas are those of the code."""

import os
import pkgutil
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from html.parser import HTMLParser
from inspect import isfunction

import gallery_page
import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pages
import pytest
from matplotlib.testing.compare import compare_images
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import gamma

import mdr
from mdr.closed_forms import paper as theory

ROOT, DOCS = pages.ROOT, pages.DOCS
SAME = 12.0  #: root mean square over the pixels, of 255: letters of another font or version make a few


@pytest.mark.parametrize("page", pages.PAGES, ids=lambda page: page.name)
def test_a_page_does_what_it_says(page, tmp_path, monkeypatch):
    mpl.use("Agg")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(ROOT)
    monkeypatch.setenv("SLURM_ARRAY_TASK_ID", "1")
    monkeypatch.setattr("mdr.files.own_records._OWN", {})  # what a page registers is its own
    run = pages.Run(page).all()
    plt.close("all")
    wrong = {f"{page.name}:{block.line}": why for block, out in run.shown if (why := pages.difference(block.text, out))}
    assert not wrong
    source = "".join(block.text for block in pages.blocks(page) if block.language == "python")
    for name in re.findall(r'"(\w+\.(?:png|csv|nc|gif))"', source):
        assert (tmp_path / name).exists(), f"{name} is written by the code of the page"
    for name in pages.figures(page):
        assert (DOCS / "figures" / name).stat().st_size < 1e5
        assert compare_images(str(DOCS / "figures" / name), str(pages.made(name)), tol=SAME) is None


# --- the rules themselves ---


def page_of(folder, text):
    path = folder / "page.md"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "text",
    [
        "```python\nraise ArithmeticError\n```\n",
        "```fortran\nEND\n```\n",
        "```\nno language\n```\n",
        "```sh\nmdr velocity missing.toml\n```\n",
        "```sh\nrm -r everything\n```\n",
        "```sh\npython3 -m pip --python .venv install -q -e '.[nothing]'\n```\n",
        "```sh\n.venv/bin/python -m pip install -q -e . --group nothing\n```\n",
        "```sh\n.venv/bin/python -m validation --slow\n```\n",
        "```toml\nmu_0 = 0.5\n```\n",
        "```text\nout of nowhere\n```\n",
        "```python\nx = 1\n```\n\n```text\nnothing\n```\n",
        "```python\nx = 1\n",
        "```{eval-rst}\n.. autoclass:: mdr.Kone\n```\n",
    ],
)
def test_a_wrong_block_is_refused(text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises((Exception, SystemExit)):
        pages.Run(page_of(tmp_path, text)).all()


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("v_c = 0.5 m/s", "v_c = 0.50001 m/s", True),
        ("v_c = 0.5 m/s", "v_c = 0.51 m/s", False),
        ("v_c = 0.5 m/s", "v_x = 0.5 m/s", False),
        ("24 points", "25 points", False),
        ("error 2.7e-07", "error 4.1e-07", True),
        ("error 2.7e-07", "error 4.1e-05", False),
        ("(-0.0002 %)", "(-0.0004 %)", True),
        ("(-0.55 %)", "(-0.56 %)", False),
        ("one\n...\nfour", "one\ntwo\nthree\nfour", True),
        ("one\n...", "one\ntwo", True),
        ("one", "one\ntwo", False),
        ("one\ntwo", "one", False),
        ("x1 and E_1 at 3", "x1 and E_1 at 3", True),
        ("x1 and E_1", "x2 and E_1", False),
    ],
)
def test_shown_output_is_compared(shown, printed, same):
    assert (pages.difference(shown, printed) == "") is same


# --- links, names, navigation ---


def conf():
    names = {"__file__": str(DOCS / "conf.py")}
    before = list(sys.path)
    exec((DOCS / "conf.py").read_text(encoding="utf-8"), names)
    sys.path[:] = before
    return names


def prose(page):
    """A page without its blocks of code."""
    return pages.FENCE.sub("", page.read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", pages.PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(page)):
        if not re.match(r"[a-z]+:", target):
            assert (page.parent / target.split("#")[0]).exists(), target


@pytest.mark.parametrize("page", pages.PAGES, ids=lambda page: page.name)
def test_files_and_commands_in_a_line_are_there(page):
    """Inline code: paths of the repository exist, commands of mdr are understood."""
    from mdr.__main__ import parser

    for code in re.findall(r"(?<!`)`([^`\n]+)`(?!`)", prose(page)):
        if re.fullmatch(r"(?:mdr|docs|tests|validation|geometries|\.ci)/[\w./-]*", code):
            assert (ROOT / code).exists(), code
        if re.match(r"(?:\.venv/bin/)?mdr [a-z]+ .*[\w>-]", code) and "..." not in code:
            words = shlex.split(code.split(">")[0])
            parser().parse_args(words[1:])


def test_every_page_is_in_the_navigation():
    listed = [one for heading in conf()["PAGES"].values() for one in heading]
    assert len(set(listed)) == len(listed)
    known = {str(path.relative_to(DOCS).with_suffix("")) for path in DOCS.rglob("*.md")}
    assert known - {"index", "paper"} <= set(listed)
    assert set(listed) - known <= {"springs"}


def test_every_public_name_is_documented():
    documented = [
        path
        for page in sorted((DOCS / "api").glob("*.md"))
        for block in pages.blocks(page)
        for path in pages.documented(block.text)
    ]
    assert len(set(documented)) == len(documented)
    laws = {f"laws.{name}" for name in mdr.laws.__all__ if isfunction(getattr(mdr.laws, name))}
    assert {f"mdr.{name}" for name in {*mdr.__all__, *laws} - {"laws"}} <= set(documented)
    for path in documented:
        assert (pkgutil.resolve_name(path).__doc__ or "").strip(), path


class Sources(HTMLParser):
    """What a page loads, and where it leads."""

    def __init__(self, text):
        super().__init__()
        self.loaded, self.linked, self.tags = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.tags.append(tag)
        if tag in ("script", "img", "source", "iframe") and "src" in attrs:
            self.loaded.append(attrs["src"])
        if tag == "link" and attrs.get("rel") in ("stylesheet", "preload", "icon", "preconnect"):
            self.loaded.append(attrs["href"])
        if tag == "a" and "href" in attrs:
            self.linked.append(attrs["href"])


def test_the_site_builds_without_a_warning_and_needs_no_network(tmp_path):
    pytest.importorskip("sphinx")
    pytest.importorskip("myst_nb")
    pytest.importorskip("numpydoc")
    pytest.importorskip("furo")
    site = tmp_path / "site"
    command = [
        sys.executable,
        "-m",
        "sphinx",
        "-q",
        "-W",
        "--keep-going",
        "-D",
        "nb_execution_mode=off",
        "-d",
        tmp_path / "trees",
        DOCS,
        site,
    ]
    built = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"PYTHONWARNINGS": "ignore"})
    assert built.returncode == 0, built.stderr
    for path in site.rglob("*.html"):
        page = Sources(path.read_text(encoding="utf-8"))
        for target in page.loaded:
            if target.startswith("data:"):
                continue
            assert not re.match(r"(?:[a-z]+:)?//", target), f"{path.name} loads {target}"
            assert (path.parent / target.split("?")[0]).exists(), f"{path.name} loads {target}"
        for target in page.linked:
            if not re.match(r"[a-z]+:", target) and target.split("#")[0]:
                assert (path.parent / target.split("#")[0]).exists(), f"{path.name} links to {target}"
    for css in site.rglob("*.css"):
        assert not re.search(r"@import|url\(['\"]?(?:https?:)?//", css.read_text(encoding="utf-8")), css.name
    equations = Sources((site / "theory.html").read_text(encoding="utf-8")).tags.count("math")
    assert equations > 100
    assert "\\frac" not in (site / "theory.html").read_text(encoding="utf-8")


# --- the formulas of docs/theory.md, read off the page ---

OMEGA, U_Z0 = 300.0, 20e-6
CONE = mdr.Cone(theta=0.0127)


def contact(indenter=CONE, T=0.4, alpha=0.3, pull=None, u_z0=U_Z0, nu=0.4):
    return mdr.SlidingContact(
        indenter=indenter,
        material=mdr.KelvinVoigt(E=3e6, nu=nu, tau=T / OMEGA),
        mu_0=0.4,
        oscillation=mdr.NormalOscillation(u_z0=u_z0, du_z=alpha * u_z0, omega=OMEGA),
        pull=pull or mdr.RigidPull(),
    )


def test_springs_and_their_moduli():
    body, nu = mdr.Elastic(E=3e6, nu=0.4), 0.4
    assert_allclose(body.E_star, 3e6 / (1 - nu**2), rtol=1e-14)
    assert_allclose(body.G_star, 4 * (3e6 / (2 * (1 + nu))) / (2 - nu), rtol=1e-14)
    assert_allclose(body.mindlin_ratio, (2 - nu) / (2 * (1 - nu)), rtol=1e-14)
    shape, n, c = mdr.PowerLaw(n=3.0, c=2e4), 3.0, 2e4
    x, d = 1e-3, 10e-6
    kappa_n = np.sqrt(np.pi) * gamma(n / 2 + 1) / gamma(n / 2 + 1 / 2)
    # with r = x sin t, the integral of f'/√(x² − r²)
    assert_allclose(x * quad(lambda t: n * c * (x * np.sin(t)) ** (n - 1), 0, np.pi / 2)[0], kappa_n * c * x**n)
    assert_allclose(shape.profile_1d(x), kappa_n * c * x**n, rtol=1e-12)
    a = shape.contact_radius(d)
    assert_allclose(shape.profile_1d(a), d, rtol=1e-12)
    assert_allclose(shape.force(d, 4e6), 2 * 4e6 * quad(lambda x: d - shape.profile_1d(x), 0, a)[0], rtol=1e-9)
    assert_allclose(shape.stiffness(d, 4e6), 2 * 4e6 * a, rtol=1e-12)


def test_compression_of_a_kelvin_spring():
    """s is the supremum over what was pressed before, relaxed since; of a recorded run it is followed."""
    case = contact(T=1.5, alpha=0.9)
    run = mdr.slide(case, 1e-4, n_springs=32, steps_per_period=512, record=1)
    theta = np.linspace(0, 2 * 2 * np.pi / OMEGA, 40001)
    relaxed = np.exp(-theta / case.material.tau)
    for i in (0, 20, 31):
        gap = float(CONE.profile_1d(run.x[i]))
        for k in (100, 300, 500):
            s = np.max((case.oscillation.u_z(run.t[k] - theta) - gap) * relaxed, initial=0.0)
            assert run.s[k, i] == pytest.approx(s, abs=2e-3 * U_Z0)  # the gap of a cell is its mean


def test_eq_15_in_both_forms_and_with_harmonics():
    pull = mdr.SpringPull(k_x=2e4, m=0.1)
    case = contact(pull=pull, alpha=0.01)
    k_zc, k_xc, kappa, u = case.k_zc, case.k_xc, case.material.mindlin_ratio, case.oscillation.du_z
    K, H = k_zc * (1 + 1j * case.T), 1 / (pull.k_x - pull.m * OMEGA**2)
    short = case.mu_0 * OMEGA * u * abs(kappa + K * H)
    inertia = pull.m * OMEGA**2 - pull.k_x
    root = np.hypot(case.gamma_zc * OMEGA, kappa * (inertia - k_xc))
    assert_allclose(short, case.mu_0 * u * OMEGA * root / abs(inertia), rtol=1e-13)
    assert_allclose(mdr.critical_velocity(case), short, rtol=1e-13)
    damped = replace(case, pull=mdr.SpringPull(k_x=2e4, m=0.1, c_x=5.0))
    H = 1 / (2e4 - 0.1 * OMEGA**2 + 5j * OMEGA)
    assert_allclose(mdr.critical_velocity(damped), case.mu_0 * OMEGA * u * abs(kappa + K * H), rtol=1e-13)
    periodic = mdr.PeriodicMotion(omega=OMEGA, u_z0=U_Z0, cos=(2e-7, 5e-8), sin=(0.0, 3e-8))
    u_n, n = np.array([2e-7, 5e-8 - 3e-8j]), np.array([1, 2])
    H_n = 1 / (2e4 - 0.1 * (n * OMEGA) ** 2 + 5j * n * OMEGA)
    phase = np.linspace(0, 2 * np.pi, 100001)[:, None]
    term = 1j * n * OMEGA * (kappa + k_zc * (1 + 1j * n * case.T) * H_n) * u_n * np.exp(1j * n * phase)
    expected = case.mu_0 * term.sum(axis=1).real.max()
    assert_allclose(mdr.critical_velocity(replace(damped, oscillation=periodic)), expected, rtol=1e-8)


def test_full_slip_condition():
    """max of μ_0 κ u_z' − y', the body solved harmonic by harmonic."""
    case = contact(pull=mdr.SpringPull(k_x=2e4, m=0.1, c_x=5.0), alpha=0.5, T=0.0)
    phase = 2 * np.pi * np.arange(4096) / 4096
    F_N = case.indenter.force(case.oscillation.u_z(phase / OMEGA), case.material.E_star)
    F_n, n = np.fft.rfft(F_N) / F_N.size, np.arange(2049)
    H = 1 / (2e4 - 0.1 * (n * OMEGA) ** 2 + 5j * n * OMEGA)
    y_dot = np.fft.irfft(-case.mu_0 * 1j * n * OMEGA * F_n * H, 4096) * 4096
    rate = case.mu_0 * case.material.mindlin_ratio * case.oscillation.u_z_dot(phase / OMEGA) - y_dot
    assert_allclose(mdr.full_slip_critical_velocity(case), rate.max(), rtol=1e-5)  # instants 1.5e-3 apart


def test_static_friction():
    case = contact(T=0.4, alpha=0.5)
    least = float(CONE.force(U_Z0 * (1 - 0.5 * np.sqrt(1 + 0.4**2)), case.material.E_star))
    from mdr.closed_forms.full_slip import full_slip

    known = full_slip(case, 4096)
    assert_allclose(known.F_N.min(), least, rtol=1e-6)
    assert_allclose(mdr.static_cof(case), case.mu_0 * least / known.F_N.mean(), rtol=1e-6)


@pytest.mark.parametrize("v", [0.2, 0.7])
def test_curve_of_an_elastic_cone_under_a_rigid_pull(v):
    """The integral over the touches, with T = E = 0."""
    case = contact(T=0.0, alpha=0.5)
    u = case.oscillation.du_z

    def integrand(theta):
        high = 3 * np.pi - np.arcsin(v)
        sigma = brentq(
            lambda s: np.cos(theta + s) - np.cos(theta) - v * s, 2 * np.pi - np.arcsin(v) - theta, high - theta
        )
        stiffness = CONE.stiffness(U_Z0 + u * np.cos(theta), case.material.E_star)
        return stiffness * (-np.sin(theta) - v) * sigma

    total = quad(integrand, np.pi + np.arcsin(v), 2 * np.pi - np.arcsin(v) - 1e-9, epsabs=0, epsrel=1e-9)[0]
    mean = np.mean(CONE.force(case.oscillation.u_z(np.arange(512) * 2 * np.pi / OMEGA / 512), case.material.E_star))
    cof = mdr.cof_curve(case, v * mdr.critical_velocity(case)).cof[0]
    assert_allclose(cof / case.mu_0, 1 - u / (2 * np.pi * mean) * total, rtol=1e-8)


@pytest.mark.parametrize("v", [0.1, 0.5, 0.9])
def test_sticks_of_a_kelvin_punch(v):
    """A punch that keeps contact sticks once a period: its lag decays from b on, and D vanishes where it starts."""
    T, alpha = 0.7, 0.3
    case = contact(mdr.FlatPunch(a=1e-3), T=T, alpha=alpha)

    def of(sigma):
        E = np.exp(-(2 * np.pi - sigma) / T)

        def miss(b):
            return T * (v + np.sin(b)) * (1 - E) - np.cos(b) + np.cos(b - sigma) + v * sigma

        b = 2 * np.pi + np.linspace(-np.pi / 2, np.pi, 401)
        up = np.flatnonzero((miss(b[:-1]) < 0) & (miss(b[1:]) >= 0))
        if not up.size:  # so long no spring sticks
            return np.nan, E, -1.0
        b = brentq(miss, b[up[0]], b[up[0] + 1])
        return b, E, -np.sin(b - sigma) - v + E * (v + np.sin(b))

    grid = np.linspace(0.01, 2 * np.pi - 0.01, 200)
    first = next(k for k, sigma in enumerate(grid) if of(sigma)[2] < 0)
    longest = brentq(lambda sigma: of(sigma)[2], 1e-3, grid[first], xtol=1e-9)
    sigma = np.linspace(0, longest, 2001)[1:]
    found = np.array([of(one) for one in sigma])
    theta = found[:, 0] - sigma
    weight = found[:, 2] * (T + sigma / (1 - found[:, 1]))
    total = -np.trapezoid(weight, theta)  # θ falls as the stick grows
    share = case.k_zc * case.oscillation.du_z / (case.k_zc * U_Z0)
    cof = mdr.cof_curve(case, v * mdr.critical_velocity(case)).cof[0]
    assert_allclose(1 - cof / case.mu_0, share * total / (2 * np.pi), rtol=3e-3)  # the first stick is left out


def test_psi_and_both_ends_of_the_curve():
    from mdr.closed_forms.rigid_pull import near_critical

    punch, v = contact(mdr.FlatPunch(a=1e-3), T=0.0, alpha=0.3), 0.4
    phi_1 = np.pi + np.arcsin(v)
    phi_2 = brentq(
        lambda p: np.cos(p) - np.cos(phi_1) - v * (p - phi_1), 2 * np.pi - np.arcsin(v), 3 * np.pi - np.arcsin(v)
    )
    span = phi_2 - phi_1
    psi = (np.sin(phi_2) - np.sin(phi_1) - span * np.cos(phi_1) - v / 2 * span**2) / (2 * np.pi)
    assert_allclose(theory.deficit(v), psi, rtol=1e-12)
    cof = mdr.cof_curve(punch, v * mdr.critical_velocity(punch)).cof[0]
    assert_allclose(cof / punch.mu_0, 1 - 0.3 * psi, rtol=1e-12)
    assert_allclose(near_critical(punch).coefficient, 9 / (4 * np.pi) * 0.3, rtol=1e-12)
    kelvin = contact(mdr.FlatPunch(a=1e-3), T=0.4, alpha=0.3)
    law = near_critical(kelvin)
    assert (law.power, law.coefficient) == pytest.approx((1.5, 2 * np.sqrt(2) * 0.4 / (3 * np.pi) * 0.3))


def test_oscillating_load():
    pull = mdr.SpringPull(k_x=2e4, m=0.1, c_x=5.0)
    load = mdr.LoadOscillation(F_z0=0.1, dF_z=1e-4, omega=OMEGA, m_z=0.02)
    case = mdr.resolved(mdr.SlidingContact(CONE, mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3), 0.4, load, pull))
    K, H = complex(case.dynamic_stiffness(OMEGA)), 1 / (2e4 - 0.1 * OMEGA**2 + 5j * OMEGA)
    kappa = case.material.mindlin_ratio
    expected = 0.4 * OMEGA * 1e-4 * abs(kappa + K * H) / abs(K - 0.02 * OMEGA**2)
    assert_allclose(mdr.critical_velocity(case), expected, rtol=1e-12)
    assert_allclose(CONE.force(case.working_depth, case.material.E_star), 0.1, rtol=1e-12)


def test_oscillating_load_at_finite_amplitude():
    eps, p = 0.5, 1 / 2  # a cone
    load = mdr.LoadOscillation(F_z0=0.1, dF_z=0.05, omega=OMEGA)
    case = mdr.resolved(mdr.SlidingContact(CONE, mdr.Elastic(E=3e6, nu=0.5), 0.4, load))
    phi = np.linspace(0, np.pi, 100001)
    greatest = np.max(np.sin(phi) * (1 + eps * np.cos(phi)) ** -p)
    unit = 0.4 * case.material.mindlin_ratio * OMEGA * 0.05 / case.k_zc
    assert_allclose(mdr.full_slip_critical_velocity(case), unit * greatest, rtol=1e-5)
    assert_allclose(greatest, 1 + p**2 * eps**2 / 2, rtol=5e-3)  # the next term is of the fourth power
    assert_allclose(mdr.static_cof(case), 0.4 * (1 - eps), rtol=1e-5)


def test_deviation_is_proportional_to_amplitude_and_to_the_exponent_of_the_stiffness():
    """C of r² and of r⁴ is the same, and a punch has none."""
    pull, found = mdr.SpringPull(k_x=2e4, m=0.05, c_x=5.0), {}
    for n in (2, 4):
        shape = mdr.PowerLaw(n=n, c=1 / (1e-3**n / 20e-6 * (2.0 if n == 2 else 8 / 3)))
        case = contact(shape, alpha=1e-4, pull=pull, T=0.0)
        found[n] = (mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1) / 1e-4 * n
    assert found[2] == pytest.approx(found[4], rel=2e-3)  # α to the next power
    assert abs(found[2]) > 1e-3
    punch = contact(mdr.FlatPunch(a=1e-3), alpha=0.3, pull=pull, T=0.0)
    assert_allclose(mdr.full_slip_critical_velocity(punch), mdr.critical_velocity(punch), rtol=1e-8)


def test_pulled_sideways_at_a_fixed_depth():
    body, u_x = mdr.Elastic(E=3e6, nu=0.4), 2e-6
    found = mdr.partial_slip(CONE, body, 0.4, U_Z0, u_x)
    d_c = U_Z0 - u_x / (0.4 * body.mindlin_ratio)
    assert_allclose(found.F_x, 0.4 * (CONE.force(U_Z0, body.E_star) - CONE.force(d_c, body.E_star)), rtol=1e-12)
    assert_allclose(CONE.profile_1d(found.stick_radius), d_c, rtol=1e-12)


def test_bump_of_the_page_on_extending_has_that_image():
    """g of h [1 − exp(−r²/b²)] by Dawson's function, and its integral, by quadrature."""
    from scipy.special import dawsn

    x, b = 0.7, 1.3
    by_quadrature = x * quad(lambda t: 2 * x * np.sin(t) / b**2 * np.exp(-((x * np.sin(t) / b) ** 2)), 0, np.pi / 2)[0]
    assert_allclose(2 * x / b * dawsn(x / b), by_quadrature, rtol=1e-12)
    area = quad(lambda x: 2 * x / b * dawsn(x / b), 0, x)[0]
    assert_allclose(x - b * dawsn(x / b), area, rtol=1e-10)


def test_figures_are_all_shown():
    shown = {name for page in pages.PAGES for name in pages.figures(page)}
    assert {path.name for path in (DOCS / "figures").iterdir() if path.is_file()} == shown


def test_the_gallery_has_every_script():
    """Where this fails, `python tests/gallery_page.py` draws what is missing and writes the page."""
    assert gallery_page.PAGE.read_text(encoding="utf-8") == gallery_page.page()
    assert {path.stem for path in gallery_page.PICTURES.iterdir()} == set(gallery_page.names())
    assert all(path.stat().st_size < 4e4 for path in gallery_page.PICTURES.iterdir())


def test_the_paper_has_the_form_that_its_journal_asks_for():
    """Sections and length of the Journal of Open Source Software; every reference is cited, and the other way round."""
    paper = (DOCS / "paper.md").read_text(encoding="utf-8").split("\n---\n", 1)[1]
    sections = ["Summary", "Statement of need", "State of the field", "Software design", "Research impact statement"]
    sections += ["AI usage disclosure", "Acknowledgements", "References"]
    assert re.findall(r"^# (.*)$", paper, re.MULTILINE) == sections
    assert 750 <= len(re.sub(r"<!--.*?-->", "", paper).split()) <= 1750
    assert len(re.findall(r"^!\[.*\]\((\S+)\)", paper, re.MULTILINE)) == 1
    bib = (DOCS / "paper.bib").read_text(encoding="utf-8")
    assert set(re.findall(r"@(\w+)", paper)) == set(re.findall(r"^@\w+\{(\w+),", bib, re.MULTILINE))
