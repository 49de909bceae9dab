"""What the tests of the package share."""

from __future__ import annotations

import csv
import io
import os
import subprocess
import sys

import numpy as np
import pytest

import holdfast


def program_words() -> list[str]:
    """The program that the package is compared with: HOLDFAST_PROGRAM, else the packaged one."""
    named = os.environ.get("HOLDFAST_PROGRAM")
    if named:
        return [named]
    return [sys.executable, "-m", "holdfast"]


@pytest.fixture(scope="session")
def program():
    """Runs the program and gives its table as columns of texts."""

    def run(arguments: list[str]) -> dict[str, list[str]]:
        done = subprocess.run([*program_words(), *arguments, "--quiet"], capture_output=True, text=True)
        if done.returncode != 0:
            return {"exit code": [str(done.returncode)], "message": [done.stderr]}
        rows = list(csv.reader(io.StringIO(done.stdout)))
        return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}

    return run


def assert_same(table: holdfast.Table, columns: dict[str, list[str]]) -> None:
    """To the last bit: the program writes as few digits as restore the same number."""
    assert "exit code" not in columns, columns
    names = [name for name in table if name not in table.axes]
    assert set(names) <= set(columns)
    for name in names:
        values = table[name].ravel()
        if values.dtype.kind in "US":
            assert list(values) == columns[name], name
        else:
            np.testing.assert_array_equal(values.astype(float), np.array([float(text) for text in columns[name]]), name)


def random_case(random: np.random.Generator) -> dict[str, float | str]:
    """Values of a case about the built-in one, of all kinds of plants that are cheap."""
    values: dict[str, float | str] = {
        "control.proportional_gain": round(random.uniform(-900.0, 50.0), 3),
        "control.differential_gain": round(random.uniform(-30.0, 5.0), 4),
        "control.sampling_period": float(random.choice([0.0005, 0.001, 0.002, 0.004])),
        "backlash.width": round(random.uniform(0.0, 0.002), 6),
        "excitation.amplitude": round(random.uniform(0.1, 2.0), 3),
        "excitation.frequency": float(random.choice([5.0, 10.0, 12.5, 20.0])),
        "plant.absorber_stiffness": round(random.uniform(40.0, 120.0), 2),
        "plant.absorber_damping": round(random.uniform(1.0, 8.0), 3),
    }
    kind = random.integers(0, 6)
    if kind == 0:
        values["control.processing_delay"] = 0.5 * float(values["control.sampling_period"])
    if kind == 1:
        values["control.drive_bandwidth"] = 80.0
    if kind == 2:
        values["excitation.hold"] = "exact"
    if kind == 3:
        values["backlash.law"] = "dead_zone"
        values["backlash.contact_stiffness"] = 2e5
    return values


def settings(values: dict[str, float | str]) -> list[str]:
    """Those values as options of the program."""
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


@pytest.fixture
def no_gui():
    """Pictures without a screen."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    yield plt
    plt.close("all")
