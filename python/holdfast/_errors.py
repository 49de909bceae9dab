"""What the program says, in the words of Python."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from ._core import NoAnswer

#: Keywords that have other names than their options.
_KEYWORDS = {
    "--axis": "axes",
    "--follow": "key",
    "--for": "for_",
    "--from": "from_",
    "--map": "keys",
    "--metric": "metrics",
    "--yes": "yes=True",
}


def words_of(text: str) -> str:
    """A message with keywords in place of options."""
    text = re.sub(r"--set ([\w.]+)=(.*?)(?=: |$|[,;] )", r"\1 = \2", text)
    return re.sub(r"--[a-z]+(?:-[a-z]+)*", lambda found: keyword_of(found[0]), text)


def keyword_of(option: str) -> str:
    """``max_period`` of ``--max-period``."""
    return _KEYWORDS.get(option, option.removeprefix("--").replace("-", "_"))


@contextmanager
def speaking_python() -> Iterator[None]:
    """Errors of the program name keywords, and those about files are OSError."""
    try:
        yield
    except NoAnswer as fault:
        raise NoAnswer(words_of(str(fault))) from None
    except ValueError as fault:
        text = words_of(str(fault))
        kind = OSError if re.search(r"(^|: )cannot (read|write) ", text) else ValueError
        raise kind(text) from None


def suggestion(name: str, names: Iterable[str]) -> str:
    """``; did you mean duration?``, where one of the names is near."""
    near = difflib.get_close_matches(name, sorted(names), 1, 0.6)
    return f"; did you mean {near[0]}?" if near else ""
