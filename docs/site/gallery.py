"""The gallery: each script of docs/python as a page, with what it prints and draws."""

from __future__ import annotations

import os
import pathlib
import re
import subprocess
import sys
import time

MARK = "\x1e"  # stands in the output behind each cell


def package_is_there() -> bool:
    """With its extension."""
    try:
        import holdfast  # noqa: F401
    except ImportError:
        return False
    return True


def cells_of(script: str) -> list[tuple[str, str]]:
    """Kind, "text" or "code", and text of each cell of a script in percent format."""
    cells = []
    for cell in re.split(r"^# %%", script, flags=re.MULTILINE)[1:]:
        head, _, body = cell.partition("\n")
        if "[markdown]" in head:
            cells.append(("text", re.sub(r"^# ?", "", body, flags=re.MULTILINE).strip()))
        else:
            cells.append(("code", body.strip("\n")))
    return cells


def outputs_of(name: str, cells: list[tuple[str, str]], folder: pathlib.Path) -> list[str]:
    """Runs the script in the folder, where its pictures stay, and gives what each cell of code prints."""
    marked = "".join(f"{body}\nprint({MARK!r}, end='', flush=True)\n" for kind, body in cells if kind == "code")
    file = folder / name
    file.write_text(marked, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, name],
        cwd=folder,
        env={**os.environ, "MPLBACKEND": "Agg"},
        capture_output=True,
        encoding="utf-8",
    )
    file.unlink()
    if done.returncode != 0:
        raise SystemExit(f"docs/python/{name} ends with an error:\n{done.stdout}{done.stderr}")
    return done.stdout.split(MARK)


def page_of(script: pathlib.Path, folder: pathlib.Path, run: bool) -> str:
    cells = cells_of(script.read_text(encoding="utf-8"))
    printed = iter(outputs_of(script.name, cells, folder) if run else [])
    parts = []
    for kind, body in cells:
        if kind == "text":
            parts.append(body)
            continue
        parts.append(f"```python\n{body}\n```")
        output = next(printed, "").strip("\n")
        if output:
            parts.append(f"```text\n{output}\n```")
        parts += [
            f"![]({picture})" for picture in re.findall(r'savefig\("([\w.-]+)"', body) if (folder / picture).exists()
        ]
    parts.append(f"The script: [docs/python/{script.name}](../../python/{script.name})")
    return "\n\n".join(parts) + "\n"


PAPER = """\
import sys, warnings
import holdfast
import matplotlib.pyplot as plt

warnings.simplefilter("ignore", holdfast.PlausibilityWarning)
for entry in holdfast.paper.figures():
    holdfast.paper.figure(entry.name).savefig(f"{entry.name}.png", dpi=100)
    plt.close("all")
    print(f"## {entry.title}\\n\\n![]({entry.name}.png)\\n\\n{entry.caption}\\n")
    print("".join(f"- Printed in the paper: {what}: {value}\\n" for what, value in entry.printed))
    print(f"```python\\nholdfast.paper.figure({entry.name!r})\\n```\\n")
"""


def paper_page(folder: pathlib.Path) -> str:
    """Each figure of `holdfast.paper` with what it says of itself."""
    (text,) = outputs_of("paper.py", [("text", ""), ("code", PAPER)], folder)[:1]
    return f"# The figures of the paper\n\nEach is one call; a number, `figure(4)`, draws all panels.\n\n{text}"


def write_pages(scripts: pathlib.Path, folder: pathlib.Path, run: bool) -> None:
    """A page for each script, and one that lists them. Without the package the scripts are shown unrun."""
    folder.mkdir(parents=True)
    pages = [
        (script.stem, lambda script=script: page_of(script, folder, run)) for script in sorted(scripts.glob("*.py"))
    ]
    if run:
        pages.append(("paper", lambda: paper_page(folder)))
    for name, text in pages:
        begin = time.monotonic()
        (folder / f"{name}.md").write_text(text(), encoding="utf-8")
        print(f"gallery: {name} {time.monotonic() - begin:.1f} s", flush=True)
    text = "# Gallery\n\nScripts of the Python package with what they print and draw; each checks what it tells.\n"
    if not run:
        text += "\nThis site was made without the package, so that they have not been run.\n"
    if pages:
        text += "\n```{toctree}\n:maxdepth: 1\n\n" + "".join(f"{name}\n" for name, _ in pages) + "```\n"
    (folder / "index.md").write_text(text, encoding="utf-8")
