"""Prepares the sources of the site: pages.py PROJECT XML TARGET

The documents and what these link to, in folders like the project's, so that their relative links hold; a
page for each room of include/holdfast by Doxygen's XML; the gallery from docs/python, run now.
"""

from __future__ import annotations

import pathlib
import shutil
import sys
from collections import defaultdict
from collections.abc import Iterable
from xml.etree import ElementTree

import gallery

#: Beside docs/: documents, and what documents link to.
BROUGHT = ("README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE", "data", "bench/README.md", "examples", "tools")


def bring(project: pathlib.Path, target: pathlib.Path) -> None:
    """Sphinx would follow symbolic links out of its sources, so these are copies, made anew each time."""
    docs = [file.relative_to(project) for file in (project / "docs").iterdir() if file.suffix in (".md", ".svg")]
    pages = [file.relative_to(project) for file in (project / "docs" / "site").glob("*.md")]
    for name in (*map(pathlib.Path, BROUGHT), *docs, *pages, pathlib.Path("docs/python")):
        source = project / name
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target / name)
        elif source.exists():
            shutil.copy(source, target / name)


# -- C++ -------------------------------------------------------------------------------------------


def compounds(xml: pathlib.Path, kind: str) -> Iterable[ElementTree.Element]:
    for compound in ElementTree.parse(xml / "index.xml").getroot().iterfind(f"compound[@kind='{kind}']"):
        yield ElementTree.parse(xml / f"{compound.get('refid')}.xml").getroot()[0]


def place_of(described: ElementTree.Element) -> str:
    return described.find("location").get("file")


def headers(xml: pathlib.Path) -> list[tuple[str, list[ElementTree.Element], list[ElementTree.Element]]]:
    """Path, classes and other members of each header of the library, by path. The latter are described with
    their namespaces."""
    members = defaultdict(list)
    for namespace in compounds(xml, "namespace"):
        for member in namespace.iterfind("sectiondef/memberdef"):
            members[place_of(member)].append(member)
    files = {place_of(file): file.findall("innerclass") for file in compounds(xml, "file")}
    return [(path, files[path], members[path]) for path in sorted(files) if path.endswith(".hpp")]


def text_of(element: ElementTree.Element | None) -> str:
    return "" if element is None else " ".join("".join(element.itertext()).split())


#: What Breathe calls the kinds of members.
KINDS = {"function": "function", "typedef": "typedef", "enum": "enum", "variable": "variable"}


def is_beyond_breathe(member: ElementTree.Element) -> bool:
    """It reads neither calls among the types of a function nor the value of a variable for one type."""
    if member.get("kind") != "function":
        return "<" in text_of(member.find("qualifiedname"))
    return any("(" in text_of(one) for one in (member.find("type"), *member.iterfind("templateparamlist/param")))


def plain(member: ElementTree.Element) -> list[str]:
    """The declaration and its first sentence as they are."""
    declaration = text_of(member.find("definition")) + text_of(member.find("argsstring"))
    return [".. code-block:: cpp", "", f"   {declaration}", "", text_of(member.find("briefdescription")), ""]


def directives_of(classes: list[ElementTree.Element], members: list[ElementTree.Element], known: set[str]) -> str:
    """All that a header declares. Overloads of a function are told apart by the types of their arguments;
    what is declared inside a class stands with it."""
    lines = []
    names = {inner.text for inner in classes}
    for inner in classes:
        if inner.text.rpartition("::")[0] not in names:
            kind = "struct" if inner.get("refid").startswith("struct") else "class"
            lines += [f".. doxygen{kind}:: {inner.text}", "   :members:", ""]
    for member in members:
        name = text_of(member.find("qualifiedname"))
        if member.get("kind") not in KINDS or "@" in name:
            continue
        if member.get("kind") == "function":
            types = ", ".join(text_of(one.find("type")) for one in member.iterfind("param"))
            name += f"({types})"
        if is_beyond_breathe(member):
            lines += plain(member)
        elif name not in known:
            known.add(name)
            lines += [f".. doxygen{KINDS[member.get('kind')]}:: {name}", ""]
    return "\n".join(lines)


def write_rooms(xml: pathlib.Path, folder: pathlib.Path) -> None:
    """A page for each room, with a part for each header."""
    folder.mkdir(parents=True)
    rooms: dict[str, list[str]] = defaultdict(list)
    known: set[str] = set()
    for path, classes, members in headers(xml):
        room = path.split("/")[1]
        declared = directives_of(classes, members, known)
        if room.endswith(".hpp") or not declared:
            continue
        header = "/".join(path.split("/")[2:])
        rooms[room].append(f"{header}\n{'-' * len(header)}\n\n``#include <{path}>``\n\n{declared}\n")
    for room, parts in rooms.items():
        text = f"{room}\n{'=' * len(room)}\n\n" + "\n".join(parts)
        (folder / f"{room}.rst").write_text(text, encoding="utf-8")


def main() -> None:
    project, xml, target = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(target, ignore_errors=True)
    bring(project, target)
    site = target / "docs" / "site"
    write_rooms(xml, site / "cpp")
    installed = gallery.package_is_there()
    if not installed:
        (site / "python_api.md").unlink()
        (site / "python_api.md").write_text("# Python\n\nThis site was made without the package.\n", encoding="utf-8")
    gallery.write_pages(project / "docs" / "python", site / "gallery", installed)


if __name__ == "__main__":
    main()
