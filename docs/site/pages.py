"""Prepares the sources of the site: pages.py PROJECT XML TARGET

Links to the documents and what these link to, in folders like the project's, so that their relative links
hold; a page for each room of include/holdfast by Doxygen's XML; the gallery from docs/python, run now.
"""

from __future__ import annotations

import os
import pathlib
import shutil
import sys
from collections import defaultdict
from collections.abc import Iterable
from xml.etree import ElementTree

import gallery

#: Beside docs/: documents, and what documents link to.
LINKED = ("README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE", "data", "examples", "tools")


def same_file(source: str, target: str) -> None:
    """The file itself under another path; Sphinx would follow a symbolic link out of its sources."""
    pathlib.Path(target).parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(source, target)
    except OSError:  # another file system
        shutil.copy(source, target)


def link(project: pathlib.Path, target: pathlib.Path) -> None:
    docs = [file.relative_to(project) for file in (project / "docs").iterdir() if file.suffix in (".md", ".svg")]
    pages = [file.relative_to(project) for file in (project / "docs" / "site").glob("*.md")]
    for name in (*map(pathlib.Path, LINKED), *docs, *pages, pathlib.Path("docs/python")):
        source = project / name
        if source.is_dir():
            shutil.copytree(source, target / name, copy_function=same_file)
        elif source.exists():
            same_file(str(source), str(target / name))


# -- C++ -------------------------------------------------------------------------------------------


def headers(xml: pathlib.Path) -> Iterable[tuple[str, ElementTree.Element]]:
    """Path and description of each header of the library, by path."""
    found = []
    for compound in ElementTree.parse(xml / "index.xml").getroot().iterfind("compound[@kind='file']"):
        described = ElementTree.parse(xml / f"{compound.get('refid')}.xml").getroot()[0]
        path = described.find("location").get("file")
        if path.endswith(".hpp"):
            found.append((path, described))
    return sorted(found, key=lambda header: header[0])


def text_of(element: ElementTree.Element | None) -> str:
    return "" if element is None else " ".join("".join(element.itertext()).split())


def directives_of(header: ElementTree.Element, known: set[str]) -> str:
    """All that a header declares. Overloads of a function are told apart by the types of their arguments;
    what is declared inside a class stands with it."""
    lines = []
    classes = [(inner.get("refid"), inner.text) for inner in header.iterfind("innerclass")]
    names = {name for _, name in classes}
    for reference, name in classes:
        if name.rpartition("::")[0] not in names:
            lines += [f".. doxygen{'struct' if reference.startswith('struct') else 'class'}:: {name}", "   :members:", ""]
    for member in header.iterfind("sectiondef/memberdef"):
        kind = {"function": "function", "typedef": "typedef", "enum": "enum", "variable": "variable"}.get(member.get("kind"))
        name = text_of(member.find("qualifiedname")) or text_of(member.find("name"))
        if kind is None or "@" in name:
            continue
        if kind == "function":
            types = ", ".join(text_of(one.find("type")) for one in member.iterfind("param"))
            name += f"({types})"
        if name not in known:
            known.add(name)
            lines += [f".. doxygen{kind}:: {name}", ""]
    return "\n".join(lines)


def write_rooms(xml: pathlib.Path, folder: pathlib.Path) -> None:
    """A page for each room, with a part for each header."""
    folder.mkdir(parents=True)
    rooms: dict[str, list[str]] = defaultdict(list)
    known: set[str] = set()
    for path, described in headers(xml):
        room = path.split("/")[1]
        declared = directives_of(described, known)
        if room.endswith(".hpp") or not declared:
            continue
        rooms[room].append(f"## {'/'.join(path.split('/')[2:])}\n\n`#include <{path}>`\n\n```{{eval-rst}}\n{declared}\n```\n")
    for room, parts in rooms.items():
        (folder / f"{room}.md").write_text(f"# {room}\n\n" + "\n".join(parts), encoding="utf-8")


def main() -> None:
    project, xml, target = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(target, ignore_errors=True)
    link(project, target)
    site = target / "docs" / "site"
    write_rooms(xml, site / "cpp")
    installed = gallery.package_is_there()
    if not installed:
        (site / "python_api.md").unlink()
        (site / "python_api.md").write_text("# Python\n\nThis site was made without the package.\n", encoding="utf-8")
    gallery.write_pages(project / "docs" / "python", site / "gallery", installed)


if __name__ == "__main__":
    main()
