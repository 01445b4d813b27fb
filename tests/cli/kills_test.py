#!/usr/bin/env python3
"""Programs are killed at random moments and started again, over and over: a study, a tune, a
calibration, a refinement, a queue of all four, a queue that two programs share, and two programs
with one cache. Killed (SIGKILL) is rank 0, another rank, mpirun, or all of them at once; ranks and
lanes change from start to start.

What a journal had stays there after every kill, to the byte, and in the count of `status`; what a
queue has ended is not begun again; no other program is disturbed. In the end everything has the
digest of an undisturbed run.

usage: kills_test.py LINKSTUDY SECONDS [KILLS] [--seed N]
       ends when the time is over or so many kills are done
"""

import argparse
import collections
import json
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

MODEL = """format = 1
kind = "model"
gravity = [0.0, -9.81, 0.0]
[[link]]
name = "arm"
mass = 1.0
center_of_mass = [0.0, -0.5, 0.0]
inertia = [0.02, 0.02, 0.02]
[[joint]]
name = "A"
type = "revolute"
parent = "ground"
child = "arm"
initial = { position = ["30 deg"] }
[[spring]]
name = "S"
first = { link = "ground", position = [0.3, 0.0, 0.0] }
second = { link = "arm", position = [0.0, -0.5, 0.0] }
stiffness = 20.0
free_length = 0.3
[simulation]
end_time = 4.0
step = 1.0e-3
"""

HEAD = 'format = 1\nkind = "{}"\nmodel = "model.toml"\n'
REFERENCE = """reference = { set = { "simulation.step" = 5.0e-4 } }
"""
MATCH = """[[match]]
signal = "joint.A.q"
tolerance = 0.01
"""
RESPONSE = """[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "rms"
"""

# In the order in which a queue takes them.
FILES = {
    "calibrate": HEAD.format("calibrate") + """[[parameter]]
path = "spring.S.stiffness"
range = { log = [2.0, 200.0] }
[[parameter]]
path = "link.arm.mass"
range = { log = [0.2, 5.0] }
[[experiment]]
name = "swing"
reference = { set = { "spring.S.stiffness" = 37.0, "link.arm.mass" = 1.3 } }
signals = ["joint.A.q"]
[fit]
starts = 3
""",
    "converge": HEAD.format("converge") + """[[refine]]
parameter = "simulation.step"
ladder = { from = 4e-2, ratio = 0.5, levels = 12 }
""" + RESPONSE,
    "study": HEAD.format("study") + REFERENCE + """[[vary]]
parameter = "link.arm.mass"
lin = [0.5, 1.5, 300]
""" + RESPONSE + MATCH,
    "tune": HEAD.format("tune") + """reference = { set = { "spring.S.stiffness" = 100.0 } }
[[tune]]
parameter = "spring.S.stiffness"
range = { log = [1.0, 100.0] }
""" + MATCH.replace("0.01", "0.05"),
}


def whole_records(path):
    """The bytes of a journal up to its last whole record."""
    data = path.read_bytes() if path.exists() else b""
    end = 80  # of the header
    if len(data) < end:
        return b""
    while len(data) >= end + 8:
        length, check = struct.unpack_from("<II", data, end)
        payload = data[end + 8:end + 8 + length]
        if len(payload) < length or zlib.crc32(data[end:end + 4] + payload) != check:
            break
        end += 8 + length
    return data[:end]


def is_alive(pid):
    """A process that is no zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


class Harness:
    """One scratch folder, and everything that is started in it."""

    def __init__(self, program, folder, seed):
        self.program, self.folder = program, folder
        self.random = random.Random(seed)
        self.kills = collections.Counter()  # by what, by whom
        self.environment = {
            **os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_pml": "ob1", "TMPDIR": str(folder / "tmp"),
            "OMPI_MCA_btl_vader_backing_directory": str(folder / "tmp")}
        (folder / "tmp").mkdir()
        (folder / "rank.sh").write_text(
            '#!/bin/sh\necho $$ >"pids/$PIDS.${OMPI_COMM_WORLD_RANK:-0}"\nexec "$@"\n')
        (folder / "pids").mkdir()
        self.started = 0
        self.stuck = 0  # launchers without ranks

    def fill(self, name):
        """A folder with all files."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        (folder / "model.toml").write_text(MODEL)
        for kind, text in FILES.items():
            (folder / f"{kind}.toml").write_text(text)

    def run(self, *arguments):
        ended = subprocess.run([self.program, *arguments], cwd=self.folder, text=True,
                               capture_output=True, env=self.environment, check=False)
        if ended.returncode != 0:
            raise AssertionError(f"{arguments}: exit code {ended.returncode}\n{ended.stderr}")
        return ended.stdout

    def status(self, results):
        return json.loads(self.run("status", results, "--json"))

    def start(self, *arguments, ranks):
        return Start(self, arguments, ranks)

    def victim_of(self, start):
        roles = ["rank 0", "all"] if start.ranks > 1 or start.has_mpirun else ["rank 0"]
        if start.has_mpirun:
            roles.append("mpirun")
        if start.ranks > 1:
            roles += ["other rank", "other rank"]
        return self.random.choice(roles)


class Start:
    """A program under way, alone or by mpirun."""

    def __init__(self, harness, arguments, ranks):
        self.harness, self.ranks = harness, ranks
        self.name = f"start{harness.started}"
        harness.started += 1
        self.has_mpirun = ranks > 1 or harness.random.random() < 0.2
        launcher = ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none"]
        command = [*(launcher if self.has_mpirun else []), "sh", "rank.sh", harness.program]
        environment = {**harness.environment, "PIDS": self.name}
        if harness.random.random() < 0.5:
            environment["LINKSTUDY_LANES"] = "1"
        self.log = harness.folder / "tmp" / f"{self.name}.log"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                [*command, *arguments, "--progress", "none"], cwd=harness.folder, env=environment,
                stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True)

    def pids(self):
        pids = {}
        for path in (self.harness.folder / "pids").glob(f"{self.name}.*"):
            text = path.read_text().strip()
            if text:
                pids[int(path.suffix[1:])] = int(text)
        return pids

    def is_up(self):
        return self.process.poll() is None

    def kill(self, role):
        """False where it has ended before."""
        pids = self.pids()
        others = [pid for rank, pid in pids.items() if rank > 0]
        targets = {"rank 0": [pids.get(0)], "mpirun": [self.process.pid],
                   "other rank": [self.harness.random.choice(others) if others else None],
                   "all": [self.process.pid, *pids.values()]}[role]
        if None in targets or not self.is_up():
            return False
        is_killed = False
        for pid in targets:
            try:
                os.kill(pid, signal.SIGKILL)
                is_killed = True
            except ProcessLookupError:
                pass  # on its way out
        return is_killed

    def end(self):
        """Waits for all that is left of it; the exit code."""
        try:
            code = self.process.wait(60)
        except subprocess.TimeoutExpired:
            # mpirun of Open MPI 4.1.4 forgets to end, at times, when a rank dies in its start.
            if not self.has_mpirun or any(is_alive(pid) for pid in self.pids().values()):
                raise
            self.harness.stuck += 1
            self.process.kill()
            code = self.process.wait()
        until = time.monotonic() + 20
        while any(is_alive(pid) for pid in self.pids().values()):
            if time.monotonic() > until:
                raise AssertionError(f"ranks outlive their launcher\n{self.log.read_text()}")
            time.sleep(0.01)
        return code

    def begun(self):
        return re.findall(r"(\w+) begins$", self.log.read_text(), re.MULTILINE)


class Life:
    """What is killed, until it has ended or was killed often enough; and how it must end."""

    def __init__(self, harness, name, kinds, arguments, results):
        self.harness, self.name, self.kinds = harness, name, kinds
        self.arguments, self.results = arguments, results  # by kind

    def journals(self):
        folder = self.harness.folder
        return {kind: whole_records(folder / path / "journal.bin")
                for kind, path in self.results.items()}

    def finished(self):
        counts = {}
        for kind, path in self.results.items():
            if self.journals()[kind]:
                counts[kind] = self.harness.status(path)["finished"]
        return counts

    def ended(self):
        """Of a queue: names that are done."""
        if self.name not in ("queue", "shared queue"):
            return set()
        entries = self.harness.status(self.arguments[1])["entries"]
        return {entry["name"] for entry in entries if entry["state"] == "done"}

    def wait_for_moment(self, start):
        """Some moments fall anywhere, the start included; others into the work."""
        draw = self.harness.random.random
        if draw() < 0.3:
            time.sleep(0.5 * draw())
            return
        before, until = self.journals(), time.monotonic() + 5
        while self.journals() == before and start.is_up() and time.monotonic() < until:
            time.sleep(0.002)
        time.sleep(0.3 * draw() ** 3)

    def check_kept(self, journals, counts):
        for kind, after in self.journals().items():
            if not after.startswith(journals[kind]):
                raise AssertionError(f"{self.name}: {kind} has lost what it had: "
                                     f"{len(journals[kind])} bytes before, {len(after)} after")
        for kind, after in self.finished().items():
            if after < counts.get(kind, 0):
                raise AssertionError(f"{self.name}: {kind} had {counts[kind]} rows, has {after}")

    def step(self):
        """One start that is killed; whether it was."""
        harness, ended = self.harness, self.ended()
        start = harness.start(*self.arguments, ranks=harness.random.choice([1, 1, 2, 3]))
        other = None
        if self.name == "shared queue":
            other = harness.start(*self.arguments, ranks=harness.random.choice([1, 2]))
        self.wait_for_moment(start)
        role = harness.victim_of(start)
        counts = self.finished() if harness.random.random() < 0.3 else {}
        journals = self.journals()
        is_killed = start.kill(role)
        code = start.end()
        if is_killed:
            harness.kills[self.name, role] += 1
        elif code not in (0, 75):
            raise AssertionError(f"{self.name}: exit code {code}\n{start.log.read_text()}")
        if other and other.end() not in (0, 75):
            raise AssertionError(f"{self.name}: the other fails\n{other.log.read_text()}")
        self.check_kept(journals, counts)
        if again := ended & set(start.begun()):
            raise AssertionError(f"{self.name}: begun again: {again}")
        return is_killed

    def finish(self, whole):
        start = self.harness.start(*self.arguments, ranks=self.harness.random.choice([1, 2, 3]))
        if (code := start.end()) != 0:
            raise AssertionError(f"{self.name}: exit code {code}\n{start.log.read_text()}")
        for kind, path in self.results.items():
            digest = self.harness.status(path)["digest"]
            if digest != whole[kind]:
                raise AssertionError(f"{self.name}: {kind} has the digest {digest}")


class CacheLife(Life):
    """Two programs share a cache from nothing on, and one of them is killed."""

    def step(self):
        harness = self.harness
        start = harness.start(*self.arguments, "--fresh", ranks=harness.random.choice([1, 2]))
        other = harness.start(*self.arguments[:3], "other", *self.arguments[4:], "--fresh", ranks=1)
        time.sleep(0.6 * harness.random.random())
        role = harness.victim_of(start)
        is_killed = start.kill(role)
        start.end()
        if is_killed:
            harness.kills[self.name, role] += 1
        if other.end() != 0 or "damaged" in other.log.read_text():
            raise AssertionError(f"cache: the other program: {other.log.read_text()}")
        kind = self.kinds[0]
        if harness.status("other")["digest"] != harness.whole[kind]:
            raise AssertionError("cache: the other program has another digest")
        return is_killed

    def finish(self, whole):
        """What both have left serves a last program whole."""
        super().finish(whole)
        last = self.harness.start(*self.arguments[:3], "last", *self.arguments[4:], "--fresh",
                                  ranks=1)
        if last.end() != 0 or "were not there" in last.log.read_text():
            raise AssertionError(f"cache: the last program: {last.log.read_text()}")


def make_life(harness, number):
    kinds = list(FILES)
    names = [*kinds, "queue", "shared queue", "cache"]
    name = names[number % len(names)]
    shutil.rmtree(harness.folder / "out", ignore_errors=True)
    shutil.rmtree(harness.folder / "cache", ignore_errors=True)
    harness.fill("q")
    if name in FILES:
        arguments = [name, f"q/{name}.toml", "-o", "out"]
        return Life(harness, name, [name], arguments, {name: "out"})
    if name == "cache":
        kind = harness.random.choice(["study", "tune"])
        arguments = [kind, f"q/{kind}.toml", "-o", "out", "--cache", "cache"]
        return CacheLife(harness, name, [kind], arguments, {kind: "out"})
    arguments = ["queue", "q"]
    if harness.random.random() < 0.5:
        arguments += ["--group", "1"]
    if harness.random.random() < 0.5:
        arguments += ["--cache", "cache"]
    return Life(harness, name, kinds, arguments, {kind: f"q/results/{kind}" for kind in kinds})


def live(life, until):
    """Some starts that are killed, and one that is not."""
    for _ in range(life.harness.random.choice([1, 5, 10, 20])):
        if not life.step() or time.monotonic() >= until:
            break
    life.finish(life.harness.whole)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("seconds", type=float)
    parser.add_argument("kills", type=int, nargs="?", default=10**9)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    given = parser.parse_args()
    print(f"seed {given.seed}", flush=True)
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        harness = Harness(str(Path(given.program).resolve()), Path(folder), given.seed)
        harness.fill("q")
        for kind in FILES:
            harness.run(kind, f"q/{kind}.toml", "-o", f"whole_{kind}")
        harness.whole = {kind: harness.status(f"whole_{kind}")["digest"] for kind in FILES}
        lives, told = 0, begin
        while time.monotonic() - begin < given.seconds and harness.kills.total() < given.kills:
            life = make_life(harness, lives)
            try:
                live(life, begin + given.seconds)
            except BaseException:
                print(harness.kills)
                raise
            lives += 1
            if time.monotonic() - told > 120:
                told = time.monotonic()
                print(f"{harness.kills.total()} kills after {told - begin:.0f} s", flush=True)
    for (name, role), count in sorted(harness.kills.items()):
        print(f"{name:13} {role:11} {count:5}")
    if harness.stuck > 0:
        print(f"{harness.stuck} times mpirun did not end when its ranks had")
    print(f"{harness.kills.total()} kills in {lives} lives, {time.monotonic() - begin:.0f} s: "
          "nothing lost, every digest that of an undisturbed run")
    return 0 if harness.kills.total() > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
