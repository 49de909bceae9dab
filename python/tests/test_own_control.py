"""Controllers and forces of the user's own, in Python and compiled."""

from __future__ import annotations

import ctypes
import subprocess

import numpy as np
import pytest

import holdfast

P, D = -557.0, -13.0


def pd(k, t, displacement, velocity):
    return P * displacement + D * velocity


@pytest.mark.parametrize("switching", ["sampled", "exact"])
def test_python_controller_is_the_built_in_one(switching):
    case = holdfast.Case()
    theirs = case.simulate(1.0, switching=switching)
    ours = case.simulate(1.0, switching=switching, controller=pd)
    for name in theirs:
        if theirs[name].dtype.kind == "f":
            np.testing.assert_allclose(
                ours[name], theirs[name], rtol=0, atol=1e-9 * np.max(np.abs(theirs[name])), err_msg=name
            )
        else:
            np.testing.assert_array_equal(ours[name], theirs[name])


def test_what_a_controller_is_called_with():
    seen = []

    def law(k, t, displacement, velocity):
        seen.append((k, t, displacement, velocity))
        return 0.0

    case = holdfast.Case(control={"sampling_period": 0.01})
    motion = case.simulate(0.5, controller=law)
    free = case.simulate(0.5, controller=lambda *_: 0.0)
    np.testing.assert_array_equal(motion["z1_m"], free["z1_m"])
    first = seen[: len(motion["time_s"])]
    assert [k for k, *_ in first] == list(range(len(first)))
    np.testing.assert_allclose([t for _, t, *_ in first], motion["time_s"], rtol=1e-12)
    np.testing.assert_allclose([z for _, _, z, _ in first], motion["z1_m"], rtol=0, atol=1e-12)


def test_controller_on_a_plant_of_ones_own():
    a = np.array([[0.0, 1.0], [-400.0, -0.5]])
    plant = holdfast.plant((a, np.array([0.0, 2.0]), np.array([1.0, 0.0])))
    case = plant.case(control={"differential_gain": -1.0}, backlash={"width": 1e-4})
    theirs = case.simulate(1.0)
    ours = case.simulate(1.0, controller=lambda k, t, z, v: -1.0 * v)
    np.testing.assert_allclose(ours["z1_m"], theirs["z1_m"], rtol=0, atol=1e-12)


def test_compiled_controllers(tmp_path):
    source, library = tmp_path / "law.c", tmp_path / "law.so"
    source.write_text(
        "double pd(long long k, double t, double z, double v) { return -557.0 * z - 13.0 * v; }\n"
        "double scaled(long long k, double t, double z, double v, void *data)"
        " { return ((double *)data)[0] * z + ((double *)data)[1] * v; }\n"
    )
    try:
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", library, source], check=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no C compiler")
    law = ctypes.CDLL(str(library)).pd
    law.restype = ctypes.c_double
    law.argtypes = [ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_double]
    case = holdfast.Case()
    expected = case.simulate(1.0, controller=pd)["z1_m"]
    np.testing.assert_allclose(case.simulate(1.0, controller=law)["z1_m"], expected, rtol=0, atol=1e-15)
    wrong = ctypes.CDLL(str(library))["scaled"]
    with pytest.raises(TypeError, match="double"):
        case.simulate(0.1, controller=wrong)
    scipy = pytest.importorskip("scipy")
    gains = (ctypes.c_double * 2)(P, D)
    scaled = ctypes.CDLL(str(library))["scaled"]
    scaled.restype = ctypes.c_double
    scaled.argtypes = [ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_void_p]
    data = ctypes.cast(gains, ctypes.c_void_p)
    low_level = scipy.LowLevelCallable(scaled, data)
    np.testing.assert_allclose(case.simulate(1.0, controller=low_level)["z1_m"], expected, rtol=0, atol=1e-15)


def test_controller_of_numba():
    numba = pytest.importorskip("numba")
    law = numba.cfunc("float64(int64, float64, float64, float64)")(lambda k, t, z, v: -557.0 * z - 13.0 * v)
    case = holdfast.Case()
    expected = case.simulate(0.5, controller=pd)["z1_m"]
    np.testing.assert_allclose(case.simulate(0.5, controller=law)["z1_m"], expected, rtol=0, atol=1e-15)


def test_faults_of_a_controller_come_out():
    case = holdfast.Case()

    def fails(k, t, displacement, velocity):
        if k == 100:
            raise ZeroDivisionError("at the hundredth sample")
        return 0.0

    with pytest.raises(ZeroDivisionError, match="hundredth"):
        case.simulate(1.0, controller=fails)
    with pytest.raises(TypeError):
        case.simulate(1.0, controller=lambda *_: "a force")
    with pytest.raises(ValueError, match="finite"):
        case.simulate(1.0, controller=lambda *_: float("nan"))
    with pytest.raises(TypeError):
        case.simulate(1.0, controller=lambda: 0.0)
    with pytest.raises(TypeError, match="admissible"):
        case.simulate(1.0, controller=3.0)
    with pytest.raises(ValueError, match="processing_delay"):
        case.with_(control={"processing_delay": 0.002}).simulate(1.0, controller=pd)
    assert case.simulate(0.1)["time_s"].size == 101


def test_own_excitation():
    case = holdfast.Case()
    f = 2 * np.pi * 10.0
    t = np.linspace(0.0, 2.0, 20_001)
    theirs = case.with_(excitation={"hold": "exact"}).simulate(1.0)
    ours = case.with_(excitation={"hold": "exact"}).simulate(1.0, excitation=(t, 0.5 * np.cos(f * t)))
    np.testing.assert_allclose(ours["z1_m"], theirs["z1_m"], rtol=0, atol=3e-6)
    called = case.simulate(1.0, excitation=lambda t: 0.5 * np.cos(f * t))
    np.testing.assert_allclose(called["z1_m"], case.simulate(1.0)["z1_m"], rtol=0, atol=5e-5)
    with pytest.raises(ValueError, match="end"):
        case.simulate(1.0, excitation=([0.0, 0.5], [0.0, 0.0]))
    for bad in ((t, t[:-1]), (t[::-1], t), (t, np.full_like(t, np.nan)), 3.0):
        with pytest.raises(ValueError):
            case.simulate(1.0, excitation=bad)


SIGNATURES = [
    (ctypes.c_double, [ctypes.c_int64, ctypes.c_double, ctypes.c_double]),
    (ctypes.c_double, [ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_int64]),
    (ctypes.c_double, [ctypes.c_int32, ctypes.c_double, ctypes.c_double, ctypes.c_double]),
    (ctypes.c_float, [ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_double]),
    (ctypes.c_double, [ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_void_p]),
    (ctypes.c_double, None),
]


@pytest.mark.parametrize("result, arguments", SIGNATURES, ids=[str(k) for k in range(len(SIGNATURES))])
def test_functions_of_ctypes_of_another_signature(result, arguments):
    law = ctypes.CDLL(None)["cos"]
    law.restype, law.argtypes = result, arguments
    with pytest.raises(TypeError, match=r"double \(int64_t k"):
        holdfast.Case().simulate(0.1, controller=law)


def test_functions_that_ctypes_wraps():
    kinds = (ctypes.c_double, ctypes.c_int64, ctypes.c_double, ctypes.c_double, ctypes.c_double)
    for wrap in (ctypes.CFUNCTYPE(*kinds), ctypes.PYFUNCTYPE(*kinds)):
        with pytest.raises(TypeError, match="the function itself"):
            holdfast.Case().simulate(0.1, controller=wrap(pd))


def test_addresses_are_no_controllers():
    class HasAddress:
        address = 4096

    for law in (4096, HasAddress(), ctypes.c_void_p(4096)):
        with pytest.raises(TypeError, match="admissible"):
            holdfast.Case().simulate(0.1, controller=law)


@pytest.mark.parametrize(
    "signature",
    [
        "float64(float64, float64, float64)",
        "float64(int32, float64, float64, float64)",
        "float64(float64, float64, float64, float64)",
        "float32(int64, float64, float64, float64)",
        "float64(int64, float64, float64, float64, float64)",
    ],
)
def test_functions_of_numba_of_another_signature(signature):
    numba = pytest.importorskip("numba")
    names = ", ".join("abcde"[: signature.count(",") + 1])
    law = numba.cfunc(signature)(eval(f"lambda {names}: 1.0"))
    with pytest.raises(TypeError, match=r"double \(int64_t k"):
        holdfast.Case().simulate(0.1, controller=law)


def test_low_level_callables_of_another_signature():
    scipy = pytest.importorskip("scipy")
    numba = pytest.importorskip("numba")
    case, data = holdfast.Case(), ctypes.cast((ctypes.c_double * 2)(P, D), ctypes.c_void_p)
    right = numba.cfunc("float64(int64, float64, float64, float64)")(lambda k, t, z, v: P * z + D * v).ctypes
    np.testing.assert_allclose(
        case.simulate(0.5, controller=scipy.LowLevelCallable(right))["z1_m"],
        case.simulate(0.5, controller=pd)["z1_m"], rtol=0, atol=1e-15,
    )  # fmt: skip
    of_one = numba.cfunc("float64(float64)")(lambda x: x).ctypes
    for law in (scipy.LowLevelCallable(of_one), scipy.LowLevelCallable(of_one, data), scipy.LowLevelCallable(right, data)):
        with pytest.raises(TypeError, match=r"double \(int64_t k"):
            case.simulate(0.1, controller=law)


def test_what_orbits_exponents_and_verdicts_do_not_take():
    case = holdfast.Case()
    for ask in (case.orbit, case.lyapunov, case.verdict):
        with pytest.raises(TypeError, match="remembers"):
            ask(controller=pd)
