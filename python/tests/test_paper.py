"""The figures of the paper are drawn of what the program's report writes."""

from __future__ import annotations

import csv
import re
import subprocess

import numpy as np
import pytest
from conftest import assert_same, program_words

import holdfast

ENTRIES = holdfast.paper.figures()
NAMES = [entry.name for entry in ENTRIES]

pytestmark = pytest.mark.filterwarnings("ignore::holdfast.PlausibilityWarning")


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """The tables of the report of the built-in case, by their names."""
    folder = tmp_path_factory.mktemp("report")
    subprocess.run([*program_words(), "report", "--output", str(folder), "--quiet"], check=True, capture_output=True)
    tables = {}
    for file in (folder / "data").glob("*.csv"):
        rows = list(csv.reader(file.open(encoding="utf-8")))
        tables[file.stem] = {column: [row[k] for row in rows[1:]] for k, column in enumerate(rows[0])}
    return tables


@pytest.fixture(scope="module")
def drawn():
    """Each figure once, with its axes."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    matplotlib.rcParams["figure.max_open_warning"] = 0
    figures = {name: holdfast.paper.figure(name) for name in NAMES}
    for figure in figures.values():
        figure.canvas.draw()
    yield figures
    matplotlib.pyplot.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_tables_are_those_of_the_report(report, name):
    for table, values in holdfast.paper.tables(name).items():
        assert_same(values, report[table])


@pytest.mark.parametrize("name", NAMES)
def test_axes_are_named(drawn, name):
    axes = drawn[name].axes
    for names in ([ax.get_xlabel() for ax in axes], [ax.get_ylabel() for ax in axes]):
        given = [text for text in names if text]
        assert given
        for text in given:  # exponents are counted, and per sample
            assert re.search(r"\([^()]+\)$", text) or "exponent" in text, text
    for ax in axes:
        for text in (ax.get_xlabel(), ax.get_ylabel(), ax.get_title(), *ax.get_legend_handles_labels()[1]):
            assert "@" not in text and "{/" not in text, text
    assert drawn[name].subfigs[0].get_suptitle() == ENTRIES[NAMES.index(name)].title


#: Of each figure: table, abscissa and its factor, ordinate and its factor, where all of a column is drawn.
CURVES = [
    ("fig02a", "", "force_N", 1, "exact_m", 1e3),
    ("fig02a", "", "force_N", 1, "elements_m", 1e3),
    ("fig02b", "", "force_N", 1, "two_dof_peak_m", -1e3),
    ("fig02c", "", "force_N", 1, "discrepancy", 100),
    ("fig02d", "", "time_s", 1, "two_dof_m", 1e3),
    ("fig05", "-attenuates", "frequency_Hz", 1, "max_sampling_period_s", 1e3),
    ("fig05b", "-3", "frequency_Hz", 1, "attenuation_dB", 1),
    ("fig06a", "-no-control", "time_s", 1, "z1_m", 1e3),
    ("fig06b", "-loop", "time_s", 1, "z1_m", 1e3),
    ("fig07a", "-kicked", "time_s", 1, "z1_m", 1e3),
    ("fig07b", "-undisturbed", "time_s", 1, "z1_m", 1e3),
    ("fig09a", "-loop", "z1_m", 1e3, "v1_m_per_s", 1),
    ("fig09b", "-ideal", "z1_m", 1e3, "v1_m_per_s", 1),
    ("fig09c", "-loop", "z1_m", 1e3, "v1_m_per_s", 1),
    ("fig13a", "", "time_s", 1, "lambda3", 1),
    ("fig13b", "", "time_s", 1, "lambda1", 1),
    ("orbits", "-1", "z1_m", 1e3, "v1_m_per_s", 1),
]


@pytest.mark.parametrize(("name", "suffix", "x", "x_factor", "y", "y_factor"), CURVES)
def test_curves_are_columns_of_the_report(report, drawn, name, suffix, x, x_factor, y, y_factor):
    table = report[name + suffix]
    wanted = np.array([table[x], table[y]], dtype=float).T * (x_factor, y_factor)
    found = [line.get_xydata() for ax in drawn[name].axes for line in ax.lines]
    assert any(
        line.shape == wanted.shape and np.allclose(line, wanted, rtol=1e-12, atol=0.0, equal_nan=True) for line in found
    )


@pytest.mark.parametrize("name", ["fig03", "fig04a", "fig04b"])
def test_stable_gains_are_those_of_the_report(report, drawn, name):
    (ax,) = drawn[name].axes
    shade = ax.collections[0].get_array()
    chart = np.array(report[f"{name}-chart"]["stable"], dtype=float).reshape(shade.shape[::-1])
    np.testing.assert_array_equal(shade, chart.T)
    boundary = report[f"{name}-boundary"]
    for curve in ax.lines:
        for p, d in curve.get_xydata()[:: max(1, len(curve.get_xdata()) // 7)]:
            rows = zip(boundary["proportional_gain"], boundary["differential_gain"])
            printed = curve.get_label() == "printed in the paper"
            assert printed or np.isnan(d) or (p, d) in [(float(a), float(b)) for a, b in rows]


def test_basins_are_those_of_the_report(report, drawn):
    (ax,) = drawn["basins"].axes
    shade = ax.collections[0].get_array()
    states = np.array(report["basins-states"]["attractor"], dtype=int).reshape(shade.shape)
    np.testing.assert_array_equal(shade.T, np.minimum(states, 8))


def test_printed_values():
    printed = {entry.name: dict(entry.printed) for entry in ENTRIES}
    assert printed["fig03"] == {"D on the boundary at P = −557 N/m, no delay": "−33.7 N s/m"}
    assert "30 Hz" in printed["fig10a"].values()
    assert printed["orbits"] == printed["fig04c"] == {}


def test_printed_values_stand_in_the_figures(drawn):
    marks = {
        name: [
            tuple(point)
            for ax in drawn[name].axes
            for line in ax.lines
            if line.get_label() == "printed in the paper"
            for point in line.get_xydata()
        ]
        for name in NAMES
    }
    assert marks["fig02a"] == [(0.2, 3.76)]
    assert marks["fig03"] == [(-557.0, -33.7)]
    assert marks["fig05"] == [(10.0, 30.0)]
    assert [x for x, _ in marks["fig10a"]] == [10.0, 2.2, 30.0]
    (paper,) = [line for line in drawn["table2a"].axes[0].lines if line.get_label() == "paper"]
    np.testing.assert_array_equal(paper.get_ydata(), [-0.001, -0.0014, -0.0476, -0.0497])


@pytest.mark.parametrize(
    ("which", "panels"), [(2, 4), (4, 2), ("Fig. 5", 1), ("9c", 1), (12, 3), ("Table 2", 2), ("orbits", 1)]
)
def test_which(no_gui, which, panels):
    titles = [part.get_suptitle() for part in holdfast.paper.figure(which).subfigs]
    assert len(list(filter(None, titles))) == panels


@pytest.mark.parametrize("which", [1, 14, "4z", "", "table 3", None])
def test_no_such_figure(which):
    with pytest.raises(ValueError, match="admissible are fig02a"):
        holdfast.paper.figure(which)


@pytest.mark.parametrize("name", NAMES)
def test_each_curve_of_the_report_is_drawn(drawn, name):
    from holdfast.paper import _texts

    curves = [curve for plot in _texts.picture(ENTRIES[NAMES.index(name)]).curves() for curve in plot]
    labels = {label for ax in drawn[name].axes for label in ax.get_legend_handles_labels()[1]}
    if name != "basins":  # whose script makes its names itself
        assert {curve.title for curve in curves if curve.title} == labels - {"printed in the paper"}
