"""The examples of docs/python.md run."""

from __future__ import annotations

import math
import pathlib
import re

import numpy as np
import pytest

import holdfast

GUIDE = pathlib.Path(__file__).parents[2] / "docs" / "python.md"
BLOCKS = re.findall(r"^```python\n(.*?)^```", GUIDE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


@pytest.mark.filterwarnings("ignore::holdfast.PlausibilityWarning")
def test_examples(no_gui, monkeypatch, tmp_path):
    from test_plant import chain

    for package in ("control", "pandas", "xarray", "zarr"):
        pytest.importorskip(package)
    monkeypatch.chdir(tmp_path)
    a, b, c = chain()
    names = {"A": a, "B": b, "C": c, "math": math, "np": np, "holdfast": holdfast, "case": holdfast.Case()}
    assert len(BLOCKS) == 4
    for block in BLOCKS:
        exec(compile(block, str(GUIDE), "exec"), names)


def test_every_method_is_named():
    text = GUIDE.read_text(encoding="utf-8")
    for name in dir(holdfast.Case):
        if not name.startswith("_") and name not in ("from_toml", "to_dict", "to_toml", "plant_matrices"):
            assert name in text, name
