"""Cases per second of a study of eight against eight single runs of the same stiffnesses: one
process each, no MPI launcher. Both write what they always write.

usage: study_against_runs.py PROGRAM TOP_FOLDER
"""

import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

STIFFNESSES = [2e5, 5e5, 1e6, 2e6, 3e6, 5e6, 7e6, 1e7]
STUDY = """format = 1
kind = "study"
name = "eight stiffnesses"
model = "{model}"
base = {{ set = {{ "closure.S.model" = "sde", "closure.S.sde.damping_ratio" = 0.7 }} }}

[[vary]]
parameter = "closure.S.sde.stiffness"
values = {values}

[[response]]
name = "force"
signal = "closure.S.force.x"
reduce = "max"
"""


def seconds(command):
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - begin


def run_study(program, folder):
    return seconds([program, "study", folder / "eight.toml", "-o", folder / "eight", "--fresh"])


def run_singles(program, model):
    return sum(
        seconds([program, "simulate", model, "-s", "closure.S.model=sde",
                 "-s", "closure.S.sde.damping_ratio=0.7", "-s", f"closure.S.sde.stiffness={c}"])
        for c in STIFFNESSES)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    model = pathlib.Path(sys.argv[2]).resolve() / "configs/mechanisms/rsrrp.toml"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "eight.toml").write_text(STUDY.format(model=model, values=STIFFNESSES))
        pairs = [(run_study(program, folder), run_singles(program, model)) for _ in range(7)]
    ratio = statistics.median(single / study for study, single in pairs)
    best = min(study for study, _ in pairs)
    print(f"study of 8 runs of 15 s: {8 / best:.0f} cases per second, "
          f"{ratio:.1f} times as many as 8 single runs (median of 7)")


if __name__ == "__main__":
    main()
