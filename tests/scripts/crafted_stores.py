#!/usr/bin/env python3
"""crafted_stores.py PROGRAM: stores that somebody has made to do harm, and damaged ones, under strace.

Asked is that the program removes, renames and writes nothing but what this run writes by names of its own,
leaves alone whatever a user has put anywhere, and never gives another table than that of a whole store.
HOLDFAST_CORRUPTIONS is the number of random corruptions (30), HOLDFAST_CORRUPTION_SEED the seed (1).
"""

import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = os.path.realpath(sys.argv[1])
SWEEP = (
    "sweep --axis backlash.width=0:0.003:4 --axis initial.z1=0:0.001:3 --duration 0.2 --chunk 3 --threads 1"
    " --metric steady_peak --metric reversals_per_s"
).split()
CALLS = "unlink,unlinkat,rename,renameat,renameat2,rmdir,open,openat,creat,mkdir,mkdirat,truncate,link,symlink,chmod"
ARRAYS = "backlash_width|initial_z1|steady_peak|reversals_per_s|outcome"
OF_ARRAY = r"(zarr\.json|c(\.\d+)+)"
IN_STORE = rf"(|/lock|/\.removed|/zarr\.json|/\.zarr\.json-\d+-\d+\.tmp|/({ARRAYS})(|/{OF_ARRAY}|/\.{OF_ARRAY}(-\d+-\d+\.tmp|\.claim)))"
WRITTEN = re.compile(
    rf"^(work/(o\.csv(-metadata\.json)?|\.holdfast-[0-9a-f]+-\d+\.tmp)|work/(o\.csv\.zarr|x\.zarr){IN_STORE}"
    rf"|tmp/holdfast-sweep-\w+{IN_STORE})$"
)


def crc64(data):
    """CRC-64/XZ, which seals a root."""
    crc = 2**64 - 1
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xC96C5795D7870F42 if crc & 1 else 0)
    return crc ^ 2**64 - 1


def sealed(root):
    root["attributes"]["holdfast"].pop("checksum", None)
    text = json.dumps(root, indent=2, ensure_ascii=False) + "\n"
    root["attributes"]["holdfast"]["checksum"] = str(crc64(text.encode()))
    return json.dumps(root, indent=2, ensure_ascii=False) + "\n"


def contents(folder):
    """All that lies in a folder, by name, with what it is."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        found[name] = os.readlink(path) if path.is_symlink() else path.read_bytes() if path.is_file() else None
    return found


def changed_paths(trace, base):
    """What the calls that succeeded have removed, renamed or written."""
    begun, paths = {}, []
    for line in trace.read_text(errors="replace").splitlines():
        process, _, call = line.partition(" ")
        call = call.strip()
        if call.endswith("<unfinished ...>"):
            begun[process] = call[: -len("<unfinished ...>")]
            continue
        if call.startswith("<... "):
            call = begun.pop(process, "") + call.partition("resumed>")[2]
        if not re.search(r"= (0|\d+(<.*>)?)$", call):
            continue
        name = call.partition("(")[0]
        if name in ("open", "openat") and not re.search(r"O_(WRONLY|RDWR|CREAT|TRUNC)", call):
            continue
        folders = re.findall(r"(?:\d+|AT_FDCWD)<([^>]*)>", call.rpartition(" = ")[0]) or [str(base / "work")]
        for index, text in enumerate(re.findall(r'"((?:[^"\\]|\\.)*)"', call)):
            folder = folders[min(index, len(folders) - 1)]
            paths.append((name, os.path.normpath(os.path.join(folder, text))))
    return paths


class Scene:
    """A place with a user's thesis, in which the program runs."""

    def __init__(self, whole=None):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="crafted-"))
        self.work, self.tmp, self.thesis = (self.base / name for name in ("work", "tmp", "thesis"))
        for folder in (self.work, self.tmp, self.thesis, self.thesis / "c.0.0"):
            folder.mkdir()
        for name in ("zarr.json", "c.0", "chapter"):
            (self.thesis / name).write_text("mine")
        self.whole = whole

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.base)

    def store(self, path):
        shutil.copytree(self.whole, path)
        return path

    def run(self, words):
        before = contents(self.thesis)
        trace = self.base / "trace"
        command = ["strace", "-f", "-y", "-s", "4096", "-o", trace, "-e", "trace=" + CALLS, PROGRAM, *words]
        done = subprocess.run(
            command, cwd=self.work, env={**os.environ, "TMPDIR": str(self.tmp)}, capture_output=True, timeout=60
        )
        wrong = []
        if done.returncode not in (0, 1, 2) or done.stderr.count(b"\n") > 3:
            wrong.append(f"exit code {done.returncode}: {done.stderr.decode(errors='replace')[:500]}")
        if contents(self.thesis) != before:
            wrong.append("the thesis has changed")
        for call, path in changed_paths(trace, self.base):
            if not path.startswith(("/dev/", "/proc/")) and not WRITTEN.match(os.path.relpath(path, self.base)):
                wrong.append(f"{call} of {path}")
        return done, wrong


failures = 0


def expect(what, wrong):
    global failures
    if wrong:
        failures += 1
        print(f"FAILED: {what}", *wrong[:5], sep="\n  ")


def ways(scene):
    """Where a store is met, and the words that meet it."""
    return [
        ("beside the table", scene.work / "o.csv.zarr", [*SWEEP, "--output", "o.csv"]),
        ("gone on with", scene.work / "o.csv.zarr", [*SWEEP, "--resume", "--output", "o.csv"]),
        ("in the temporary folder", scene.tmp / "holdfast-sweep-abcdef", SWEEP),
        ("to be converted", scene.base / "in.zarr", ["convert", "../in.zarr", "o.csv"]),
    ]


def craft(store, name, kind):
    root = json.loads((store / "zarr.json").read_text())
    root["attributes"]["holdfast"][kind][0]["name"] = name
    (store / "zarr.json").write_text(sealed(root))
    (store / "lock").touch()


def crafted_names(whole):
    for number in range(4):
        for kind in ("axes", "columns"):
            for name in ("{thesis}", "../../thesis", "../thesis", "l/thesis", "l", ".", "..", "", "a\n", "lock"):
                with Scene(whole) as scene:
                    way, store, words = ways(scene)[number]
                    scene.store(store)
                    (store / "l").symlink_to(scene.base if "/" in name else scene.thesis)
                    craft(store, name.replace("{thesis}", str(scene.thesis)), kind)
                    _, wrong = scene.run(words)
                    if not (store / "l").is_symlink():
                        wrong.append("the user's link is gone")
                    expect(f"{kind} {name!r}, {way}", wrong)


def what_is_a_users(whole):
    """Files, links and folders of a user's own in a store that is removed survive it."""
    for number in range(3):
        with Scene(whole) as scene:
            way, store, words = ways(scene)[number]
            scene.store(store)
            if number == 0:
                shutil.rmtree(store / "steady_peak")
            (store / "lock").touch()
            (store / "mine").mkdir()
            (store / "mine/zarr.json").write_text("mine")
            (store / "outcome/c.0.0.txt").write_text("mine")
            (store / "outcome/l").symlink_to(scene.thesis)
            kept = {name: what for name, what in contents(store).items() if "mine" in name or name.endswith(("txt", "/l"))}
            _, wrong = scene.run(words)
            after = contents(store)
            wrong += [f"{name} is gone" for name, what in kept.items() if after.get(name, 0) != what]
            expect(f"a user's own, {way}", wrong)


def what_is_another_users(whole):
    if os.geteuid() != 0:
        return
    with Scene(whole) as scene:
        _, store, words = ways(scene)[2]
        scene.store(store)
        (store / "lock").touch()
        for path in (store, *store.rglob("*")):
            os.chown(path, 12345, 12345)
        before = contents(store)
        _, wrong = scene.run(words)
        expect("another user's folder", wrong + (["it has changed"] if contents(store) != before else []))


def corrupt(chance, store, thesis):
    files = [path for path in store.rglob("*") if path.is_file()]
    path, other = chance.choice(files), chance.choice(files)
    data = path.read_bytes()
    kind = chance.choice(["bit", "cut", "gone", "other", "swap", "link", "folder", "rubbish"])
    if kind == "bit" and data:
        at = chance.randrange(len(data))
        path.write_bytes(data[:at] + bytes([data[at] ^ 1 << chance.randrange(8)]) + data[at + 1 :])
    elif kind == "cut":
        path.write_bytes(data[: chance.randrange(len(data) + 1)])
    elif kind == "other":
        path.write_bytes(other.read_bytes())
    elif kind == "swap":
        path.write_bytes(other.read_bytes())
        other.write_bytes(data)
    elif kind == "rubbish":
        path.write_bytes(chance.randbytes(chance.randrange(200)))
    else:
        path.unlink()
        if kind == "link":
            path.symlink_to(thesis / chance.choice(["zarr.json", "c.0", "c.0.0", "."]))
        if kind == "folder":
            shutil.copytree(thesis, path)
    return f"{kind} of {path.relative_to(store)} ({other.name})"


def corruptions(whole, table):
    chance = random.Random(int(os.environ.get("HOLDFAST_CORRUPTION_SEED") or 1))
    for number in range(int(os.environ.get("HOLDFAST_CORRUPTIONS") or 30)):
        with Scene(whole) as scene:
            way, store, words = chance.choice(ways(scene))
            scene.store(store)
            (store / "lock").touch()
            (store / "steady_peak/.c.1.0.claim").touch()
            (store / "steady_peak/.c.1.0-4711-3.tmp").write_text("half")
            what = corrupt(chance, store, scene.thesis)
            done, wrong = scene.run(words)
            written = scene.work / "o.csv"
            text = written.read_bytes() if written.exists() else done.stdout
            if done.returncode == 0 and text != table:
                wrong.append("another table, with exit code 0")
            expect(f"corruption {number}: {what}, {way}", wrong)


def main():
    with Scene() as scene:
        _, wrong = scene.run([*SWEEP, "--output", "x.zarr"])
        expect("a store", wrong)
        table, wrong = scene.run(SWEEP)
        expect("a table", wrong)
        whole = scene.work / "x.zarr"
        root = (whole / "zarr.json").read_text()
        expect("a root sealed as the program does", [] if sealed(json.loads(root)) == root else ["another seal"])
        crafted_names(whole)
        what_is_a_users(whole)
        what_is_another_users(whole)
        corruptions(whole, table.stdout)
    print(f"{failures} failures")
    return 1 if failures else 0


if shutil.which("strace") is None or subprocess.run(["strace", "-o", os.devnull, "true"]).returncode != 0:
    print("no strace, or none allowed")
    sys.exit(77)
sys.exit(main())
