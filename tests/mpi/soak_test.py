#!/usr/bin/env python3
"""Many short cases over several ranks, one in twenty of which fails, in every typed way that an
input can bring about; ranks are frozen for a moment now and then, and one of them for good. Every
case is accounted for with the cause that it was made for, and memory does not grow beyond what the
rows themselves take.

usage: soak_test.py LINKSTUDY TREE CASES [--ranks N]
"""

import argparse
import collections
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

MORE = """
[[link]]
name = "wheel"
mass = 1.0
inertia = [1e-2, 1e-2, 1e-2]
[[joint]]
name = "W"
type = "revolute"
parent = "ground"
child = "wheel"
initial = { velocity = [200.0] }

[[link]]
name = "block"
mass = 2.0
inertia = [0.1, 0.1, 0.1]
[[joint]]
name = "B"
type = "prismatic"
parent = "ground"
child = "block"
frame = { euler_zyx = ["0 deg", "0 deg", "35 deg"] }
initial = { velocity = [1.0] }
friction = { mu_s = 0.3, mu_k = 0.2, sigma0 = 100.0, sigma1 = 1.0 }

[simulation]
end_time = 0.05
step_limit = 5
drift_limit = 1e-17
output_interval = 5e-2
"""

# A journal so hard and a bearing so narrow that it buzzes.
JOURNAL = """format = 1
kind = "model"
gravity = [0.0, 0.0, 0.0]
[[link]]
name = "journal"
mass = 1.0
inertia = [1e-3, 1e-3, 1e-3]
[[joint]]
name = "J"
type = "planar"
parent = "ground"
child = "journal"
initial = { velocity = [0.0, 0.5, 0.0] }
[[closure]]
name = "L"
type = "revolute"
first = { link = "ground" }
second = { link = "journal" }
model = "clearance"
[closure.clearance]
kind = "planar"
bearing = "first"
radial = "1 mm"
bearing_radius = "5 mm"
[closure.contact]
law = "lankarani_nikravesh"
restitution = 1.0
exponent = 1.5
stiffness = 1e8
[simulation]
end_time = 0.1
step = 0.1
integrator = "adaptive"
tolerance = { relative = 1e-4 }
"""

TIMEOUT = 5.0
FREEZE = 0.5

# Values of a case that ends well, and what makes it fail.
GOOD = {
    "joint.W.initial.velocity.0": 200.0,
    "closure.S.model": "sde",
    "closure.S.sde.stiffness": 1e5,
    "closure.S.first.position.1": 0.1,
    "joint.B.friction.sigma0": 100.0,
    "joint.B.friction.mu_k": 0.2,
    "simulation.start": "given",
    "simulation.integrator": "rk4",
    "simulation.step": 1e-3,
}
FAULTS = {
    "diverged": {"closure.S.sde.stiffness": 1e9},
    "energy_blowup": {"closure.S.sde.stiffness": 2.1e6},
    "step_budget": {"simulation.integrator": "adaptive"},
    "statics_failed": {"simulation.start": "equilibrium"},
    "assembly_failed": {"closure.S.model": "cut", "closure.S.first.position.1": 5.0},
    "constraint_drift": {"closure.S.model": "cut"},
    "step_too_coarse": {"joint.B.friction.sigma0": 1e6},
    "no_full_turn": {"joint.W.initial.velocity.0": 10.0},
    "invalid_point": {"joint.B.friction.mu_k": 0.4},
    "timeout": {"simulation.step": 4e-9},
}


def tried_beforehand(cases, most=256):
    """Cases of a list that are tried before a study runs: an invalid one would be refused there."""
    if cases <= most:
        return set(range(cases))
    return {i * (cases - 1) // (most - 1) for i in range(most)}


def causes_of(cases):
    """The cause that every case is made for."""
    names, causes = list(FAULTS), ["ok"] * cases
    tried, timeouts = tried_beforehand(cases), 0
    for number, i in enumerate(range(7, cases, 20)):
        cause = names[number % len(names)]
        if cause == "timeout":
            timeouts += 1
            if timeouts > 10:  # seconds each
                cause = "diverged"
        if cause == "invalid_point" and i in tried:
            i = next((k for k in range(i + 1, i + 12) if k < cases and k not in tried), i)
            cause = "no_full_turn" if i in tried else cause
        causes[i] = cause
    return causes


def study_text(causes):
    text = f"""format = 1
kind = "study"
model = "model.toml"
[base.set]
"closure.S.sde.damping" = 10.0
[design]
type = "list"
[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "last"
[[response]]
name = "turn"
signal = "joint.W.v"
reduce = "mean"
cycle = {{ of = "joint.W.q", turns = 1 }}
[run]
timeout = {TIMEOUT}
[[vary]]
parameter = "link.wheel.mass"
values = {[1.0 + 1e-6 * i for i in range(len(causes))]}
"""
    for path, good in GOOD.items():
        values = [FAULTS.get(cause, {}).get(path, good) for cause in causes]
        text += f'[[vary]]\nparameter = "{path}"\nvalues = {json.dumps(values)}\n'
    return text


JOURNAL_STUDY = """format = 1
kind = "study"
model = "journal.toml"
[design]
type = "list"
[[vary]]
parameter = "closure.L.clearance.radial"
values = [1e-3, 1e-8, 1.1e-3]
[[vary]]
parameter = "closure.L.contact.stiffness"
values = [1e8, 1e20, 1e8]
[[response]]
name = "speed"
signal = "joint.J.v.1"
reduce = "last"
"""


class Soak:
    def __init__(self, program, folder, cases, ranks):
        self.program, self.folder, self.cases, self.ranks = program, folder, cases, ranks
        self.random = random.Random(3)
        self.resident = {}  # kB by rank, at 10, 50 and 100 %
        self.peaks = {}
        self.freezes = 0
        self.environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1",
                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_pml": "ob1",
                            "TMPDIR": str(folder)}

    def run(self, *arguments, codes=(0,)):
        ended = subprocess.run([self.program, *arguments], cwd=self.folder, text=True,
                               capture_output=True, env=self.environment, check=False)
        if ended.returncode not in codes:
            raise AssertionError(f"{arguments}: {ended.returncode}\n{ended.stderr[-2000:]}")
        return ended.stdout

    def pid(self, rank):
        path = self.folder / f"pid.{rank}"
        return int(path.read_text()) if path.exists() and path.read_text().strip() else 0

    def memory(self):
        kilobytes = {}
        for rank in range(self.ranks):
            try:
                text = Path(f"/proc/{self.pid(rank)}/status").read_text()
                kilobytes[rank] = int(text.split("VmRSS:")[1].split()[0])
            except (FileNotFoundError, ProcessLookupError, IndexError):
                pass
        return kilobytes

    def freeze(self, rank, seconds):
        try:
            os.kill(self.pid(rank), signal.SIGSTOP)
            time.sleep(seconds)
            os.kill(self.pid(rank), signal.SIGCONT)
            self.freezes += 1
        except ProcessLookupError:
            pass

    def watch(self, process):
        """Samples memory, freezes ranks now and then, and the last for good while it has work."""
        journal = self.folder / "out" / "journal.bin"
        is_lost, next_freeze = False, time.monotonic() + 1.0
        while process.poll() is None:
            time.sleep(0.1)
            if not journal.exists():
                continue
            part = self.finished() / self.cases
            for mark in (0.1, 0.5, 0.99):
                if part >= mark and mark not in self.resident:
                    self.resident[mark] = self.memory()
            if part > 0.6 and not is_lost:
                is_lost = True
                os.kill(self.pid(self.ranks - 1), signal.SIGSTOP)
            elif not is_lost and time.monotonic() > next_freeze:
                self.freeze(self.random.randrange(self.ranks), FREEZE)
                next_freeze = time.monotonic() + 3.0

    def finished(self):
        status = json.loads(self.run("status", "out", "--json"))
        return status["finished"]

    def soak(self):
        (self.folder / "rank.sh").write_text(
            '#!/bin/sh\necho $$ >"pid.$OMPI_COMM_WORLD_RANK"\nexec "$@"\n')
        with (self.folder / "log").open("w") as log:
            process = subprocess.Popen(
                ["mpirun", "-n", str(self.ranks), "--oversubscribe", "--bind-to", "none", "sh",
                 "rank.sh", self.program, "study", "study.toml", "-o", "out", "--progress",
                 "none"], cwd=self.folder, env=self.environment, stdout=log, stderr=log,
                stdin=subprocess.DEVNULL)
            watcher = threading.Thread(target=self.watch, args=(process,))
            watcher.start()
            code = process.wait()
            watcher.join()
        log = (self.folder / "log").read_text()
        own = (self.folder / "out" / "linkstudy.log").read_text()
        # On its way out of MPI_Abort, all being done, mpirun of Open MPI 4.1.4 crashes at times or
        # tells of the ranks that it has killed. A rank that froze with nothing left to do is found
        # lost only when the others leave, after the end.
        is_done = "exit code 0" in own and code in (0, 137, 139, -signal.SIGSEGV)
        if not is_done or "is lost: no sign of life" not in log:
            raise AssertionError(f"exit code {code}\n{log[-3000:]}\n{own[-1000:]}")

    def rows(self, results="out"):
        table = self.run("export", results, "--table", "evaluations", "--columns",
                         "evaluation,status", "--format", "json")
        return json.loads(table)


def statuses_of(table):
    """By evaluation, of a table as JSON."""
    rows = table["rows"] if isinstance(table, dict) else table
    return {int(row["evaluation"]): row["status"] for row in rows}


def check(soak, causes):
    found = statuses_of(soak.rows())
    wrong = {i: (cause, found.get(i)) for i, cause in enumerate(causes) if found.get(i) != cause}
    if wrong or len(found) != len(causes):
        raise AssertionError(f"{len(found)} rows, {len(wrong)} with another cause: "
                             f"{dict(list(wrong.items())[:10])}")
    journal = statuses_of(soak.rows("journal"))
    if journal != {0: "ok", 1: "contact_budget", 2: "ok"}:
        raise AssertionError(f"the journal: {journal}")
    first, last = soak.resident.get(0.1, {}), soak.resident.get(0.99, {})
    for rank in range(1, soak.ranks - 1):
        if rank in first and rank in last and last[rank] > 1.1 * first[rank] + 4000:
            raise AssertionError(f"rank {rank} grows: {soak.resident}")
    # Rank 0 keeps the rows, 0.9 kB each of ten values, and makes results.h5 of them now and then.
    rows = 0.9 * soak.cases
    if 0 in first and 0 in last and (last[0] - first[0]) * 1024 > 4000 * rows + 8e6:
        raise AssertionError(f"rank 0 grows: {soak.resident}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("tree")
    parser.add_argument("cases", type=int)
    parser.add_argument("--ranks", type=int, default=3)
    given = parser.parse_args()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        soak = Soak(str(Path(given.program).resolve()), Path(folder), given.cases, given.ranks)
        model = (Path(given.tree) / "configs/mechanisms/rsrrp.toml").read_text()
        (soak.folder / "model.toml").write_text(model[:model.index("[simulation]")] + MORE)
        (soak.folder / "journal.toml").write_text(JOURNAL)
        (soak.folder / "hard.toml").write_text(JOURNAL_STUDY)
        causes = causes_of(given.cases)
        (soak.folder / "study.toml").write_text(study_text(causes))
        soak.run("study", "hard.toml", "-o", "journal")
        soak.soak()
        check(soak, causes)
        counts = collections.Counter(causes)
    for cause, count in sorted(counts.items()):
        print(f"{cause:18} {count:6}")
    for mark, kilobytes in sorted(soak.resident.items()):
        print(f"resident at {100 * mark:3.0f} %: " +
              ", ".join(f"rank {rank} {kb / 1024:.1f} MB" for rank, kb in kilobytes.items()))
    print(f"{given.cases} cases, {soak.freezes} freezes and a lost rank, "
          f"{time.monotonic() - begin:.0f} s: every row has its cause")
    return 0


if __name__ == "__main__":
    sys.exit(main())
