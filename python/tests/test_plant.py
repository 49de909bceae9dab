"""Plants of the user's own: against NumPy, SciPy and python-control, and against the two masses that the
program knows itself."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import holdfast
from holdfast._loops import sampled_plant

scipy_linalg = pytest.importorskip("scipy.linalg")


def chain(masses: int = 6) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A chain of masses between two walls, order twice as many: u pulls at the third one against the
    second, F acts on the second, of which the displacement is read. Outputs: z, Dz."""
    m = 0.1 + 0.05 * np.arange(masses)
    k = 400.0 * (1.0 + 0.3 * np.sin(np.arange(masses + 1)))
    stiffness = np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
    damping = 2e-3 * stiffness + 0.05 * np.eye(masses)
    a = np.block([[np.zeros((masses, masses)), np.eye(masses)], [-stiffness / m[:, None], -damping / m[:, None]]])
    b = np.zeros((2 * masses, 2))
    b[masses + 2, 0], b[masses + 1, 0] = 1.0 / m[2], -1.0 / m[1]
    b[masses + 1, 1] = 1.0 / m[1]
    c = np.zeros((2, 2 * masses))
    c[0, 1], c[1, 2], c[1, 1] = 1.0, 1.0, -1.0
    return a, b, c


SAMPLING = {"sampling_period": 0.002, "processing_delay": 0.0007}


@pytest.fixture
def order_12():
    control = pytest.importorskip("control")
    a, b, c = chain()
    return holdfast.plant(control.ss(a, b, c, 0), relative=1)


def closed_matrix(case: holdfast.Case, p: float, d: float) -> np.ndarray:
    arrays = case.plant_matrices()
    matrix, command, _ = sampled_plant(arrays)
    past = np.zeros(matrix.shape[0] - 12)
    row = np.concatenate([p * arrays["measured_displacement"] + d * arrays["measured_velocity"], past])
    return matrix + np.outer(command, row)


def test_chart_against_eigenvalues(order_12):
    case = order_12.case(control=SAMPLING)
    p, d = np.linspace(-600, 600, 9), np.linspace(-40, 40, 9)
    chart = case.chart(p, d, radius=True)
    for i, one in enumerate(p):
        for j, other in enumerate(d):
            radius = np.max(np.abs(np.linalg.eigvals(closed_matrix(case, one, other))))
            assert chart["spectral_radius"][i, j] == pytest.approx(radius, rel=1e-9)
            assert chart["stable"][i, j] == (radius < 1.0)
    assert 0 < np.count_nonzero(chart["stable"]) < chart["stable"].size


def test_intervals_end_on_the_circle(order_12):
    case = order_12.case(control=SAMPLING)
    intervals = case.stable_intervals(p=50.0)
    for lower, upper in zip(intervals["lower"], intervals["upper"]):
        for end, inside in ((lower, 1e-6), (upper, -1e-6)):
            radius = np.max(np.abs(np.linalg.eigvals(closed_matrix(case, 50.0, end))))
            assert radius == pytest.approx(1.0, abs=1e-8)
            step = inside * (upper - lower)
            assert np.max(np.abs(np.linalg.eigvals(closed_matrix(case, 50.0, end + step)))) < 1.0


def test_margins_against_the_circle(order_12):
    case = order_12.case(control={**SAMPLING, "proportional_gain": 50.0, "differential_gain": -2.0})
    intervals = case.stable_intervals(p=50.0)
    inside = np.flatnonzero((intervals["lower"] < -2.0) & (intervals["upper"] > -2.0))
    assert inside.size == 1
    margins = case.margins()
    of_d = (margins["quantity"] == "differential_gain") & (margins["side"] == "below")
    assert margins["position"][of_d][0] == pytest.approx(intervals["lower"][inside[0]], rel=1e-9)
    of_delay = (margins["quantity"] == "processing_delay") & (margins["side"] == "above")
    delay = float(margins["position"][of_delay][0])
    if margins["outcome"][of_delay][0] == "boundary":
        late = order_12.case(control={**SAMPLING, "processing_delay": delay})
        assert np.max(np.abs(np.linalg.eigvals(closed_matrix(late, 50.0, -2.0)))) == pytest.approx(1.0, abs=1e-7)


def test_design_has_least_radius(order_12):
    case = order_12.case(control={**SAMPLING, "proportional_gain": 50.0, "differential_gain": -2.0})
    design = case.design()
    best = float(design["least_radius_gain"][0])
    radii = [np.max(np.abs(np.linalg.eigvals(closed_matrix(case, 50.0, best + x)))) for x in (-1e-2, 0.0, 1e-2)]
    assert radii[1] <= min(radii) + 1e-9


def test_response_against_python_control(order_12):
    control = pytest.importorskip("control")
    gains = {"proportional_gain": 50.0, "differential_gain": -2.0}
    case = order_12.case(
        control={**SAMPLING, **gains}, excitation={"amplitude": 1.0, "frequency": 7.0, "hold": "sampled"}
    )
    response = case.response(50.0, -2.0)
    loop = case.to_control(closed=True)
    amplitude = abs(loop(np.exp(2j * np.pi * 7.0 * SAMPLING["sampling_period"]))[0, 0])
    assert response["amplitude_m"][0, 0] == pytest.approx(amplitude, rel=1e-9)
    free = abs(order_12.to_control()(2j * np.pi * 7.0)[0, 1])
    assert response["ratio_to_uncontrolled"][0, 0] == pytest.approx(amplitude / free, rel=1e-9)
    assert np.max(np.abs(control.poles(loop))) < 1.0


def test_motion_without_play_against_numpy(order_12):
    control = {**SAMPLING, "proportional_gain": 50.0, "differential_gain": -2.0}
    case = order_12.case(control=control, excitation={"amplitude": 1.0, "frequency": 7.0, "hold": "sampled"})
    motion = case.simulate(2.0)
    arrays = case.plant_matrices()
    matrix, command, force = sampled_plant(arrays)
    state = np.zeros(matrix.shape[0])
    h, v = arrays["displacement"], arrays["velocity"]
    for k, t in enumerate(motion["time_s"]):
        x = state[:12]
        u = 50.0 * (h @ x) - 2.0 * (v @ x)
        assert motion["z1_m"][k] == pytest.approx(h @ x, rel=1e-8, abs=1e-13)
        assert motion["control_force_N"][k] == pytest.approx(u, rel=1e-8, abs=1e-10)
        state = matrix @ state + command * u + force * np.cos(2 * np.pi * 7.0 * t)


def two_masses(case: holdfast.Case) -> holdfast.Plant:
    arrays = case.plant_matrices()
    c = np.vstack([arrays["displacement"], arrays["relative_displacement"]])
    b = np.column_stack([arrays["command_input"], arrays["excitation_input"]])
    return holdfast.plant((arrays["state_matrix"], b, c), relative=1)


GIVEN = {"control": {"proportional_gain": -557.0, "differential_gain": -13.0, "sampling_period": 0.001}}


@pytest.mark.parametrize("turned", [False, True], ids=["physical states", "other states"])
def test_two_masses_as_own_plant(turned):
    """The built-in plant given by its matrices, also in other coordinates, is what the program knows: chart,
    motion with play at samples and between, orbit, exponents, verdict."""
    case = holdfast.Case()
    plant = two_masses(case)
    np.testing.assert_allclose(plant.velocity_lift, [0, 0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(plant.displacement_lift, [0, 0, 1, 0], atol=1e-12)
    if turned:
        t = np.array([[1.0, 0.3, 0, 0.1], [0, 2.0, 0.5, 0], [0.2, 0, 1.0, 0], [0, 0.1, 0, 3.0]])
        inverse = np.linalg.inv(t)
        b = np.column_stack([plant.command_input, plant.excitation_input])
        c = np.vstack([plant.displacement, plant.relative_displacement])
        plant = holdfast.plant((t @ plant.state_matrix @ inverse, t @ b, c @ inverse), relative=1)
    own = plant.case(GIVEN, backlash={"width": 0.0005})
    p, d = (-1000, 200, 21), (-40, 20, 21)
    np.testing.assert_array_equal(own.chart(p, d)["stable"], case.chart(p, d)["stable"])
    np.testing.assert_allclose(
        own.chart(p, d, radius=True)["spectral_radius"], case.chart(p, d, radius=True)["spectral_radius"], rtol=1e-9
    )
    for switching in ("sampled", "exact"):
        ours, theirs = (each.simulate(1.0, switching=switching) for each in (own, case))
        np.testing.assert_allclose(ours["z2_m"], theirs["z2_m"], rtol=0, atol=1e-9)
        np.testing.assert_array_equal(ours["in_backlash"], theirs["in_backlash"])
    ours, theirs = own.orbit(), case.orbit()
    assert ours.period_samples == theirs.period_samples
    assert ours.largest_multiplier == pytest.approx(theirs.largest_multiplier, rel=1e-6)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", holdfast.PlausibilityWarning)
        assert own.verdict().verdict == case.verdict().verdict
        exponents = [each.lyapunov(duration=20, discard=5, largest=True)["per_second"] for each in (own, case)]
    assert exponents[0][0] == pytest.approx(exponents[1][0], abs=0.3)


class PaperBacklash:
    """The rule of Kollár 2022, Eqs. (7) and (8), at samples; in plain Python."""

    def __init__(self, width: float) -> None:
        self.width, self.gap, self.before = width, None, 0.0

    def transmits(self, dz: float, dv: float) -> bool:
        """Takes in a sample; whether the drive transmits until the next one."""
        if self.gap is not None:
            if not self.gap[0] <= dz <= self.gap[1]:
                self.gap = None
        elif self.before > 0.0 >= dv:
            self.gap = (dz - self.width, dz)
        elif self.before < 0.0 <= dv:
            self.gap = (dz, dz + self.width)
        self.before = dv
        return self.gap is None


def test_motion_with_play_against_numpy(order_12):
    """Order 12 with play, every sample by an independent loop."""
    control = {"sampling_period": 0.002, "proportional_gain": 50.0, "differential_gain": -2.0}
    case = order_12.case(control=control, excitation={"amplitude": 1.0, "frequency": 7.0}, backlash={"width": 1e-3})
    motion = case.simulate(4.0)
    arrays = case.plant_matrices()
    matrix, command, force = sampled_plant(arrays)
    play = PaperBacklash(1e-3)
    state = np.zeros(12)
    for k, t in enumerate(motion["time_s"]):
        z, v = arrays["displacement"] @ state, arrays["velocity"] @ state
        dz, dv = arrays["relative_displacement"] @ state, arrays["relative_velocity"] @ state
        u = 50.0 * z - 2.0 * v if play.transmits(dz, dv) else 0.0
        assert motion["z1_m"][k] == pytest.approx(z, rel=1e-6, abs=1e-11)
        assert motion["z2_m"][k] == pytest.approx(z + dz, rel=1e-6, abs=1e-11)
        assert bool(motion["in_backlash"][k]) == (play.gap is not None)
        state = matrix @ state + command * u + force * np.cos(2 * np.pi * 7.0 * t)
    assert 0.02 < np.mean(motion["in_backlash"]) < 0.98


def test_verdict_and_orbit_of_order_12(order_12):
    control = {"sampling_period": 0.002, "proportional_gain": 50.0, "differential_gain": -2.0}
    case = order_12.case(control=control, excitation={"amplitude": 1.0, "frequency": 10.0}, backlash={"width": 1e-3})
    verdict = case.verdict()
    assert verdict.verdict and verdict.rests_on
    smooth = case.with_(backlash={"width": 0.0})
    orbit = smooth.orbit()
    assert orbit.period_samples == 50
    largest = np.max(np.abs(np.linalg.eigvals(closed_matrix(smooth, 50.0, -2.0))))
    assert orbit.largest_multiplier == pytest.approx(largest**50, rel=1e-6)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", holdfast.PlausibilityWarning)
        exponent = smooth.lyapunov(duration=60, discard=10, largest=True)
    assert exponent["per_sample"][0] == pytest.approx(np.log(largest), abs=5e-4)


def test_same_plant_from_every_kind_of_system():
    control = pytest.importorskip("control")
    signal = pytest.importorskip("scipy.signal")
    numerator, denominator = [1.0, 40.0, 900.0], np.polymul([0.5, 0.2, 60.0], [1.0, 3.0, 700.0])
    systems = [
        signal.TransferFunction(numerator, denominator),
        signal.TransferFunction(numerator, denominator).to_ss(),
        signal.TransferFunction(numerator, denominator).to_zpk(),
        control.tf(numerator, denominator),
        control.ss(control.tf(numerator, denominator)),
    ]
    charts = []
    for system in systems:
        case = holdfast.plant(system).case(control={"sampling_period": 0.005})
        charts.append(case.chart((-200, 50, 11), (-20, 5, 11), radius=True))
    for chart in charts[1:]:
        np.testing.assert_allclose(chart["spectral_radius"], charts[0]["spectral_radius"], rtol=1e-7)
    assert 0 < np.count_nonzero(charts[0]["stable"]) < 121


def test_filter_and_drive_and_late_commands(order_12):
    control = {"sampling_period": 0.002, "processing_delay": 0.005, "measurement_filter": 60.0, "drive_bandwidth": 80.0}
    case = order_12.case(control=control)
    radius = case.chart(50.0, -1.0, radius=True)["spectral_radius"][0, 0]
    closed = case.with_(control={"proportional_gain": 50.0, "differential_gain": -1.0}).to_control(closed=True)
    assert radius == pytest.approx(np.max(np.abs(closed.poles())), rel=1e-8)


def test_to_control_of_the_two_masses():
    pytest.importorskip("control")
    for delay in (0.0, 0.0004, 0.001, 0.0023):
        case = holdfast.Case(control={"processing_delay": delay})
        radius = case.chart(-557.0, -13.0, radius=True)["spectral_radius"][0, 0]
        assert np.max(np.abs(case.to_control(closed=True).poles())) == pytest.approx(radius, rel=1e-9)


def test_what_is_not_about_the_plant_is_refused(order_12):
    case = order_12.case()
    for ask in (case.reduce, case.modes, case.modal_damping, case.aeolian, case.answers, case.explain, case.decay):
        with pytest.raises(ValueError, match="cannot answer for a plant of your own"):
            ask()
    with pytest.raises(ValueError, match="on a plant of your own"):
        case.with_(plant={"absorber_mass": 1.0}).chart()
    with pytest.raises(ValueError, match="tuned"):
        order_12.case(control={"proportional_gain": "tuned"})
    with pytest.raises(ValueError, match="state"):
        order_12.case(initial={"z1": 0.01})


def test_frequency_response_data(order_12):
    case = order_12.case(control=SAMPLING)
    f = np.linspace(0.01, 2000.0, 400_001)
    a, b, h = order_12.state_matrix, order_12.command_input, order_12.displacement
    values, vectors = np.linalg.eig(a)
    beta, gamma = np.linalg.solve(vectors, b.astype(complex)), h @ vectors
    s = 2j * np.pi * f
    response = sum(g * y / (s - value) for g, y, value in zip(gamma, beta, values))
    data = holdfast.frequency_response(f, response)
    found = data.margins(50.0, -2.0, **SAMPLING)
    assert found["stable"] is bool(case.chart(50.0, -2.0)["stable"][0, 0])
    circle = np.exp(2j * np.pi * np.linspace(1e-4, 0.5, 200_001))
    loop = case.to_control()
    values, vectors = np.linalg.eig(loop.A)
    beta, gamma = np.linalg.solve(vectors, loop.B.astype(complex))[:, 0], np.array([50.0, -2.0]) @ loop.C @ vectors
    open_loop = sum(g * y / (circle - value) for g, y, value in zip(gamma, beta, values))
    assert found["modulus"] == pytest.approx(np.min(np.abs(1.0 - open_loop)), rel=1e-3)
    coarse = holdfast.frequency_response(f[::20_000], response[::20_000])
    assert coarse.margins(500.0, -20.0, **SAMPLING)["stable"] in (None, True, False)
    assert holdfast.frequency_response(f, response, stable=False).margins(1.0, 0.0, **SAMPLING)["stable"] is None
