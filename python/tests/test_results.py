"""What comes back: cases, tables, their other containers and their pictures."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import holdfast


def test_ways_to_a_case(tmp_path):
    file = tmp_path / "my.toml"
    file.write_text("[control]\nsampling_period = 0.002\n")
    ways = [
        holdfast.Case(file),
        holdfast.Case(str(file)),
        holdfast.Case({"control": {"sampling_period": 0.002}}),
        holdfast.Case({"control.sampling_period": 0.002}),
        holdfast.Case(control={"sampling_period": 0.002}),
        holdfast.Case().with_({"control.sampling_period": 0.002}),
        holdfast.Case().with_(control={"sampling_period": np.float64(0.002)}),
        holdfast.Case.from_toml("[control]\nsampling_period = 0.002\n"),
        holdfast.Case(holdfast.Case(), control={"sampling_period": 0.002}),
    ]
    for case in ways:
        assert case["control.sampling_period"] == 0.002
        assert case["control"]["proportional_gain"] == -557.0
        assert case == ways[0] and hash(case) == hash(ways[0])
    assert ways[0] != holdfast.Case()
    assert holdfast.Case.from_toml(ways[0].to_toml()) == ways[0]
    assert "0.002" in repr(ways[0]) and "sampling_period" in ways[0]._repr_html_()
    for copied in (pickle.loads(pickle.dumps(ways[0])), copy.copy(ways[0])):
        assert copied["control.sampling_period"] == 0.002
    with pytest.raises(KeyError):
        ways[0]["control.nothing"]


def test_devices():
    case = holdfast.Case(
        conductor={"name": "Drake", "span": 300.0, "sag": 6.0},
        device={"kind": "dashpot", "position": 1.5, "damping": 300.0},
    )
    assert case["device.1.damping"] == 300.0
    more = case.with_(device=[{"kind": "stiffness", "position": 3.0, "stiffness": 1e4}])
    assert more["device.2.kind"] == "stiffness"
    assert more.with_({"device.1.damping": 200.0})["device.1.damping"] == 200.0


def test_a_table_is_a_mapping():
    motion = holdfast.Case().simulate(1.0)
    assert list(motion)[0] == "time_s" and len(motion) == 7 and "z1_m" in motion
    assert motion["time_s"].dtype == np.float64 and motion["in_backlash"].dtype == np.int64
    assert motion["time_s"].shape == (1001,) and motion.rows == 1001
    assert motion.units["v1_m_per_s"] == "m/s" and "conductor" in motion.descriptions["z1_m"]
    assert motion.metadata["job"] == "simulate" and motion.metadata["case"]["control"]["sampling_period"] == 0.001
    assert motion.metadata["version"] == holdfast.__version__
    np.testing.assert_array_equal(motion.z1_m, motion["z1_m"])
    assert "simulate" in repr(motion) and "z1_m" in motion._repr_html_()
    with pytest.raises(KeyError, match="time_s"):
        motion["z3"]
    with pytest.raises(AttributeError):
        motion.z3
    again = pickle.loads(pickle.dumps(motion))
    np.testing.assert_array_equal(again["z1_m"], motion["z1_m"])
    assert holdfast.Case().reduce().value("conductor_mass") > 0.0


def test_arrays_outlive_their_table():
    values = holdfast.Case().chart((-1000, 200, 300), (-40, 20, 300), radius=True)["spectral_radius"]
    for _ in range(5):
        holdfast.Case().chart((-1000, 200, 300), (-40, 20, 300), radius=True)
    assert np.all(np.isfinite(values)) and values.flags.writeable


def test_xarray_and_pandas():
    pytest.importorskip("xarray"), pytest.importorskip("pandas")
    chart = holdfast.Case().chart((-1000, 200, 7), (-40, 20, 5), radius=True)
    data = chart.to_xarray()
    assert data["spectral_radius"].dims == ("proportional_gain", "differential_gain")
    assert data["proportional_gain"].attrs["units"] == "N/m" and data["stable"].dtype == bool
    frame = chart.to_pandas()
    assert frame.shape == (35, 2) and frame.index.names == ["proportional_gain", "differential_gain"]
    assert frame["spectral_radius"].iloc[5] == chart["spectral_radius"][1, 0]
    motion = holdfast.Case().simulate(0.1).to_xarray()
    assert motion["z1_m"].dims == ("time_s",) and motion["z1_m"].attrs["long_name"].startswith("displacement")
    assert float(motion["z1_m"].sel(time_s=0.05, method="nearest")) != 0.0
    assert holdfast.Case().boundary().to_xarray().sizes["row"] > 10


PICTURES = {
    "chart": lambda case: case.chart((-1000, 200, 7), (-40, 20, 5)),
    "radius": lambda case: case.chart((-1000, 200, 7), (-40, 20, 5), radius=True),
    "boundary": lambda case: case.boundary(),
    "response": lambda case: case.response((-1000, 200, 7), (-40, 20, 5)),
    "simulate": lambda case: case.simulate(1.0),
    "spectrum": lambda case: case.spectrum(4.0),
    "section": lambda case: case.section(4.0, from_=2.0),
    "diagram": lambda case: case.diagram("backlash.width", (0, 0.001, 3), transient=1, strobes=5),
    "basins": lambda case: case.basins({"initial.z1": (-0.01, 0.01, 4), "initial.v1": (-0.1, 0.1, 3)}),
    "exponents": lambda case: case.lyapunov(duration=2, history=True),
    "sweep": lambda case: case.sweep(
        {"backlash.width": (0, 1e-3, 3), "excitation.frequency": [5, 10]}, "verdict", duration=2
    ),
    "curve": lambda case: case.sweep({"backlash.width": (0, 1e-3, 3)}, "steady_peak", duration=2),
    "dampings": lambda case: case.with_({"plant.model": "string", "plant.modes": 10}).modal_damping(count=5),
    "statics": lambda case: case.statics((-1, 1, 5)),
}


@pytest.mark.parametrize("name", PICTURES)
@pytest.mark.filterwarnings("ignore::holdfast.PlausibilityWarning")
def test_picture(no_gui, name):
    ax = PICTURES[name](holdfast.Case()).plot()
    ax.figure.canvas.draw()
    assert ax.get_xlabel()
    other = no_gui.subplots()[1]
    assert PICTURES[name](holdfast.Case()).plot(other) is other


def test_picture_in_the_phase_plane(no_gui):
    ax = holdfast.Case().simulate(1.0).plot(kind="phase", color="black")
    assert "z1" in ax.get_xlabel() and "v1" in ax.get_ylabel()
    with pytest.raises(ValueError, match="column"):
        holdfast.Case().simulate(0.1).plot(column="nothing")


def test_files(tmp_path):
    case = holdfast.Case()
    assert case.simulate(0.1, output=tmp_path / "motion.csv") is None
    rows = (tmp_path / "motion.csv").read_text().splitlines()
    assert rows[0].startswith("time_s") and len(rows) == 102
    assert (tmp_path / "motion.csv-metadata.json").exists()
    with pytest.raises(ValueError):
        case.simulate(0.1, output=tmp_path / "motion.xyz")


def test_warnings_are_python_warnings():
    with pytest.warns(holdfast.PlausibilityWarning):
        holdfast.Case(control={"sampling_period": 1.0}).chart(-557.0, -13.0)
    with pytest.warns(holdfast.PlausibilityWarning):
        holdfast.Case(control={"sampling_period": 1.0}).response(-557.0, -13.0)


def test_every_method_says_what_it_does():
    for name in dir(holdfast.Case):
        if not name.startswith("_"):
            assert getattr(holdfast.Case, name).__doc__, name


def test_nothing_is_printed_and_little_is_imported():
    code = (
        "import sys, warnings; warnings.simplefilter('ignore'); import holdfast; c = holdfast.Case()\n"
        "c.chart(); c.verdict(); c.orbit(); c.simulate(1); c.sweep({'backlash.width': (0, 1e-3, 3)}, duration=1)\n"
        "for name in ('xarray', 'pandas', 'matplotlib', 'scipy', 'control', 'tqdm'): assert name not in sys.modules, name\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_the_packaged_program():
    done = subprocess.run([sys.executable, "-m", "holdfast", "--version"], capture_output=True, text=True)
    assert done.returncode == 0 and holdfast.__version__ in done.stdout
    done = subprocess.run(
        [sys.executable, "-m", "holdfast", "simulate", "--duration", "x"], capture_output=True, text=True
    )
    assert done.returncode == 2 and done.stderr.startswith("holdfast: ")


def own_plant(stiffness: float = 400.0) -> holdfast.Plant:
    a = np.array([[0.0, 1.0], [-stiffness, -0.5]])
    return holdfast.plant((a, np.array([0.0, 2.0]), np.array([1.0, 0.0])), initial_state=[0.01, 0.0])


@pytest.mark.parametrize("kind", ["cable", "own"])
def test_a_case_is_a_value(kind):
    def made(gain: float) -> holdfast.Case:
        if kind == "cable":
            return holdfast.Case(control={"differential_gain": gain})
        return own_plant().case(control={"differential_gain": gain})

    case = made(-2.0)
    assert case == made(-2.0) and hash(case) == hash(made(-2.0)) and case != made(-3.0) and case != 3
    for again in (copy.copy(case), copy.deepcopy(case), pickle.loads(pickle.dumps(case)), case.with_()):
        assert again == case and hash(again) == hash(case)
        np.testing.assert_array_equal(again.simulate(0.2)["z1_m"], case.simulate(0.2)["z1_m"])
    assert {case: 1}[made(-2.0)] == 1


def test_cases_of_different_plants_differ():
    assert own_plant().case() != own_plant(401.0).case() and own_plant() != own_plant(401.0)
    assert own_plant().case() != holdfast.Case()
    assert pickle.loads(pickle.dumps(own_plant())) == own_plant() == copy.deepcopy(own_plant())


def test_a_plant_never_changes():
    a = np.array([[0.0, 1.0], [-400.0, -0.5]])
    plant = holdfast.plant((a, np.array([0.0, 2.0]), np.array([1.0, 0.0])))
    a[1, 0] = 0.0
    assert plant.state_matrix[1, 0] == -400.0
    with pytest.raises(ValueError):
        plant.state_matrix[1, 0] = 0.0


def test_keys_of_a_case():
    case = holdfast.Case(conductor={"name": "Drake", "span": 300.0, "sag": 6.0},
                         device={"kind": "dashpot", "position": 1.5, "damping": 300.0})  # fmt: skip
    assert "control" in case and "control.sampling_period" in case and "device.1.damping" in case
    for key in ("controll", "control.nothing", "control.sampling_period.x", "device.0.damping", "device.2.damping", "", 3):
        assert key not in case
        with pytest.raises(KeyError):
            case[key]
    assert list(case) == list(case.to_dict()) and len(case) == len(list(case)) and all(name in case for name in case)


def test_types_of_numbers(tmp_path):
    case = holdfast.Case()
    tables = [case.orbit(), case.simulate(0.1), case.chart(), case.sweep({"backlash.width": (0, 1e-3, 3)}, duration=1.0),
              case.basins({"initial.z1": (-0.01, 0.01, 3), "initial.v1": (-0.1, 0.1, 3)})]  # fmt: skip
    for table in tables:
        for name, values in table.items():
            assert values.dtype.kind == "U" or values.dtype.char in (np.dtype(t).char for t in (np.int64, np.float64, bool)), name
    pytest.importorskip("xarray"), pytest.importorskip("zarr")
    case.orbit().to_xarray().to_zarr(tmp_path / "orbit.zarr")


def test_one_name_in_every_dataset(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("zarr"), pytest.importorskip("netCDF4")
    axes, how = {"backlash.width": (0, 1e-3, 3), "control.sampling_period": (1e-3, 2e-3, 2)}, {"duration": 1.0}
    table = holdfast.Case().sweep(axes, **how)
    store = holdfast.Case().sweep(axes, store=tmp_path / "a.zarr", **how)
    holdfast.Case().sweep(axes, output=tmp_path / "a.nc", **how)
    with xarray.open_dataset(tmp_path / "a.nc") as file:
        for data in (table.to_xarray(), store.to_xarray(), store.to_table().to_xarray(), file):
            assert set(data.dims) == set(data.coords) == {"backlash_width", "control_sampling_period"}
            np.testing.assert_array_equal(data["steady_peak"].values, table["steady_peak"])
    assert table.axes == tuple(axes)


def test_html_shows_the_chart(no_gui):
    assert '<img alt="' in holdfast.Case().chart()._repr_html_()
    assert "data:image/png;base64,iVBOR" in holdfast.Case().response((-600, 0, 5), (-20, 0, 5))._repr_html_()
    assert "<img" not in holdfast.Case().simulate(0.1)._repr_html_() and not no_gui.get_fignums()
