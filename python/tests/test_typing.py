"""What a type checker knows of the package, against the texts of the program and the package's own sources."""

from __future__ import annotations

import ast
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import typing

import pytest

import holdfast
from holdfast import _typing

ROOT = pathlib.Path(__file__).parents[2]
PACKAGE = pathlib.Path(holdfast.__file__).absolute().parents[1]
SCRIPTS = sorted((ROOT / "docs" / "python").glob("*.py"))
#: Options that a method has under another name, or does as another method.
OTHER_NAMES = {"axis": "axes", "case": "", "follow": "key", "for": "for_", "from": "from_", "map": "keys",
               "metric": "metrics", "motions": "each"}  # fmt: skip
OTHER_METHODS = {"axis", "fractions", "history", "prove", "regions", "stable_interval", "init", "check", "wind", "dry_run",
                 "undecided", "family"}  # fmt: skip


def job_texts():
    tomllib = pytest.importorskip("tomllib")
    return tomllib.loads((ROOT / "texts" / "jobs.toml").read_text(encoding="utf-8"))


def methods():
    """The methods of a case as they are written: name, job, keywords with their annotations."""
    module = ast.parse((ROOT / "python" / "holdfast" / "_case.py").read_text(encoding="utf-8"))
    case = next(node for node in module.body if isinstance(node, ast.ClassDef) and node.name == "Case")
    for node in case.body:
        job = re.search(r'self\._run\(\s*[\'"]([\w-]+)', ast.unparse(node))
        if isinstance(node, ast.FunctionDef) and job and not node.name.startswith("_"):
            arguments = node.args.args[1:] + node.args.kwonlyargs
            yield node, job[1], {one.arg: ast.unparse(one.annotation) for one in arguments}


def mypy(*words, **how):
    pytest.importorskip("mypy")
    # mypy finds an installed package by itself, and refuses to be shown where.
    path = {} if PACKAGE.name == "site-packages" else {"MYPYPATH": str(PACKAGE)}
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--follow-imports=silent", *words],
        env={**os.environ, **path}, capture_output=True, text=True, **how,
    )  # fmt: skip
    return done.stdout + done.stderr


def test_the_stub_is_made_of_the_source():
    spec = importlib.util.spec_from_file_location("stub", ROOT / "python" / "stub.py")
    stub = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(stub)
    assert stub.STUB.read_text(encoding="utf-8") == stub.stub(), "run python/stub.py"


def test_words_of_options_are_those_of_the_program():
    texts = job_texts()
    shared = {name: about["words"] for name, about in texts["options"].items() if "words" in about}
    every = {name.lstrip("-").replace("-", "_") for name in texts["options"]}
    how = set(_typing.How.__annotations__)
    assert how <= every and all(word in str(_typing.How.__annotations__["instructions"]) for word in shared["--instructions"])
    aliases = {"Switching": typing.get_args(_typing.Switching)}
    assert list(aliases["Switching"]) == shared["--switching"]
    seen = 0
    for node, job, keywords in methods():
        own = {name: about["words"] for name, about in texts["jobs"][job].items() if isinstance(about, dict) and "words" in about}
        for option, words in {**shared, **own}.items():
            name = option[2:].replace("-", "_")
            annotation = keywords.get(OTHER_NAMES.get(name, name))
            if annotation is None or "Literal" not in annotation and "Switching" not in annotation:
                assert annotation is None or option == "--from", (node.name, option, annotation)
                continue
            found = aliases["Switching"] if "Switching" in annotation else re.findall(r"'(\w+)'", annotation)
            assert sorted(found) == sorted(words), (node.name, option)
            seen += 1
    assert seen > 15


def test_every_option_of_the_program_is_a_keyword():
    by_job: dict[str, set[str]] = {}
    for _, job, keywords in methods():
        by_job.setdefault(job, set()).update(keywords)
    for job, about in job_texts()["jobs"].items():
        if job not in by_job or job == "case":  # a case file is Python's own here
            continue
        for option in (name[2:].replace("-", "_") for name in about if name.startswith("--")):
            name = OTHER_NAMES.get(option, option)
            assert name in by_job[job] or option in OTHER_METHODS, (job, option)


def test_what_a_method_is_about_may_stand_first():
    for node, _, _ in methods():
        if not node.args.args[1:]:
            flags = [ast.unparse(one.annotation) for one in node.args.kwonlyargs[:1]]
            assert flags in ([], ["bool"]), node.name


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_gallery(script, tmp_path):
    assert "Success" in (told := mypy("--cache-dir", os.environ.get("MYPY_CACHE_DIR", "/dev/null"), script)), told


def test_guide(tmp_path):
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    (tmp_path / "guide.py").write_text(blocks[0] + blocks[1])
    told = mypy("guide.py", cwd=tmp_path)
    assert "Success" in told, told


def test_faults_that_mypy_finds(tmp_path):
    lines = [
        ("case.lyapunov(durration=3)", "call-overload"),
        ('case.simulate(1.0, switching="exakt")', "call-overload"),
        ('case.verdict(instructions="mmx")', "call-overload"),
        ('case.chart(store="a.zarr")["stable"]', "index"),
        ('case.sweep({}, store="a.zarr").chunks_done + "x"', "operator"),
        ('case.orbit(output="a.csv").rows', "attr-defined"),
    ]
    (tmp_path / "faults.py").write_text("import holdfast\ncase = holdfast.Case()\n" + "\n".join(line for line, _ in lines))
    told = mypy("faults.py", cwd=tmp_path)
    for number, (line, fault) in enumerate(lines, 3):
        assert re.search(rf"faults.py:{number}: error: .*", told), (line, told)
    assert "faults.py:2" not in told
