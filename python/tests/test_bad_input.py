"""Whatever is handed over: an error that says what is admissible, never a crash, never a hang."""

from __future__ import annotations

import multiprocessing
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import holdfast
from holdfast import _core

A = np.array([[0.0, 1.0], [-400.0, -0.5]])
B = np.array([0.0, 2.0])
C = np.array([1.0, 0.0])


@pytest.mark.parametrize(
    "values, words",
    [
        ({"control": {"sampling_perio": 1.0}}, "sampling_period"),
        ({"control": {"sampling_period": -1.0}}, "greater than 0 s"),
        ({"control": {"sampling_period": float("nan")}}, "control.sampling_period"),
        ({"control": {"sampling_period": float("inf")}}, "control.sampling_period"),
        ({"control": {"sampling_period": "soon"}}, "control.sampling_period"),
        ({"control": {"sampling_period": None}}, "control.sampling_period"),
        ({"control": {"sampling_period": 1j}}, "control.sampling_period"),
        ({"control": {"sampling_period": [1.0]}}, "control.sampling_period"),
        ({"control": {"sampling_period": object()}}, "control.sampling_period"),
        ({"control": 3.0}, "control"),
        ({"backlash": {"law": "none\n[control]\nsampling_period = 2"}}, "backlash.law"),
        ({"nothing": {"here": 1.0}}, "nothing"),
    ],
)
def test_values_of_a_case(values, words):
    with pytest.raises(ValueError, match=words):
        holdfast.Case(values)
    with pytest.raises(ValueError, match=words):
        holdfast.Case().with_(values)


@pytest.mark.parametrize("source", [3, 3.5, ["control"], np.zeros(3), {1: 2}])
def test_sources_of_a_case(source):
    with pytest.raises((TypeError, ValueError)):
        holdfast.Case(source)


def test_files_of_a_case(tmp_path):
    with pytest.raises(OSError):
        holdfast.Case(tmp_path / "none.toml")
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="UTF-8"):
        holdfast.Case(tmp_path / "bytes.toml")
    (tmp_path / "bad.toml").write_text("[control\n")
    with pytest.raises(ValueError, match="bad.toml:1"):
        holdfast.Case(tmp_path / "bad.toml")
    with pytest.raises(OSError):
        holdfast.Case(tmp_path)


RANGES = [
    (1.0, 2.0),
    (2.0, 1.0, 5),
    (0.0, 1.0, 0),
    (0.0, 1.0, -3),
    (0.0, 1.0, 2.5),
    (0.0, float("nan"), 3),
    (0.0, float("inf"), 3),
    ("a", "b", 3),
    np.array([0.0, 1.0, 3.0]),
    np.array([3.0, 2.0, 1.0]),
    np.array([0.0, np.nan, 1.0]),
    np.zeros((2, 2)),
    np.array([]),
    np.array(["a", "b"]),
    np.array([0.0, 1.0j]),
    "0:1:3",
    {"min": 0},
    object(),
]


@pytest.mark.parametrize("over", RANGES, ids=[str(k) for k in range(len(RANGES))])
@pytest.mark.filterwarnings("ignore::numpy.exceptions.ComplexWarning")
def test_ranges(over):
    case = holdfast.Case()
    for ask in (lambda: case.chart(over), lambda: case.response(over), lambda: case.max_delay(over)):
        with pytest.raises((ValueError, TypeError)):
            ask()


def test_strided_arrays_are_what_they_show():
    case = holdfast.Case()
    expected = case.chart(np.linspace(-1000, 200, 7), np.linspace(-40, 20, 5), radius=True)["spectral_radius"]
    p = np.linspace(-1000, 200, 13)[::2]
    d = np.asfortranarray(np.tile(np.linspace(-40, 20, 5), (3, 1))).T[:, 1]
    np.testing.assert_array_equal(case.chart(p, d, radius=True)["spectral_radius"], expected)
    wide = np.zeros((4, 4))
    wide[::2, ::2] = A
    plain, strided = (
        holdfast.plant((A, B, C)),
        holdfast.plant((wide[::2, ::2], np.stack([B, B])[:, ::1].T[:, 0], C[::-1][::-1])),
    )
    np.testing.assert_array_equal(strided.state_matrix, plain.state_matrix)
    whole = holdfast.plant((np.array([[0, 1], [-400, -1]]), np.array([0, 2]), np.array([1, 0], dtype=np.int8)))
    assert whole.case().chart(0.0, 0.0)["stable"].shape == (1, 1)
    big_endian = holdfast.plant((A.astype(">f8"), B.astype(np.float32), C))
    np.testing.assert_array_equal(big_endian.state_matrix, A)


BAD_PLANTS = [
    (A, B),
    (A, B, C, 0.0),
    (A[:, :1], B, C),
    (A, B[:1], C),
    (A, B, C[:1]),
    (np.full((2, 2), np.nan), B, C),
    (A, np.array([0.0, np.inf]), C),
    (A + 0j, B, C),
    (A, np.zeros(2), C),
    (A, B, np.array([0.0, 1.0])),
    (np.zeros((0, 0)), np.zeros(0), np.zeros(0)),
    ("A", "B", "C"),
    (None, None, None),
    A,
    7,
    None,
]


@pytest.mark.parametrize("system", BAD_PLANTS, ids=[str(k) for k in range(len(BAD_PLANTS))])
def test_plants(system):
    with pytest.raises((ValueError, TypeError)):
        holdfast.plant(system)


def test_ports_of_a_plant():
    for options in (
        {"command": 1},
        {"command": -1},
        {"command": 0.0},
        {"displacement": 3},
        {"velocity": 1},
        {"excitation": 5},
    ):
        with pytest.raises(ValueError, match="admissible"):
            holdfast.plant((A, B, C), **options)
    for options in (
        {"relative": [1.0]},
        {"relative": [0.0, 0.0]},
        {"initial_state": [1.0]},
        {"initial_state": [np.nan, 0.0]},
        {"lifts": ([1.0], [1.0])},
    ):
        with pytest.raises(ValueError):
            holdfast.plant((A, B, C), **options)


def test_systems_that_are_none_to_sample():
    control = pytest.importorskip("control")
    with pytest.raises(ValueError, match="discrete"):
        holdfast.plant(control.ss(A, B[:, None], C, 0, 0.01))
    with pytest.raises(ValueError, match="direct transmission"):
        holdfast.plant(control.ss(A, B[:, None], C, 1.0))
    with pytest.raises(ValueError):
        holdfast.plant(control.tf([1.0], [1.0, 2.0]))


@pytest.mark.parametrize(
    "f, h",
    [
        ([1.0], [1.0]),
        ([1.0, 2.0], [1.0]),
        ([2.0, 1.0], [1.0, 1.0]),
        ([0.0, 1.0], [1.0, 1.0]),
        ([1.0, np.nan], [1.0, 1.0]),
        ([1.0, 2.0], [1.0, np.inf]),
        ("ab", [1.0, 1.0]),
        ([[1.0, 2.0]], [[1.0, 1.0]]),
    ],
)
def test_frequency_data(f, h):
    with pytest.raises(ValueError):
        holdfast.frequency_response(f, h)


def test_options():
    case = holdfast.Case()
    for ask in (
        lambda: case.simulate(-1.0),
        lambda: case.simulate("long"),
        lambda: case.simulate(float("nan")),
        lambda: case.simulate(1.0, switching="sometimes"),
        lambda: case.simulate(1.0, kick=3.0),
        lambda: case.simulate(1.0, threads=-1),
        lambda: case.simulate(1.0, instructions="mmx"),
        lambda: case.orbit(max_period=0),
        lambda: case.orbit(max_period=[1, 2]),
        lambda: case.basins({"initial.z1": (0, 1, 2)}),
        lambda: case.sweep({"nothing.here": (0, 1, 2)}),
        lambda: case.sweep({"backlash.width": (0, 1, 2)}, "no_metric"),
        lambda: case.sweep([("backlash.width", (0, 1, 2))]),
        lambda: case.stable_intervals([]),
        lambda: case.boundary(3.0),
        lambda: case.chart(progress=3),
        lambda: case.chart(instructions="mmx"),
        lambda: case.chart((0, 1, 3), (0, 1, 10_000_000)),
        lambda: case.simulate(1e6),
    ):
        with pytest.raises((ValueError, TypeError)):
            ask()
    with pytest.raises(TypeError, match="no option"):
        case.orbit(max_perio=3)


def test_no_answer():
    with pytest.raises(holdfast.NoAnswer, match="stabilises"):
        holdfast.Case().stable_intervals(p=1e6)
    assert issubclass(holdfast.NoAnswer, RuntimeError)


def test_handles_that_were_never_made():
    for kind in (_core.Case, _core.OwnPlant, _core.PlantArrays):
        empty = kind.__new__(kind)
        with pytest.raises(TypeError):
            _core.run_job(empty, ["orbit"])
    made = holdfast.Case.__new__(holdfast.Case)
    with pytest.raises(AttributeError):
        made.orbit()
    for arguments in ([], ["nothing"], ["--help="], [""]):
        with pytest.raises(ValueError):
            _core.run_job(holdfast.Case()._core, arguments)
    with pytest.raises(TypeError):
        _core.run_job(None, ["orbit"])


def test_threads_at_once():
    case = holdfast.Case()
    expected = case.chart(radius=True)["spectral_radius"]
    faults: list[BaseException] = []

    def work(number):
        try:
            for _ in range(10):
                np.testing.assert_array_equal(case.chart(radius=True)["spectral_radius"], expected)
                assert case.orbit().period_samples == 100
                own = holdfast.Case(control={"differential_gain": -5.0 - number})
                assert own.simulate(0.1)["time_s"].size == 101
                assert case.simulate(0.05, controller=lambda k, t, z, v: 0.0).rows == 51
        except BaseException as fault:
            faults.append(fault)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert not faults and not any(thread.is_alive() for thread in threads)


def in_child(question):
    """What a forked child comes to, within twenty seconds."""
    parent, child = multiprocessing.get_context("fork").Pipe()

    def work():
        try:
            question()
            child.send("answer")
        except BaseException as fault:
            child.send(f"{type(fault).__name__}: {fault}")

    process = multiprocessing.get_context("fork").Process(target=work)
    process.start()
    try:
        assert parent.poll(20), "the child hangs"
        return parent.recv()
    finally:
        process.kill()
        process.join()


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_forked_process():
    holdfast.Case().chart()
    found = in_child(lambda: holdfast.Case().chart())
    assert found.startswith("RuntimeError") and "forked" in found and "spawn" in found
    assert holdfast.Case().chart().rows == 121 * 121


def test_forked_process_that_is_the_first_to_compute():
    code = """
        import os, holdfast
        case = holdfast.Case()
        child = os.fork()
        if child == 0:
            os._exit(0 if case.chart().rows == 14641 and case.orbit().period_samples == 100 else 1)
        assert os.waitpid(child, 0)[1] == 0
        assert case.chart().rows == 14641
    """
    subprocess.run([sys.executable, "-W", "ignore", "-c", textwrap.dedent(code)], check=True, timeout=60)


def test_fork_while_another_thread_computes():
    case = holdfast.Case()
    thread = threading.Thread(target=lambda: case.simulate(3000.0))
    thread.start()
    try:
        assert in_child(lambda: case.orbit()).startswith("RuntimeError")
    finally:
        thread.join()


def interrupted(question: str) -> float:
    """Seconds from a Ctrl-C to the end of a Python that asks a long question."""
    code = f"""
        import signal, sys, holdfast
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background work ignores it
        case = holdfast.Case()
        print("ready", flush=True)
        try:
            {question}
        except KeyboardInterrupt:
            case.orbit()  # goes on
            print("interrupted", flush=True)
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.7)
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)
    try:
        output, errors = process.communicate(timeout=60)
    finally:
        process.kill()
    assert output == "interrupted\n", errors
    return time.monotonic() - begin


@pytest.mark.parametrize(
    "question",
    [
        "case.simulate(5e6, from_=4.9e6)",
        "case.chart((-1000, 200, 200000), (-40, 20, 2000), radius=True)",
        "case.lyapunov(duration=5e6)",
        "case.sweep({'backlash.width': (0, 1e-3, 1000), 'excitation.frequency': (5, 20, 1000)}, duration=100)",
        "case.simulate(1e5, controller=lambda k, t, z, v: 0.0)",
    ],
)
def test_ctrl_c(question):
    assert interrupted(question) < 1.5


def test_progress():
    seen = []
    holdfast.Case().chart(
        (-1000, 200, 60000), (-40, 20, 500), radius=True, progress=lambda done, total: seen.append((done, total))
    )
    assert seen and all(0 <= done <= total == 60000 for done, total in seen)
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)

    def fails(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        holdfast.Case().chart((-1000, 200, 200000), (-40, 20, 500), radius=True, progress=fails)
    assert holdfast.Case().chart(progress=True).rows == 121 * 121


def test_memory_is_given_back():
    resource = pytest.importorskip("resource")
    case = holdfast.Case()

    def work():
        for _ in range(30):
            case.simulate(100.0)
            case.chart((-1000, 200, 500), (-40, 20, 500), radius=True)

    work()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    work()
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 60_000  # kB


def test_environment_is_left_alone():
    before = signal.getsignal(signal.SIGINT)
    holdfast.Case().chart((-1000, 200, 3000), (-40, 20, 3000), radius=True)
    assert signal.getsignal(signal.SIGINT) is before


def within(seconds, code):
    """What a new interpreter prints that is ended where it takes longer."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", textwrap.dedent(code)], capture_output=True, text=True, timeout=seconds
    )
    return done.stdout + done.stderr


CALLED_AGAIN = {
    "controller": "case.simulate(0.1, controller=lambda k, t, z, v: again())",
    "progress": "case.chart((-1000, 200, 200000), (-40, 20, 2000), radius=True, progress=lambda *_: again())",
}


@pytest.mark.parametrize("question", CALLED_AGAIN.values(), ids=list(CALLED_AGAIN))
@pytest.mark.parametrize("again", ["case.orbit()", "case.chart()", "case.chart((0, 1, 3), (0, 1, 3))"])
def test_a_callback_that_calls_the_package(question, again):
    code = f"""
        import holdfast
        case = holdfast.Case()
        case.chart()
        again = lambda: {again}
        try:
            {question}
        except RuntimeError as fault:
            print(fault)
        print(case.orbit().period_samples)
    """
    told = within(20, code)
    assert "calls holdfast again" in told and told.endswith("100\n"), told


CALLBACKS_THAT_HANG = [
    "case.simulate(1.0, controller=lambda k, t, z, v: __import__('time').sleep(1000.0))",
    "case.simulate(1.0, controller=lambda k, t, z, v: [0.0 for _ in __import__('itertools').count() if False][0])",
    "case.chart((-1000, 200, 200000), (-40, 20, 2000), radius=True, progress=lambda *_: __import__('time').sleep(1000.0))",
    "case.simulate(1.0, excitation=lambda t: __import__('time').sleep(1000.0))",
    "case.simulate(1e5, controller=lambda k, t, z, v: 0.0, progress=lambda *_: None)",
]


@pytest.mark.parametrize("question", CALLBACKS_THAT_HANG)
def test_ctrl_c_in_a_callback(question):
    assert interrupted(question) < 1.5


def test_a_callback_that_waits_for_a_thread_that_computes():
    question = (
        "import threading; other = threading.Thread(target=case.orbit, daemon=True); "
        "case.simulate(1.0, controller=lambda *_: (other.ident or other.start(), other.join(), 0.0)[-1])"
    )
    assert interrupted(question) < 1.5


@pytest.mark.parametrize("threads", [-1, 2.5, True, "2", 1025])
def test_threads(threads):
    case = holdfast.Case()
    asked = (case.chart, case.orbit, case.simulate, case.response, case.reduce, case.proved_chart,
             lambda **how: case.sweep({"backlash.width": (0, 1e-3, 2)}, **how))  # fmt: skip
    for ask in asked:
        with pytest.raises(ValueError, match="threads = "):
            ask(threads=threads)


def test_errors_speak_python(tmp_path):
    case = holdfast.Case()
    asked = [
        lambda: case.orbit(max_period=0),
        lambda: case.simulate(-1.0),
        lambda: case.with_({"control.sampling_period": -1.0}),
        lambda: case.with_({"control.samplin_period": 1.0}),
        lambda: holdfast.Case(control={"sampling_period": "soon"}),
        lambda: case.sweep({"nothing.here": (0, 1, 2)}),
        lambda: case.sweep({"backlash.width": (0, 1, 2)}, "no_metric"),
        lambda: case.lyapunov(history=True, largest=True),
        lambda: case.stable_intervals(p=1e6),
        lambda: case.section(1.0, from_=2.0),
        lambda: case.fit(tmp_path / "none.csv"),
    ]
    for ask in asked:
        with pytest.raises((ValueError, RuntimeError, OSError)) as told:
            ask()
        assert "--" not in str(told.value), told.value
    with pytest.raises(ValueError, match="max_period"):
        case.orbit(max_period=0)
    with pytest.raises(ValueError, match="control.sampling_period = -1.0"):
        case.with_({"control.sampling_period": -1.0})


def test_files_that_cannot_be_read_or_written(tmp_path):
    case = holdfast.Case()
    asked = [
        lambda: case.fit(tmp_path / "none.csv"),
        lambda: case.simulate(0.1, output=tmp_path / "none" / "motion.csv"),
        lambda: case.with_(excitation={"record": str(tmp_path / "none.csv")}),
        lambda: holdfast.open_store(tmp_path / "none.zarr"),
        lambda: holdfast.Case(tmp_path / "none.toml"),
    ]
    for ask in asked:
        with pytest.raises(OSError):
            ask()


def test_words_that_are_nearly_right():
    case = holdfast.Case()
    for ask, word in (
        (lambda: case.lyapunov(durration=3), "did you mean duration"),
        (lambda: case.chart(radii=True, thread=2), "thread"),
        (lambda: case.simulate(swithing="exact"), "did you mean switching"),
        (lambda: case.orbit_ends("backlash.width", (0, 1e-3), max_perod=3), "orbit_ends .*did you mean max_period"),
        (lambda: case.verdict(ouput="a.csv"), "did you mean output"),
    ):
        with pytest.raises(TypeError, match=word):
            ask()
    for make in (
        lambda: holdfast.Case(controll={"sampling_period": 1e-3}),
        lambda: case.with_(controll={"sampling_period": 1e-3}),
        lambda: holdfast.Case({"controll": {"sampling_period": 1e-3}}),
    ):
        with pytest.raises(ValueError, match="did you mean .?control"):
            make()
