"""The package's answers are the program's, to the last bit."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from conftest import assert_same, random_case, settings

import holdfast
from holdfast._errors import words_of

CASES = 200


@pytest.fixture(autouse=True)
def quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", holdfast.PlausibilityWarning)
        yield


def ask(question):
    """The answer, or what stands in its place."""
    try:
        return question()
    except (ValueError, holdfast.NoAnswer) as refusal:
        return refusal


def compare(program, words, question):
    found = ask(question)
    columns = program(words)
    if isinstance(found, Exception):
        assert columns.get("exit code") == ["2" if isinstance(found, ValueError) else "1"]
        assert str(found) in words_of(columns["message"][0])  # keywords in place of options
        return False
    assert_same(found, columns)
    return True


@pytest.mark.parametrize("seed", range(CASES))
def test_random_case(program, seed):
    random = np.random.default_rng(seed)
    values = random_case(random)
    case = holdfast.Case(values)
    given = settings(values)
    p = sorted(round(x, 2) for x in random.uniform(-1000.0, 200.0, 2))
    d = sorted(round(x, 2) for x in random.uniform(-40.0, 20.0, 2))
    over = ["--p", f"{p[0]}:{p[1]}:13", "--d", f"{d[0]}:{d[1]}:11"]
    assert compare(
        program, ["stability", *over, "--radius", *given], lambda: case.chart((*p, 13), (*d, 11), radius=True)
    )
    compare(program, ["boundary", "--stable-interval", *given], case.stable_intervals)
    compare(
        program,
        ["orbit", "--max-period", "2000", *given],
        lambda: case.orbit(max_period=2000),
    )
    compare(
        program,
        ["lyapunov", "--duration", "3", "--discard", "1", *given],
        lambda: case.lyapunov(duration=3, discard=1),
    )


SAME = [
    (["simulate", "--duration", "2"], lambda case: case.simulate(2.0)),
    (["simulate", "--duration", "0.5", "--switching", "exact"], lambda case: case.simulate(0.5, switching="exact")),
    (["simulate", "--duration=1", "--kick=0.5:0.001"], lambda case: case.simulate(1, kick=(0.5, 0.001))),
    (["response"], lambda case: case.response()),
    (["stability", "--continuous", "--radius"], lambda case: case.chart(continuous=True, radius=True)),
    (
        ["stability", "--axis", "control.sampling_period=0.0005:0.01:7", "--axis", "control.differential_gain=-30:0:5"],
        lambda case: case.chart(
            axes={"control.sampling_period": (0.0005, 0.01, 7), "control.differential_gain": (-30.0, 0.0, 5)}
        ),
    ),
    (["boundary", "--p=-600:0"], lambda case: case.boundary((-600, 0))),
    (["boundary", "--regions"], lambda case: case.gain_regions()),
    (
        ["stability", "--prove", "--p", "-600:100:8", "--d", "-20:10:4", "--undecided", "0.01"],
        lambda case: case.proved_chart((-600, 100, 8), (-20, 10, 4), undecided=0.01),
    ),
    (["orbit", "--prove"], lambda case: case.orbit(prove=True)),
    (["margins"], lambda case: case.margins()),
    (["margins", "--prove"], lambda case: case.margins(prove=True)),
    (
        ["max-delay", "--frequency", "10:15:2", "--criterion", "stable", "--prove"],
        lambda case: case.max_delay((10, 15, 2), criterion="stable", prove=True),
    ),
    (["design"], lambda case: case.design()),
    (["design", "--frequency", "5:15:3"], lambda case: case.design((5, 15, 3))),
    (["design", "--both-gains"], lambda case: case.design(both_gains=True)),
    (["max-delay", "--frequency", "5:15:3"], lambda case: case.max_delay((5, 15, 3))),
    (["sensitivity"], lambda case: case.sensitivity()),
    (["spectrum", "--duration", "4"], lambda case: case.spectrum(4)),
    (["section", "--duration", "2", "--from", "1"], lambda case: case.section(2, from_=1)),
    (["deviation", "--duration", "1"], lambda case: case.deviation(duration=1)),
    (["coverage", "--durations", "1,2"], lambda case: case.coverage([1, 2])),
    (["orbit", "--trace"], lambda case: case.orbit(trace=True)),
    (
        ["orbit", "--map=backlash.width=0.0004:0.0006", "--map=control.differential_gain=-14:-12"],
        lambda case: case.orbit_borders({"backlash.width": (0.0004, 0.0006), "control.differential_gain": (-14, -12)}),
    ),
    (
        ["basins", "--map", "backlash.width=0.001:0.002:2", "--map", "control.sampling_period=0.01:0.011:2"],
        lambda case: case.motions({"backlash.width": (0.001, 0.002, 2), "control.sampling_period": (0.01, 0.011, 2)}),
    ),
    (["orbit", "--certificate"], lambda case: case.orbit(certificate=True)),
    (
        ["orbit", "--follow", "excitation.amplitude=0.4:0.6"],
        lambda case: case.orbit_ends("excitation.amplitude", (0.4, 0.6)),
    ),
    (["verdict"], lambda case: case.verdict()),
    (["lyapunov", "--duration", "2", "--history"], lambda case: case.lyapunov(duration=2, history=True)),
    (
        ["basins", "--axis", "initial.z1=-0.01:0.01:4", "--axis", "initial.v1=-0.1:0.1:3"],
        lambda case: case.basins({"initial.z1": (-0.01, 0.01, 4), "initial.v1": (-0.1, 0.1, 3)}),
    ),
    (
        ["diagram", "--axis", "backlash.width=0:0.001:3", "--transient", "1", "--strobes", "5"],
        lambda case: case.diagram("backlash.width", (0, 0.001, 3), transient=1, strobes=5),
    ),
    (
        ["sweep", "--axis", "backlash.width=0:0.001:3", "--axis", "excitation.frequency=log:5:20:3", "--duration", "2"],
        lambda case: case.sweep(
            {"backlash.width": (0, 0.001, 3), "excitation.frequency": ("log", 5, 20, 3)}, duration=2
        ),
    ),
    (
        [
            "sweep",
            "--axis",
            "backlash.width=0,0.0007",
            "--metric",
            "verdict",
            "--metric",
            "steady_rms",
            "--duration",
            "2",
        ],
        lambda case: case.sweep({"backlash.width": [0.0, 0.0007]}, ["verdict", "steady_rms"], duration=2),
    ),
    (["reduce"], lambda case: case.reduce()),
    (["statics", "--force", "-1:1:3"], lambda case: case.statics((-1, 1, 3))),
    (["modes", "--count", "5"], lambda case: case.modes(count=5)),
    (["conductors", "--find", "drake"], lambda case: holdfast.conductors("drake")),
    (["answers"], lambda case: case.answers()),
]


@pytest.mark.parametrize("words, question", SAME, ids=[" ".join(words) for words, _ in SAME])
def test_job(program, words, question):
    assert_same(question(holdfast.Case()), program(words))


STRING = {"plant.model": "string", "plant.modes": 10, "control.differential_gain": -2.0, "absorber.clamp_mass": 0.01}
OF_STRING = [
    (["modal-damping", "--count", "4"], lambda case: case.modal_damping(count=4)),
    (
        ["stability", "--radius", "--p=-600:0:7", "--d=-10:2:7"],
        lambda case: case.chart((-600, 0, 7), (-10, 2, 7), radius=True),
    ),
    (["boundary", "--stable-interval"], lambda case: case.stable_intervals()),
    (["simulate", "--duration", "0.5"], lambda case: case.simulate(0.5)),
    (["margins"], lambda case: case.margins()),
]


@pytest.mark.parametrize("words, question", OF_STRING, ids=[" ".join(words) for words, _ in OF_STRING])
def test_job_on_a_string(program, words, question):
    assert_same(question(holdfast.Case(STRING)), program([*words, *settings(STRING)]))


SPAN = {"conductor.name": "Drake", "conductor.span": 300.0, "conductor.sag": 6.0, "conductor.damping_ratio": 0.001}
DEVICE = {"kind": "dashpot", "position": 1.5, "damping": 300.0}
OF_SPAN = [
    (["aeolian", "--frequency", "10:40:4"], lambda case: case.aeolian((10, 40, 4))),
    (["absorption", "--frequency", "10:40:4"], lambda case: case.absorption((10, 40, 4))),
    (
        ["place", "--frequency", "10:40:4", "--for", "damping"],
        lambda case: case.place(1, frequency=(10, 40, 4), for_="damping"),
    ),
]


@pytest.mark.parametrize("words, question", OF_SPAN, ids=[" ".join(words) for words, _ in OF_SPAN])
def test_job_on_a_span(program, words, question, tmp_path):
    case = holdfast.Case(SPAN, device=DEVICE)
    file = tmp_path / "case.toml"
    file.write_text(
        '[conductor]\nname = "Drake"\nspan = 300.0\nsag = 6.0\ndamping_ratio = 0.001\n\n[[device]]\nkind = "dashpot"\nposition = 1.5\ndamping = 300.0\n'
    )
    compare(program, [*words, "--case", str(file)], lambda: question(case))


STRUNG = {
    "conductor.name": "Drake",
    "conductor.span": 213.36,
    "stringing.temperature": 15.6,
    "stringing.tension": 27997.0,
    "stringing.state": "initial",
    "weather.ice": 0.0127,
    "weather.wind_pressure": 190.0,
    "weather.load_temperature": -17.8,
}
UNCERTAIN = {"uncertain.plant.absorber_damping": "± 20 %", "uncertain.control.sampling_period": [0.001, 0.0012]}
GAINS = ["--p=-400:0:3", "--d=-30:0:3"]
OVER = ((-400.0, 0.0, 3), (-30.0, 0.0, 3))
OF_MANY = [
    (
        STRUNG,
        ["sag-tension", "--temperature=-20:90:5", "--initial"],
        lambda case: case.sag_tension((-20, 90, 5), initial=True),
    ),
    (
        UNCERTAIN,
        ["stability", *GAINS, "--family", "--draws", "20"],
        lambda case: case.chart(*OVER, family=True, draws=20),
    ),
    (UNCERTAIN, ["stability", "--family", "--prove"], lambda case: case.proved_family()),
    (UNCERTAIN, ["boundary", "--stable-interval", "--family"], lambda case: case.stable_intervals(family=True)),
    (UNCERTAIN, ["margins", "--family"], lambda case: case.margins(family=True)),
]


@pytest.mark.parametrize("values, words, question", OF_MANY, ids=[" ".join(words) for _, words, _ in OF_MANY])
def test_job_on_many_states(program, values, words, question):
    assert_same(question(holdfast.Case(values)), program([*words, *settings(values)]))


def test_family_of_a_job_without_one():
    with pytest.raises(TypeError, match="family"):
        holdfast.Case().orbit(family=True)


def test_ranges_nested_dotted_and_as_keywords(program):
    nested = {"uncertain": {"plant": {"absorber_damping": "± 20 %"}, "control.sampling_period": [0.001, 0.0012]}}
    expected = program(["margins", "--family", *settings(UNCERTAIN)])
    again = holdfast.Case.from_toml(holdfast.Case(UNCERTAIN).to_toml())
    for case in (holdfast.Case(nested), holdfast.Case(**nested), holdfast.Case().with_(nested), again):
        assert_same(case.margins(family=True), expected)
