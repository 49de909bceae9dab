"""Zarr stores from Python: written, filled by workers, read while they grow, damaged, refused."""

from __future__ import annotations

import filecmp
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
from conftest import assert_same, program_words, settings

import holdfast

AXES = {"backlash.width": (0, 0.003, 31), "control.sampling_period": (0.001, 0.01, 10)}
WORDS = ["--axis", "backlash.width=0.0:0.003:31", "--axis", "control.sampling_period=0.001:0.01:10"]
CHANGED = {"control.differential_gain": -14.0}


def case() -> holdfast.Case:
    return holdfast.Case().with_(CHANGED)


def files_of(folder) -> list[str]:
    root = pathlib.Path(folder)
    return sorted(str(file.relative_to(root)) for file in root.rglob("*") if file.is_file())


def assert_same_bytes(one, other) -> None:
    names = files_of(one)
    assert names == files_of(other) and names
    assert filecmp.cmpfiles(one, other, names, shallow=False) == (names, [], [])


@pytest.fixture(scope="module")
def by_program(tmp_path_factory):
    """The store that the program writes."""
    folder = tmp_path_factory.mktemp("program") / "map.zarr"
    words = [*WORDS, "--duration", "5", "--chunk", "20", "--output", str(folder), "--quiet"]
    subprocess.run([*program_words(), "sweep", *words, *settings(CHANGED)], check=True)
    return folder


def test_same_bytes_as_the_program(tmp_path, by_program):
    store = case().sweep(AXES, duration=5, chunk=20, store=tmp_path / "map.zarr")
    assert_same_bytes(store, by_program)
    assert store.path == tmp_path / "map.zarr" and store.complete and store.chunks == store.chunks_done > 10
    assert store == holdfast.open_store(by_program) or store.path != by_program
    assert store.job == "sweep" and store.shape == (31, 10) and "sweep" in repr(store)
    table = case().sweep(AXES, duration=5)
    assert store.metadata["case"] == case().to_dict() and store.metadata["options"] == table.metadata["options"]
    assert store.metadata["version"] == holdfast.__version__


@pytest.mark.parametrize(
    "job, words, ask",
    [
        (
            "stability",
            ["--radius"],
            lambda c, store: c.chart((-1000, 200, 61), (-40, 20, 50), radius=True, store=store),
        ),
        ("response", [], lambda c, store: c.response((-1000, 200, 61), (-40, 20, 50), store=store)),
    ],
)
def test_charts(tmp_path, job, words, ask):
    mine = ask(case(), tmp_path / "mine.zarr")
    words = ["--p=-1000.0:200.0:61", "--d=-40.0:20.0:50", *words, "--output", str(tmp_path / "theirs.zarr"), "--quiet"]
    subprocess.run([*program_words(), job, *words, *settings(CHANGED)], check=True)
    assert_same_bytes(mine, tmp_path / "theirs.zarr")
    assert mine.complete


def test_basins(tmp_path):
    axes = {"initial.z1": (-0.01, 0.01, 4), "initial.v1": (-0.1, 0.1, 3)}
    store = case().basins(axes, store=tmp_path / "basins.zarr")
    assert (store.path / "zarr.json").exists() and store.complete and store.shape == (4, 3)
    with pytest.raises(TypeError, match="store"):
        case().orbit(store=tmp_path / "orbit.zarr")
    with pytest.raises(TypeError, match="output"):
        case().basins(axes, store=tmp_path / "b.zarr", output=tmp_path / "b.csv")


def test_read_by_xarray_and_converted(tmp_path, by_program, program):
    pytest.importorskip("zarr"), pytest.importorskip("xarray")
    store = holdfast.open_store(by_program)
    data = store.to_xarray()
    assert data["steady_peak"].dims == ("backlash_width", "control_sampling_period")
    table = case().sweep(AXES, duration=5)
    np.testing.assert_array_equal(data["steady_peak"].values, table["steady_peak"])
    np.testing.assert_array_equal(data["backlash_width"].values, table["backlash.width"])
    assert store.convert(tmp_path / "map.csv") is None
    lines = (tmp_path / "map.csv").read_text().splitlines()
    assert len(lines) == 311
    rows = [line.split(",") for line in lines]
    assert_same(table, {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])})
    whole = store.to_table()
    assert whole.job == "sweep" and whole.axes == table.axes and whole.units == table.units
    assert whole.metadata["options"] == table.metadata["options"] and whole.metadata["case"] == table.metadata["case"]
    for name in table:
        np.testing.assert_array_equal(whole[name], table[name])


GROWING = """
    import sys, holdfast
    print("ready", flush=True)
    holdfast.Case().sweep(
        {"backlash.width": (0, 0.003, 200), "excitation.frequency": (5, 20, 100)}, "steady_peak",
        duration=20, chunk=50, store=sys.argv[1])
"""


def grow(folder) -> subprocess.Popen:
    """A Python that fills a store; some of its chunks are there."""
    process = subprocess.Popen([sys.executable, "-c", textwrap.dedent(GROWING), str(folder)], stdout=subprocess.PIPE)
    for _ in range(600):
        if (folder / "zarr.json").exists() and holdfast.open_store(folder).chunks_done > 5:
            return process
        time.sleep(0.02)
    process.kill()
    raise AssertionError("the store does not grow")


def test_read_while_it_grows_and_gone_on_with(tmp_path):
    pytest.importorskip("zarr"), pytest.importorskip("xarray"), pytest.importorskip("dask")
    folder = tmp_path / "growing.zarr"
    process = grow(folder)
    process.send_signal(signal.SIGSTOP)  # it may be complete before it is read
    try:
        store = holdfast.open_store(folder)
        before = store.chunks_done
        peak = store.to_xarray()["steady_peak"]
        assert peak.chunks is not None
        done = int(np.isfinite(peak).sum().compute())
        assert 50 * before <= done <= peak.size
        assert not store.complete
        with pytest.raises(holdfast.NoAnswer, match="missing"):
            store.convert(tmp_path / "growing.csv")
        with pytest.raises(holdfast.NoAnswer, match="missing"):
            store.to_table()
    finally:
        process.kill()
        process.wait()
    kept = store.chunks_done
    axes = {"backlash.width": (0, 0.003, 200), "excitation.frequency": (5, 20, 100)}
    seen = []
    again = holdfast.Case().sweep(
        axes, "steady_peak", duration=20, chunk=50, store=folder, progress=lambda done, all_: seen.append(done)
    )
    assert again == store and again.complete and again.chunks > kept
    assert np.all(np.isfinite(again.to_xarray()["steady_peak"].values))


def test_ctrl_c(tmp_path):
    folder = tmp_path / "growing.zarr"
    for ask in ("", "client=2, "):
        code = GROWING.replace("import sys", "import signal, sys").replace("store=", ask + "store=")
        code = textwrap.dedent(code).replace(
            "print(", "signal.signal(signal.SIGINT, signal.default_int_handler); print("
        )
        process = subprocess.Popen(
            [sys.executable, "-c", code.replace("200)", "5000)"), str(folder)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        process.stdout.readline()
        time.sleep(1.5)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=60)[1].decode()
        assert "KeyboardInterrupt" in errors and time.monotonic() - begin < 3.0
        assert holdfast.open_store(folder).chunks_done > 0
        assert not [name for name in files_of(folder) if ".tmp" in name]


# -- workers -----------------------------------------------------------------------------------------


def test_two_processes(tmp_path, by_program):
    seen = []
    store = case().sweep(
        AXES, duration=5, chunk=20, store=tmp_path / "map.zarr", client=2, progress=lambda *done: seen.append(done)
    )
    assert_same_bytes(store, by_program)
    assert seen[-1][0] == seen[-1][1] == len(seen)


def test_processes_that_begin_at_once(tmp_path, by_program):
    for attempt in range(4):
        folder = tmp_path / f"{attempt}.zarr"
        words = [*WORDS, "--duration", "5", "--chunk", "20", "--output", str(folder), "--threads", "1", "--quiet"]
        command = [*program_words(), "sweep", *words, *settings(CHANGED)]
        processes = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for _ in range(6)]
        for process in processes:
            errors = process.communicate()[1]
            assert process.returncode == 0, errors
        assert_same_bytes(folder, by_program)


LONG = {"backlash.width": (0, 0.003, 100), "control.sampling_period": (0.001, 0.01, 10)}


def killed_while_filling(start, pids) -> None:
    """Kills a worker as soon as some chunks are there."""
    import threading

    def kill():
        while not start():
            time.sleep(0.01)
        os.kill(pids()[0], signal.SIGKILL)

    threading.Thread(target=kill, daemon=True).start()


def chunks_are_there(folder):
    def there():
        try:
            return holdfast.open_store(folder).chunks_done > 5
        except (ValueError, FileNotFoundError):
            return False

    return there


def test_a_process_that_is_killed(tmp_path):
    from holdfast import _parts

    folder, processes = tmp_path / "map.zarr", []
    begin = _parts._Process._begin

    def watched(self):
        begin(self)
        processes.append(self._process.pid)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_parts._Process, "_begin", watched)
        killed_while_filling(chunks_are_there(folder), lambda: processes)
        store = case().sweep(LONG, "steady_peak", duration=100, chunk=20, store=folder, client=2)
    assert len(processes) == 4  # two, one in place of the lost one, and one that sums up
    assert_same_bytes(store, case().sweep(LONG, "steady_peak", duration=100, chunk=20, store=tmp_path / "alone.zarr"))


def test_a_part_that_kills_every_process(tmp_path):
    from holdfast import _parts

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_parts.sys, "executable", "/bin/false")
        with pytest.raises(ChildProcessError, match="lost"):
            case().sweep(AXES, store=tmp_path / "map.zarr", client=2)


@pytest.fixture(scope="module")
def client():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
        with distributed.Client(cluster) as client:
            yield client


def test_dask(tmp_path, by_program, client):
    store = case().sweep(AXES, duration=5, chunk=20, store=tmp_path / "map.zarr", client=client)
    assert_same_bytes(store, by_program)
    with pytest.raises(ValueError, match="another computation"):
        case().sweep(AXES, duration=6, chunk=20, store=tmp_path / "map.zarr", client=client)


def test_dask_in_threads(tmp_path, by_program):
    distributed = pytest.importorskip("distributed")
    with distributed.Client(processes=False, n_workers=1, threads_per_worker=2, dashboard_address=":0") as client:
        store = case().sweep(AXES, duration=5, chunk=20, store=tmp_path / "map.zarr", client=client)
    assert_same_bytes(store, by_program)


def test_a_worker_of_dask_that_is_killed(tmp_path, client):
    folder = tmp_path / "map.zarr"
    before = set(client.run(os.getpid).values())
    killed_while_filling(chunks_are_there(folder), lambda: list(before))
    store = case().sweep(LONG, "steady_peak", duration=100, chunk=20, store=folder, client=client)
    assert store.complete
    client.wait_for_workers(2)
    assert set(client.run(os.getpid).values()) != before
    assert_same_bytes(store, case().sweep(LONG, "steady_peak", duration=100, chunk=20, store=tmp_path / "alone.zarr"))


def test_dask_ends_with_its_caller(tmp_path, client):
    def enough(done, total):
        raise RuntimeError("enough")

    axes = {"backlash.width": (0, 0.003, 20000), "control.sampling_period": (0.001, 0.01, 10)}
    with pytest.raises(RuntimeError, match="enough"):
        case().sweep(axes, "steady_peak", duration=10, store=tmp_path / "map.zarr", client=client, progress=enough)
    time.sleep(2.0)
    kept = holdfast.open_store(tmp_path / "map.zarr").chunks_done
    time.sleep(1.0)
    assert holdfast.open_store(tmp_path / "map.zarr").chunks_done == kept > 0


def test_parts_by_hand(tmp_path, by_program):
    for number in (3, 1, 2):
        store = case().sweep(AXES, duration=5, chunk=20, store=tmp_path / "map.zarr", part=(number, 3))
    assert store.complete
    assert_same_bytes(store, by_program)


def test_warnings_of_all_cells(tmp_path):
    axes = {"control.differential_gain": (-400, -300, 4)}
    for client in (None, 2):
        with pytest.warns(holdfast.PlausibilityWarning, match="of 4 cells"):
            holdfast.Case().sweep(axes, duration=5, store=tmp_path / f"{client}.zarr", client=client)


# -- damage and refusals -----------------------------------------------------------------------------


@pytest.mark.parametrize("client", [None, 2])
def test_damage(tmp_path, by_program, client):
    store = case().sweep(AXES, duration=5, chunk=20, store=tmp_path / "map.zarr")
    file = sorted((store.path / "steady_peak").glob("c*"))[3]
    file.write_bytes(file.read_bytes()[:-3] + b"xyz")
    with pytest.raises(holdfast.NoAnswer, match="damaged"):
        store.convert(tmp_path / "map.csv")
    with pytest.warns(holdfast.PlausibilityWarning, match="damaged; this chunk is computed anew"):
        case().sweep(AXES, duration=5, chunk=20, store=store.path, resume=True, client=client)
    assert_same_bytes(store, by_program)


def test_refusals(tmp_path, by_program):
    for place in (tmp_path, __file__):
        with pytest.raises(ValueError, match="no Zarr 3 store"):
            holdfast.open_store(place)
    with pytest.raises(FileNotFoundError, match="missing.zarr"):
        holdfast.open_store(tmp_path / "missing.zarr")
    (tmp_path / "zarr.json").write_text('{"attributes": {"holdfast": 1}}')
    with pytest.raises(ValueError, match="no Zarr 3 store"):
        holdfast.open_store(tmp_path)
    (tmp_path / "zarr.json").write_text("[1")
    with pytest.raises(ValueError, match="no Zarr 3 store"):
        holdfast.open_store(tmp_path)
    with pytest.raises(TypeError):
        holdfast.open_store(None)
    with pytest.raises(ValueError, match=r"\.zarr"):
        case().sweep(AXES, store=tmp_path / "map.nc")
    with pytest.raises(TypeError, match=r"\.zarr"):
        case().sweep(AXES, store=3)
    with pytest.raises(ValueError, match="another computation"):
        case().sweep(AXES, duration=6, store=by_program)
    (tmp_path / "full.zarr").mkdir()
    (tmp_path / "full.zarr" / "letter.txt").write_text("dear")
    with pytest.raises(OSError, match="this name exists and is no store"):
        case().sweep(AXES, store=tmp_path / "full.zarr")
    with pytest.raises(OSError, match="missing.zarr"):
        holdfast.convert(tmp_path / "missing.zarr", tmp_path / "x.csv")
    with pytest.raises(ValueError, match="part"):
        case().sweep(AXES, store=tmp_path / "p.zarr", part=3)
    with pytest.raises(ValueError, match="1 <= K <= N"):
        case().sweep(AXES, store=tmp_path / "p.zarr", part=(4, 3))
    with pytest.raises(ValueError, match="part"):
        case().sweep(AXES, part=(1, 3))
    for client in ("threads", 2.5, True):
        with pytest.raises(TypeError, match="number of processes"):
            case().sweep(AXES, store=tmp_path / "p.zarr", client=client)
    with pytest.raises(ValueError, match="from 1 on"):
        case().sweep(AXES, store=tmp_path / "p.zarr", client=0)
    with pytest.raises(ValueError, match="store"):
        case().sweep(AXES, client=2)
    with pytest.raises(ValueError, match=r"axes backlash\.nothing.*unknown key"):
        case().sweep({"backlash.nothing": (0, 1, 3)}, store=tmp_path / "p.zarr", client=2)
    assert not (tmp_path / "p.zarr").exists()


def test_a_plant_of_ones_own_has_no_store(tmp_path):
    from test_plant import chain

    own = holdfast.plant(chain(), relative=1).case()
    with pytest.raises(ValueError, match="plant of your own"):
        own.chart((-1, 1, 3), (-1, 1, 3), store=tmp_path / "own.zarr")
    assert not (tmp_path / "own.zarr").exists()


def test_stores_and_cases_are_pickled(by_program):
    store = holdfast.open_store(by_program)
    assert pickle.loads(pickle.dumps(store)) == store
    assert pickle.loads(pickle.dumps(case())) == case()
