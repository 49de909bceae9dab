"""Writes holdfast/_case.pyi from holdfast/_case.py: what each method gives by `store` and `output`.

    python python/stub.py
"""

from __future__ import annotations

import ast
import copy
import pathlib

SOURCE = pathlib.Path(__file__).parent / "holdfast" / "_case.py"
STUB = SOURCE.with_suffix(".pyi")
HEAD = '"""Made of _case.py by python/stub.py."""\n'
SPECIAL = ("__init__", "__getitem__", "__contains__", "__iter__", "__len__", "__eq__", "__hash__")


def with_keyword(function: ast.FunctionDef, name: str, kind: str, optional: bool) -> ast.FunctionDef:
    """The function with one keyword of another type, required or None."""
    changed = copy.deepcopy(function)
    arguments = changed.args
    names = [argument.arg for argument in arguments.kwonlyargs]
    if name in names:
        index = names.index(name)
        del arguments.kwonlyargs[index], arguments.kw_defaults[index]
    arguments.kwonlyargs.insert(0, ast.arg(name, ast.parse(kind).body[0].value))  # type: ignore[attr-defined]
    arguments.kw_defaults.insert(0, ast.Constant(None) if optional else None)
    return changed


def overloads(function: ast.FunctionDef) -> list[ast.FunctionDef]:
    """One for each thing that it may give."""
    function.body = [ast.Expr(ast.Constant(...))]
    result, how = ast.unparse(function.returns or ast.Constant(None)), function.args.kwarg
    if how is None or "How" not in ast.unparse(how.annotation or ast.Constant(None)) or result == "None":
        return [function]
    if "Store" in result:
        kinds = [
            (with_keyword(function, "store", "None", True), "Table"),
            (with_keyword(function, "store", "Path", False), "Store"),
        ]
        written = with_keyword(kinds[0][0], "output", "Path", False)
    else:
        kinds, written = [(function, "Table")], with_keyword(function, "output", "Path", False)
    made = []
    for kind, gives in [*kinds, (written, "None")]:
        kind = copy.deepcopy(kind)
        kind.returns = ast.Name(gives)
        kind.decorator_list = [ast.Name("overload")]
        made.append(kind)
    return made


def is_public(node: ast.stmt) -> bool:
    return isinstance(node, ast.FunctionDef) and (not node.name.startswith("_") or node.name in SPECIAL)


def stub() -> str:
    module = ast.parse(SOURCE.read_text(encoding="utf-8"))
    lines = [HEAD, "from typing_extensions import Unpack, overload", ""]
    for node in module.body:
        if isinstance(node, ast.ImportFrom) and node.module in ("collections.abc", "typing", "_store", "_table", "_typing"):
            node.names = [name for name in node.names if name.name not in ("TYPE_CHECKING", "store_name")]
            lines.append(ast.unparse(node))
        elif isinstance(node, ast.ClassDef):
            body = [kind for each in node.body if is_public(each) for kind in overloads(each)]  # type: ignore[arg-type]
            lines += ["", ast.unparse(ast.ClassDef(node.name, node.bases, [], body or [ast.Pass()], [], **_EXTRA))]
        elif is_public(node):
            lines += ["", *(ast.unparse(kind) for kind in overloads(node))]  # type: ignore[arg-type]
    return "\n".join(lines) + "\n"


#: Of a class, from Python 3.12 on.
_EXTRA = {"type_params": []} if "type_params" in ast.ClassDef._fields else {}

if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
