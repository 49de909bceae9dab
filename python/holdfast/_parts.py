"""A store filled by parts: by the workers of dask, or by processes of this machine, each of which runs this
module."""

from __future__ import annotations

import _thread
import itertools
import operator
import os
import pickle
import queue
import subprocess
import sys
import threading
import time
import uuid
from collections.abc import Iterator, Sequence
from typing import Any, Optional

from . import _options
from ._case import Case, _warn
from ._progress import watch_of
from ._store import Store

#: So many for each worker: one that is slow, or lost, shall not be waited for long.
_PARTS_OF_WORKER = 16
#: A part that so many processes did not survive is given up.
_MOST_LOSSES = 3


def fill_by(client: Any, case: Case, words: Sequence[str], how: dict[str, Any], resume: bool) -> Store:
    """The store that the workers have filled together."""
    if case._core.has_own_plant():
        raise ValueError("client: a sweep is of cables, not of a plant of your own")
    how = dict(how)
    progress = how.pop("progress", None)
    workers = _workers_of(client)
    sized = {name: how[name] for name in ("instructions", "output") if name in how}
    (size,), _ = case._ask("sweep", [*words, "--dry-run"], sized)
    chunks = _chunks_of(size)
    count = min(chunks, _PARTS_OF_WORKER * max(workers.count, 1))
    parts = [[*words, *_options.arguments({"resume": resume}), f"--part={part + 1}/{count}"] for part in range(count)]
    found: list[str] = []
    with watch_of("sweep", progress) as watch:
        for done, texts in enumerate(workers.answers(case, parts, how)):
            found += texts
            if watch is not None:
                watch(done + 1, count)
    store = Store(how["output"])
    if not store.complete:
        raise OSError(f"{store.path} lacks {store.chunks - store.chunks_done} chunks: do the workers see this folder?")
    # What there is to say of all cells is known now.
    for texts in workers.answers(case, [list(words)], how):
        found += texts
    _warn(found)
    return store


def _chunks_of(size: dict[str, Any]) -> int:
    columns = {name: (values, words) for name, _, _, values, words in size["columns"]}
    names, words = columns["quantity"]
    return int(columns["value"][0][[words[name] for name in names].index("chunks")])


def _workers_of(client: Any) -> Any:
    if isinstance(client, str) or isinstance(client, bool):
        pass
    elif hasattr(client, "submit") and hasattr(client, "nthreads"):
        return _DaskWorkers(client)
    elif hasattr(client, "__index__"):
        return _Processes(operator.index(client))
    raise TypeError(
        f"client = {client!r}: admissible are a dask.distributed.Client and a number of processes; without it this "
        "process uses all cores"
    )


# -- dask --------------------------------------------------------------------------------------------


class _DaskWorkers:
    """The workers of a dask.distributed.Client. The scheduler gives a lost one's part to another."""

    def __init__(self, client: Any) -> None:
        if client.asynchronous:
            raise TypeError("client: it is asynchronous; admissible is one that waits")
        self._client = client
        self.count = len(client.nthreads())

    def answers(self, case: Case, questions: list[list[str]], how: dict[str, Any]) -> Iterator[list[str]]:
        from distributed import Event, as_completed

        stop = f"holdfast-{uuid.uuid4().hex}"
        futures = [
            self._client.submit(_fill_on_worker, case, words, how, stop, pure=False, key=f"{stop}-{number}")
            for number, words in enumerate(questions)
        ]
        try:
            for future in as_completed(futures):
                yield future.result()
        except BaseException:
            Event(stop, client=self._client).set()
            self._client.cancel(futures)
            raise


def _fill_on_worker(case: Case, words: list[str], how: dict[str, Any], stop: str) -> list[str]:
    """What a task does; it looks every second whether it is to end."""
    from distributed import Event, get_worker

    worker = get_worker()
    stopping, looked = Event(stop), time.monotonic()

    def watch(done: int, total: int) -> None:
        nonlocal looked
        if time.monotonic() - looked > 1.0:
            looked = time.monotonic()
            if stopping.is_set():
                raise RuntimeError("the sweep was ended")

    return case._ask("sweep", words, {"threads": worker.state.nthreads, **how, "progress": watch})[1]


# -- processes of this machine -----------------------------------------------------------------------


class _Processes:
    """So many processes of this machine, each with a share of its cores."""

    def __init__(self, count: int) -> None:
        if count < 1:
            raise ValueError(f"client = {count}: admissible is a number of processes from 1 on")
        self.count = count

    def answers(self, case: Case, questions: list[list[str]], how: dict[str, Any]) -> Iterator[list[str]]:
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        how = {"threads": max(1, cores // self.count), **how}
        left: queue.SimpleQueue[Any] = queue.SimpleQueue()
        answers: queue.SimpleQueue[Any] = queue.SimpleQueue()
        for words in questions:
            left.put((case, words, how))
        processes = [_Process(left, answers) for _ in range(min(self.count, len(questions)))]
        try:
            for _ in questions:
                answer = answers.get()
                if isinstance(answer, BaseException):
                    raise answer
                yield answer
        finally:
            for process in processes:
                process.end()


class _Process:
    """A process that is asked one thing after the other, and begun anew where it is lost."""

    def __init__(self, left: queue.SimpleQueue[Any], answers: queue.SimpleQueue[Any]) -> None:
        self._left, self._answers = left, answers
        self._ending = False
        self._process: Optional[subprocess.Popen[bytes]] = None
        self._begin()
        self._thread = threading.Thread(target=self._ask_all, daemon=True)
        self._thread.start()

    def _begin(self) -> None:
        package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
        paths = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
        self._process = subprocess.Popen(
            [sys.executable, "-m", __name__],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
            start_new_session=True,  # a Ctrl-C is told by this process
        )

    def _ask_all(self) -> None:
        try:
            while not self._ending:
                self._answers.put(self._ask(self._left.get_nowait()))
        except queue.Empty:
            pass
        except BaseException as fault:
            self._answers.put(fault)

    def _ask(self, question: Any) -> Any:
        for losses in itertools.count(1):
            try:
                pickle.dump(question, self._process.stdin)
                self._process.stdin.flush()
                return pickle.load(self._process.stdout)
            except (EOFError, OSError, pickle.UnpicklingError):
                if self._ending or losses == _MOST_LOSSES:
                    code = self._process.wait()
                    return ChildProcessError(
                        f"{losses} processes were lost over one part of the store, exit code {code}"
                    )
                self._process.kill()
                self._process.wait()
                self._begin()
                if self._ending:
                    self._process.kill()

    def end(self) -> None:
        """Ends the process, whose chunk at hand is lost."""
        self._ending = True
        try:
            self._process.stdin.close()
        except OSError:
            pass
        try:
            self._process.wait(10.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
        self._thread.join()
        self._process.wait()
        self._process.stdout.close()


def _answer_all() -> None:
    """What such a process does: it answers the questions on standard input until that ends."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    questions: queue.SimpleQueue[Any] = queue.SimpleQueue()

    def listen() -> None:
        try:
            while True:
                questions.put(pickle.load(sys.stdin.buffer))
        except (EOFError, OSError, pickle.UnpicklingError):
            questions.put(None)
            _thread.interrupt_main()  # nobody waits for the answer at hand

    threading.Thread(target=listen, daemon=True).start()
    while (question := questions.get()) is not None:
        case, words, how = question
        try:
            answer: Any = case._ask("sweep", words, how)[1]
        except Exception as fault:
            answer = fault
        pickle.dump(answer, replies)
        replies.flush()


if __name__ == "__main__":
    try:
        _answer_all()
    except (KeyboardInterrupt, BrokenPipeError):
        pass
