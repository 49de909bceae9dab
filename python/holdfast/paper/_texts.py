"""The texts of the report's figures and what they say: settings, axes, curves, printed values."""

from __future__ import annotations

import functools
import pathlib
import re
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Union

#: Points of an inch, in which the texts count the height of a picture.
_POINTS = 100.0


class Entry(NamedTuple):
    """A figure of :func:`holdfast.paper.figures`."""

    name: str
    title: str
    caption: str
    printed: tuple[tuple[str, str], ...]
    commands: tuple[str, ...]


@dataclass(frozen=True)
class Curve:
    """One thing that a script plots: how, and what the legend calls it."""

    how: str  # "lines", "points", "steps", "impulses", …
    style: dict[str, Any]
    title: Optional[str]


@dataclass(frozen=True)
class Picture:
    """A figure with all that its texts leave open filled in."""

    entry: Entry
    kind: str
    height: float  # inches
    script: str
    commands: dict[str, list[str]]  # of each table, its words
    panels: tuple[dict[str, str], ...]

    def labels(self, axis: str) -> list[str]:
        """What an axis, "x", "y" or "y2", is called, panel after panel."""
        return [mathtext(text) for text in re.findall(rf'set {axis}label ["\'](.+?)["\'](?: |$)', self.script, re.M)]

    def limits(self, axis: str) -> list[tuple[Optional[float], Optional[float]]]:
        """The ranges of an axis; None where the values decide."""
        found = re.findall(rf"set {axis}range \[([^:\]]+):([^:\]]+)\]", self.script)
        return [tuple(None if end.startswith("*") else number(end) for end in ends) for ends in found]

    def curves(self) -> list[list[Curve]]:
        """What each plot command of the script draws, in its order."""
        bodies = re.findall(r"^plot (.*)$", self.script.replace("\\\n", " "), re.M)
        return [[curve for element in _split(body) for curve in _curves_of(element)] for body in bodies]


def number(text: str) -> float:
    """A number as papers print it."""
    return float(text.replace("−", "-"))


# -- the files -------------------------------------------------------------------------------------


@functools.lru_cache(maxsize=None)
def _file(name: str) -> dict[str, Any]:
    try:
        import tomllib
    except ModuleNotFoundError:  # before Python 3.11
        import tomli as tomllib
    return tomllib.loads(pathlib.Path(__file__).with_name(name).read_text(encoding="utf-8"))


def _filled(text: str, values: dict[str, Any]) -> str:
    """With the values in place of their @KEY@, which may hold further ones. What has no value stays: the
    names of tables."""
    before = None
    while before != text:
        before = text
        text = re.sub(r"@(\w[^@\n]*)@", lambda key: str(values.get(key[1], key[0])), text)
    return text


#: The built-in case's motions are drawn in mm.
_UNIT = {"unit": "mm", "length": "1e3"}


@functools.lru_cache(maxsize=None)
def _pictures() -> dict[str, Picture]:
    texts = _file("figures.toml")
    return {row[0]: _picture_of(row, texts) for row in texts["paper"]}


def _picture_of(row: list[Any], texts: dict[str, Any]) -> Picture:
    name, kind_name, own, title, caption, *panels = row
    kind = texts["kind"][kind_name]
    values = {**texts["words"], **_UNIT, **own}
    script = _filled(kind["plot"], values)
    requests = [(values, *table) for table in kind.get("tables", [])]
    filled_panels = []
    for k, panel in enumerate(panels[0] if panels else [], 1):
        of_panel = {**values, **panel, "k": str(k)}
        script += _filled(kind["panel"], of_panel)
        requests += [(of_panel, *table) for table in kind["panel_tables"]]
        filled_panels.append({key: _filled(str(text), of_panel) for key, text in panel.items()})
    commands = {name + _filled(suffix, of): _filled(command, of).split() for of, suffix, command in requests}
    entry = Entry(
        name,
        _filled(title, values),
        _filled(caption, values),
        _printed(title),
        tuple(f"holdfast {' '.join(words)} --output {table}.csv" for table, words in commands.items()),
    )
    return Picture(entry, kind_name, kind["height"] / _POINTS, script, commands, tuple(filled_panels))


def _places(text: str) -> set[tuple[str, str]]:
    """Numbers and letters of the figures that a heading begins with: "Figs. 9b, 11a: …"."""
    head = re.match(r"Figs?\. ([\da-z, ]+):", text)
    return set(re.findall(r"(\d+)([a-z]?)", head[1])) if head else set()


def _printed(title: str) -> tuple[tuple[str, str], ...]:
    """What the paper prints about the figure; nothing about those that are not in it."""
    wanted = _places(title)
    wanted |= {(number, "") for number, _ in wanted}
    fits = [row for row in _file("printed.toml")["values"] if _places(row[0]) & wanted]
    return tuple((what.split(": ", 1)[1], value) for what, value in fits)


def entries() -> tuple[Entry, ...]:
    return tuple(one.entry for one in _pictures().values())


def picture(entry: Entry) -> Picture:
    return _pictures()[entry.name]


def found(which: Union[int, str]) -> list[Entry]:
    """The entries that are meant, those of a figure of the paper in order."""
    asked = re.sub(r"[\s.]|^fig(ure)?", "", str(which).lower())
    numbered = re.fullmatch(r"0*(\d+)([a-z]*)", asked)
    name = f"fig{int(numbered[1]):02}{numbered[2]}" if numbered else asked
    exact = [entry for entry in entries() if entry.name == name]
    panels = [entry for entry in entries() if re.fullmatch(rf"{re.escape(name)}[a-z]", entry.name)]
    # Some of the report's follow the letters of the paper's without being in it.
    of_paper = [entry for entry in panels if re.match(r"(Fig\. |Table )\w+:", entry.title)]
    answer = exact or of_paper
    if not answer:
        raise ValueError(f"which = {which!r}: admissible are {', '.join(entry.name for entry in entries())}")
    return answer


# -- gnuplot's words -------------------------------------------------------------------------------


def mathtext(text: str) -> str:
    """A label of gnuplot as one of matplotlib."""
    text = text.replace("{/:Italic λ}", "$λ$").replace("\u00a0", " ")
    text = re.sub(r"\{/:Italic (\w+)\}((?:[_^](?:\{[^}]*\}|\w))*)", r"$\1\2$", text)
    pieces = text.split("$")
    upright = r"(\w)([_^])(\{[^}]*\}|\w)"
    pieces[::2] = [re.sub(upright, r"$\1\2\3$", piece) for piece in pieces[::2]]
    return "$".join(pieces)


def _split(body: str) -> list[str]:
    """At the commas that stand in no brackets or quotes."""
    parts, depth, quote = [""], 0, ""
    for character in body:
        if quote:
            quote = "" if character == quote else quote
        elif character in "'\"":
            quote = character
        elif character in "([{":
            depth += 1
        elif character in ")]}":
            depth -= 1
        elif character == "," and depth == 0:
            parts.append("")
            continue
        parts[-1] += character
    return [part.strip() for part in parts if part.strip()]


@functools.lru_cache(maxsize=None)
def _line_styles() -> dict[str, str]:
    """The numbered styles that every script begins with."""
    return dict(re.findall(r"^set style line (\d) (.*)$", _file("figures.toml")["script"], re.M))


def _style_of(text: str) -> dict[str, Any]:
    numbered = re.search(r"\bls (\d)", text)
    words = f"{_line_styles()[numbered[1]] if numbered else ''} {text}"
    style: dict[str, Any] = {}
    for key, pattern, kind in (
        ("color", r"\b[lf]c rgb '(#\w+)'", str),
        ("linewidth", r"\blw ([\d.]+)", float),
        ("markersize", r"\bps ([\d.]+)", lambda size: 6.0 * float(size)),
    ):
        for value in re.findall(pattern, words):
            style[key] = kind(value)
    dashes = re.findall(r"\bdt (\([\d,]+\)|\d)", words)
    if dashes and dashes[-1].startswith("("):
        style["linestyle"] = (0, tuple(0.4 * float(length) for length in dashes[-1][1:-1].split(",")))
    elif dashes and dashes[-1] != "1":
        style["linestyle"] = ":"
    marker = re.search(r"\bpt (\d)", words)
    if marker:
        style["marker"] = {"2": "x", "5": "s", "6": "o", "7": "o"}[marker[1]]
        if marker[1] == "6":
            style["markerfacecolor"] = "none"
        if style.get("markersize", 6.0) < 3.0:  # a rim would be most of it
            style["markeredgewidth"] = 0.0
    return style


def _curves_of(element: str) -> list[Curve]:
    """The curves of one element of a plot command: several where it begins with a loop."""
    loop = re.match(r"for \[(\w)=(\d):(\d)\] ", element)
    if loop:
        counts = range(int(loop[2]), int(loop[3]) + 1)
        texts = [re.sub(rf"\bls {loop[1]}\b", f"ls {k}", element[loop.end() :]).replace("%d", str(k)) for k in counts]
        return [curve for text in texts for curve in _curves_of(text)]
    how = re.search(r"\bwith (\w+)", element)
    title = re.search(r"\btitle (?:sprintf\()?(?:'([^']*)'|\(.*'([^']+)'.*\))", element)
    named = next((text for text in title.groups() if text), None) if title else None
    return [Curve(how[1] if how else "", _style_of(element), mathtext(named) if named else None)]
