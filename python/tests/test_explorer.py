"""The explorer's page, which is built apart."""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys

import holdfast

PAGE = '<html><script>const given = {"name":"","text":""};</script></html>'
WRITE = "import holdfast; holdfast.Case(control={'sampling_period': 0.002}).explore('my.html')"


def test_page(tmp_path):
    copied = tmp_path / "packages" / "holdfast"
    shutil.copytree(pathlib.Path(holdfast.__file__).parent, copied)
    (copied / "explorer.html").unlink(missing_ok=True)

    def python(code: str) -> subprocess.CompletedProcess[str]:
        path = {**os.environ, "PYTHONPATH": str(copied.parent)}
        return subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=path, capture_output=True, text=True)

    without = python(WRITE)
    assert "NoAnswer" in without.stderr and "pip install ." in without.stderr
    assert str(copied / "explorer.html") in without.stderr
    (copied / "explorer.html").write_text(PAGE)
    done = python(WRITE)
    assert done.returncode == 0, done.stderr
    assert "sampling_period = 0.002" in (tmp_path / "my.html").read_text()
