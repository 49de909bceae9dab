"""The scripts of docs/python run as they stand, and make their pictures."""

from __future__ import annotations

import os
import pathlib
import re
import subprocess
import sys

import pytest

import holdfast

FOLDER = pathlib.Path(__file__).parents[2] / "docs" / "python"
PACKAGE = pathlib.Path(holdfast.__file__).absolute().parents[1]  # installed or beside its extension
SCRIPTS = sorted(FOLDER.glob("*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_script(script, tmp_path):
    for package in ("matplotlib", "pandas"):
        pytest.importorskip(package)
    text = script.read_text(encoding="utf-8")
    for package in ("control", "xarray"):
        if f"import {package}" in text:
            pytest.importorskip(package)
    if "store=" in text:
        pytest.importorskip("zarr")
    done = subprocess.run(
        [sys.executable, script],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": str(PACKAGE)},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    named = set(re.findall(r'savefig\("(\w+\.png)"', text))
    made = {file.name for file in tmp_path.glob("*.png")}
    assert named == made and named
    assert all((tmp_path / name).stat().st_size > 5000 for name in named)


def test_the_guide_names_each():
    guide = (FOLDER.parent / "python.md").read_text(encoding="utf-8")
    assert len(SCRIPTS) == 8
    for script in SCRIPTS:
        assert f"(python/{script.name})" in guide, script
        cells = script.read_text(encoding="utf-8").split("# %%")
        assert len(cells) > 4 and cells[1].startswith(" [markdown]\n# # "), script
