#!/usr/bin/env python3
"""Shipped mechanisms against published numbers and closed forms: a flyball governor, a crank drive
with a bending rod, an excavator arm with cylinders, a punch press. Each closes its energy ledger.

usage: mechanisms_test.py LINKSTUDY TREE [options of unittest]
"""

import csv
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LINKSTUDY = Path()
TREE = Path()
GRAVITY = 9.81
LEDGER = 1e-9  # of the greatest energy


def simulate(name, *settings, signals=()):
    """Columns of a run of a shipped mechanism."""
    path = TREE / "configs" / "mechanisms" / f"{name}.toml"
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "run.csv"
        command = [LINKSTUDY, "simulate", path, "--csv", table]
        for setting in settings:
            command += ["--set", setting]
        if signals:
            command += ["--signals", ",".join([*signals, "energy"])]
        done = subprocess.run(
            list(map(str, command)), capture_output=True, text=True, stdin=subprocess.DEVNULL
        )
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        lines = table.read_text().splitlines()
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return {head: [float(x) for x in column] for head, *column in zip(*rows)}


def least_root(f, low, high):
    """Of a function that is negative at low and positive at high."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


class MechanismTest(unittest.TestCase):
    def require_closed_ledger(self, run):
        moved = max(max(map(abs, run[f"energy.{kind}"])) for kind in ("kinetic", "potential"))
        residual = max(map(abs, run["energy.residual"]))
        self.assertGreater(moved, 0.0)
        self.assertLess(residual, LEDGER * moved)

    def require_near(self, found, expected, allowed):
        worst = max(abs(a - b) for a, b in zip(found, expected, strict=True))
        self.assertLess(worst, allowed)


class FlyballGovernor(MechanismTest):
    """Benchmark A05 of the IFToMM library."""

    HUB, MIDDLE, TOP = 0.05, 0.5, 1.0
    ROD, MOMENT = 5.3, 0.3 * 0.5 + 5.0 * 1.0  # kg, kg m about the hinge
    ALONG, ACROSS = 5.0e-6, 5.1000025  # kg m^2 about the hinge
    SLIDER, STIFFNESS, LENGTH = 3.0, 8.0e5, 0.5
    SIGNALS = ("joint.shaft.v", "joint.slide.q", "joint.right.q", "joint.left.q", "spring.right")

    def moment_of_inertia(self, angle):
        """Of everything that turns, about the shaft's axis."""
        c, s = math.cos(angle), math.sin(angle)
        rod = self.ROD * self.HUB**2 + 2.0 * self.HUB * self.MOMENT * c
        rod += self.ALONG * s**2 + self.ACROSS * c**2
        return 5.0e-6 + 5.0e-3 + 2.0 * rod

    def steady(self, angle):
        """Slider and speed with which the rods stay at this angle."""
        c, s = math.cos(angle), math.sin(angle)
        out, up = self.MIDDLE * c, self.TOP + self.MIDDLE * s

        def pull(slide):
            length = math.hypot(out, up - slide)
            force = self.STIFFNESS * (length - self.LENGTH)
            return force * out / length, force * (up - slide) / length

        weight = self.SLIDER * GRAVITY
        slide = least_root(lambda x: weight - 2.0 * pull(x)[1], up - 0.6, up)
        inwards, downwards = pull(slide)
        against = self.MOMENT * GRAVITY * c + self.MIDDLE * (c * downwards - s * inwards)
        lever = -s * (self.HUB * self.MOMENT + (self.ACROSS - self.ALONG) * c)
        return slide, math.sqrt(against / lever)

    def test_published_start_leaves_the_springs_without_force(self):
        run = simulate("flyball_governor", "simulation.end_time=0.01", signals=self.SIGNALS)
        self.assertAlmostEqual(run["spring.right.length"][0], 0.5, delta=1e-15)
        self.assertAlmostEqual(run["joint.shaft.v"][0], 2.0 * math.pi, delta=1e-15)

    def test_angular_momentum_stays_while_rods_and_speed_swing(self):
        run = simulate("flyball_governor", signals=self.SIGNALS)
        momentum = [
            self.moment_of_inertia(angle) * speed
            for angle, speed in zip(run["joint.right.q"], run["joint.shaft.v"])
        ]
        # RK4 over 1e5 steps of h omega = 0.8 where the dampers are fast.
        self.require_near(momentum, [momentum[0]] * len(momentum), 1e-8 * momentum[0])
        self.require_near(run["joint.right.q"], run["joint.left.q"], 1e-9)
        self.assertGreater(max(run["joint.shaft.v"]) - min(run["joint.shaft.v"]), 1.0)
        self.require_closed_ledger(run)

    def test_stays_at_the_angle_where_springs_and_weights_balance(self):
        for degrees in (-30.0, -50.0):
            angle = math.radians(degrees)
            slide, speed = self.steady(angle)
            run = simulate(
                "flyball_governor",
                f"joint.right.initial.position.0={angle!r}",
                f"joint.left.initial.position.0={angle!r}",
                f"joint.slide.initial.position.0={slide!r}",
                f"joint.shaft.initial.velocity.0={speed!r}",
                "simulation.end_time=2",
                signals=self.SIGNALS,
            )
            count = len(run["time"])
            self.require_near(run["joint.right.q"], [angle] * count, 1e-9)
            self.require_near(run["joint.slide.q"], [slide] * count, 1e-9)
            self.require_near(run["joint.shaft.v"], [speed] * count, 1e-9)


class CrankDrive(MechanismTest):
    """Simeon's, driven at a constant speed."""

    CRANK, ROD, SPEED = 0.15, 0.30, 150.0
    CRANK_INERTIA, ROD_MASS, ROD_INERTIA, SLIDER = 0.002727, 0.151104, 0.0045339259, 0.075552
    LINE = 7870.0 * 0.008**2  # kg/m
    BENDING = 2.0e11 * 0.008**4 / 12.0  # N m^2
    SIGNALS = (
        "joint.A.q",
        "joint.B.q",
        "joint.P",
        "motion.crank",
        "point.middle.position",
        "closure.C.force",
    )

    def rigid(self, t):
        """Angle of the rod, its rate and acceleration, position and motion of the slider."""
        a = self.SPEED * t
        s = -self.CRANK / self.ROD * math.sin(a)
        c = math.sqrt(1.0 - s * s)
        rate = -self.CRANK * self.SPEED * math.cos(a) / (self.ROD * c)
        change = (self.CRANK * self.SPEED**2 * math.sin(a) + self.ROD * s * rate**2) / (
            self.ROD * c
        )
        x = self.CRANK * math.cos(a) + self.ROD * c
        v = -self.CRANK * self.SPEED * math.sin(a) - self.ROD * s * rate
        slider = -self.CRANK * self.SPEED**2 * math.cos(a) - self.ROD * (c * rate**2 + s * change)
        return math.asin(s), rate, change, x, v, slider

    def kinetic(self, t):
        angle, rate, _, _, v, _ = self.rigid(t)
        a, half = self.SPEED * t, 0.5 * self.ROD
        across = (
            -self.CRANK * self.SPEED * math.sin(a) - half * math.sin(angle) * rate,
            self.CRANK * self.SPEED * math.cos(a) + half * math.cos(angle) * rate,
        )
        about_centre = self.ROD_INERTIA - self.ROD_MASS * half**2
        energy = self.CRANK_INERTIA * self.SPEED**2 + about_centre * rate**2 + self.SLIDER * v**2
        return 0.5 * (energy + self.ROD_MASS * (across[0] ** 2 + across[1] ** 2))

    def test_the_rigid_drive_moves_as_its_geometry_says(self):
        run = simulate("crank_drive", "link.rod.flexible.enabled=false", signals=self.SIGNALS)
        expected = [self.rigid(t) for t in run["time"]]
        rod = [a + b for a, b in zip(run["joint.A.q"], run["joint.B.q"])]
        self.require_near(rod, [e[0] for e in expected], 1e-12)
        self.require_near(run["joint.P.q"], [e[3] for e in expected], 1e-12)
        self.require_near(run["joint.P.v"], [e[4] for e in expected], 1e-9)
        self.require_near(run["joint.P.a"], [e[5] for e in expected], 1e-7)
        h = 2e-7  # (150 h)^2 of the derivative, of which waves of three times the speed have most
        torque = [
            (self.kinetic(t + h) - self.kinetic(t - h)) / (2.0 * h * self.SPEED)
            for t in run["time"]
        ]
        self.require_near(run["motion.crank.effort"], torque, 1e-6)
        self.assertGreater(max(run["motion.crank.effort"]), 30.0)
        self.require_closed_ledger(run)

    def test_published_end_is_that_of_a_stretched_rod(self):
        """Published at 0.1 s: angle of the rod, slider, stretch of the rod."""
        angle, slider, stretch = -3.311734987910881e-1, 1.697373326718410e-1, -8.363283141616840e-6
        run = simulate("crank_drive", "link.rod.flexible.enabled=false", signals=self.SIGNALS)
        rod = run["joint.A.q"][-1] + run["joint.B.q"][-1]
        # A little shorter, it leans more and leaves the slider nearer: to second order.
        self.assertAlmostEqual(angle, rod - math.tan(rod) * stretch / self.ROD, delta=1e-9)
        nearer = stretch / math.cos(rod)
        self.assertAlmostEqual(slider, run["joint.P.q"][-1] + nearer, delta=1e-9)

    def wave(self, times, bears_axial_force):
        """Amplitude of the first wave of the rod, from the rigid start: Simeon's equation, and
        with what pulls along the rod, the guide's answer to the wave among it."""
        length, line = self.ROD, self.LINE
        stiffness = (math.pi / length) ** 4 * self.BENDING / line
        points = [(i + 0.5) * length / 40 for i in range(40)]

        def acceleration(t, q):
            angle, rate, change, _, _, slider = self.rigid(t)
            c, s = math.cos(angle), math.sin(angle)
            a = self.SPEED * t
            inwards = self.CRANK * self.SPEED**2  # of the crank's pin
            along = -inwards * (math.cos(a) * c + math.sin(a) * s)
            across = -inwards * (math.sin(a) * c - math.cos(a) * s)
            forced = -(4.0 / math.pi * across + 2.0 * length / math.pi * change)
            k = stiffness - rate**2
            if bears_axial_force:
                moment = self.ROD_INERTIA * change + 0.5 * self.ROD_MASS * length * across
                moment += line * length**2 / math.pi * (forced - stiffness * q)
                push = -self.SLIDER * slider
                guide = (moment + length * s * push) / (length * c)
                end = push * c + guide * s
                pulled = 0.0
                for x in points:
                    inertia = along * (length - x) - 0.5 * rate**2 * (length**2 - x**2)
                    pulled += (end - line * inertia) * math.cos(math.pi * x / length) ** 2
                k += 2.0 / (line * length) * (math.pi / length) ** 2 * pulled * length / 40
            return forced - k * q

        h = times[1] - times[0]
        parts = 5
        q = v = 0.0
        history = [0.0]
        for t0 in times[:-1]:
            for part in range(parts):
                t, d = t0 + part * h / parts, h / parts
                slopes = [(v, acceleration(t, q))]
                for step in (0.5 * d, 0.5 * d, d):
                    dq, dv = slopes[-1]
                    slopes.append((v + step * dv, acceleration(t + step, q + step * dq)))
                q += d / 6.0 * sum(w * k[0] for w, k in zip((1, 2, 2, 1), slopes))
                v += d / 6.0 * sum(w * k[1] for w, k in zip((1, 2, 2, 1), slopes))
            history.append(q)
        return history

    def test_the_rod_bends_as_a_wave_under_what_pulls_along_it(self):
        run = simulate("crank_drive", "link.rod.flexible.segments=12", signals=self.SIGNALS)
        bent = []
        for i, a in enumerate(run["joint.A.q"]):
            pin = self.CRANK * math.cos(a), self.CRANK * math.sin(a)
            chord = run["joint.P.q"][i] - pin[0], -pin[1]
            length = math.hypot(*chord)
            x = run["point.middle.position.x"][i] - pin[0]
            y = run["point.middle.position.y"][i] - pin[1]
            bent.append((chord[0] * y - chord[1] * x) / length)
        greatest = max(map(abs, bent))
        with_force = self.wave(run["time"], True)
        without = self.wave(run["time"], False)
        self.assertGreater(greatest, 1.5e-3)
        # Higher waves (1/243 of the first) and the shortening that moves the slider are not in it.
        self.require_near(bent, with_force, 0.04 * greatest)
        apart = max(abs(a - b) for a, b in zip(bent, without))
        self.assertGreater(apart, 0.10 * greatest)  # what the published linear stiffness misses
        self.require_closed_ledger(run)


class Excavator(MechanismTest):
    """x forward, y up; a cylinder hangs between a link and the one before it."""

    PINS = ((0.0, 0.0), (5.7, 0.0), (2.9, 0.0))  # of boom, stick, bucket in the link before
    FEET = ((0.4, -0.3), (2.6, 0.9), (0.5, 0.5))  # of the cylinders there
    EYES = ((2.4, 0.6), (-0.7, 0.2), (-0.35, 0.25))  # in the link they move
    LINKS = ((1700.0, (2.7, 0.5)), (900.0, (0.9, 0.15)), (2400.0, (0.65, -0.25)))
    TUBES = ((240.0, 0.8), (150.0, 0.9), (90.0, 0.7))  # mass, its centre from the foot
    RODS = ((160.0, 0.9), (100.0, 1.0), (55.0, 0.7))  # mass, its centre behind the eye
    NAMES = ("boom", "stick", "bucket")

    @staticmethod
    def turned(angle, point):
        c, s = math.cos(angle), math.sin(angle)
        return c * point[0] - s * point[1], s * point[0] + c * point[1]

    def cylinder(self, i, angle):
        """Vector from foot to eye in the link before."""
        x, y = self.turned(angle, self.EYES[i])
        return self.PINS[i][0] + x - self.FEET[i][0], self.PINS[i][1] + y - self.FEET[i][1]

    def potential(self, angles):
        energy, origin, heading = 0.0, (0.0, 0.0), 0.0
        for i, angle in enumerate(angles):
            foot = origin[1] + self.turned(heading, self.FEET[i])[1]
            way = self.turned(heading, self.cylinder(i, angle))
            length = math.hypot(*way)
            (tube, from_foot), (rod, behind) = self.TUBES[i], self.RODS[i]
            energy += tube * (foot + way[1] * from_foot / length)
            energy += rod * (foot + way[1] * (1.0 - behind / length))
            pin = self.turned(heading, self.PINS[i])
            origin = origin[0] + pin[0], origin[1] + pin[1]
            heading += angle
            mass, centre = self.LINKS[i]
            energy += mass * (origin[1] + self.turned(heading, centre)[1])
        return GRAVITY * energy

    def forces(self, angles):
        """Slope of the potential over that of the cylinder's length, each by its own angle."""
        forces, h = [], 1e-5
        for i in range(3):
            ahead, behind = list(angles), list(angles)
            ahead[i] += h
            behind[i] -= h
            work = self.potential(ahead) - self.potential(behind)
            stroke = math.hypot(*self.cylinder(i, ahead[i])) - math.hypot(
                *self.cylinder(i, behind[i])
            )
            forces.append(work / stroke)
        return forces

    def test_cylinders_bear_the_weights_by_their_levers(self):
        run = simulate("excavator", "simulation.end_time=7")
        for instant in (0, -1):  # at rest before and after the strokes
            angles = [run[f"joint.{name}.q"][instant] for name in ("O", "S", "B")]
            for i, (name, force) in enumerate(zip(self.NAMES, self.forces(angles))):
                length = math.hypot(*self.cylinder(i, angles[i]))
                stroke = run[f"joint.{name}_cylinder.q"][instant]
                effort = run[f"motion.{name}.effort"][instant]
                self.assertAlmostEqual(stroke, length, delta=1e-12)
                # h^2 and rounding of the differences
                self.assertAlmostEqual(effort / force, 1.0, delta=1e-8)
        self.require_closed_ledger(run)

    def test_what_the_cylinders_give_lifts_and_moves_the_arm(self):
        run = simulate("excavator")
        supplied = run["energy.kinetic"][-1] + run["energy.potential"][-1]
        supplied -= run["energy.kinetic"][0] + run["energy.potential"][0]
        step = run["time"][1] - run["time"][0]
        power = list(map(sum, zip(*(run[f"motion.{name}.power"] for name in self.NAMES))))
        ends = power[0] + power[-1]
        work = step / 3.0 * (ends + 4.0 * sum(power[1:-1:2]) + 2.0 * sum(power[2:-1:2]))
        self.assertGreater(supplied, 1e4)
        # Simpson over 600 intervals; jerk jumps where a stroke ends.
        self.assertAlmostEqual(work / supplied, 1.0, delta=1e-6)


class PunchPress(MechanismTest):
    """A constant torque, and a force over the crank's angle."""

    CRANK, ROD, TORQUE = 0.1, 0.3, 85.0

    def ram(self, angle):
        return self.CRANK * math.cos(angle) + math.sqrt(
            self.ROD**2 - (self.CRANK * math.sin(angle)) ** 2
        )

    def work_of_punch(self, points, until):
        """Of one turn from -180 deg up to an angle, against the ram: Simpson, piece by piece."""
        work = 0.0
        for (a, f), (b, g) in zip(points, points[1:]):
            end = min(b, until)
            if end <= a:
                break
            # integral of F dx = [F x] - integral of dF x
            slope, count = (g - f) / (b - a), 400
            h = (end - a) / count
            x = [self.ram(a + i * h) for i in range(count + 1)]
            area = h / 3.0 * (x[0] + x[-1] + 4.0 * sum(x[1:-1:2]) + 2.0 * sum(x[2:-1:2]))
            work += (f + slope * (end - a)) * x[-1] - f * x[0] - slope * area
        return work

    def test_energy_is_what_motor_and_punch_give_at_every_angle(self):
        lines = (TREE / "configs" / "data" / "punch_force.csv").read_text().splitlines()
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))[1:]
        points = [(math.radians(float(a)), 1e3 * float(f)) for a, f in rows]
        exact = (
            "simulation.integrator=adaptive",
            "simulation.tolerance={ relative = 1e-11, absolute = 1e-13 }",
        )
        for settings, allowed in (((), 1e-6), (exact, 1e-8)):  # steps of RK4 go over kinks
            run = simulate("punch_press", *settings, signals=("joint.A",))
            self.require_energy(run, points, allowed)

    def test_results_need_the_file_no_more(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            model = (TREE / "configs/mechanisms/punch_press.toml").read_text()
            (folder / "press.toml").write_text(model.replace("../data/", ""))
            table = folder / "punch_force.csv"
            table.write_text((TREE / "configs/data/punch_force.csv").read_text())

            def run(*words):
                command = [LINKSTUDY, *words]
                done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
                return done.returncode, done.stdout + done.stderr

            short = ("press.toml", "-o", "results", "--set", "simulation.end_time=0.05")
            self.assertEqual(0, run("simulate", *short)[0])
            table.write_text(table.read_text().replace("22", "21"))
            code, said = run("simulate", *short)
            self.assertEqual(2, code, said)  # another input
            table.unlink()
            code, said = run("verify", "results")
            self.assertEqual(0, code, said)
            code, said = run("check", "press.toml")
            self.assertEqual(2, code)
            self.assertIn("press.toml:", said)
            self.assertIn("punch_force.csv", said)

    def require_energy(self, run, points, allowed):
        turn = 2.0 * math.pi
        whole = self.work_of_punch(points, math.pi)
        self.assertGreater(whole, 100.0)
        start = run["joint.A.q"][0]
        self.assertGreater(run["joint.A.q"][-1] - start, 4 * turn)

        def expected(angle):
            turns = math.floor((angle + math.pi) / turn)
            part = self.work_of_punch(points, angle - turns * turn)
            return self.TORQUE * (angle - start) - turns * whole - part

        begin = expected(start)
        energy = [expected(angle) - begin for angle in run["joint.A.q"]]
        gained = [k - run["energy.kinetic"][0] for k in run["energy.kinetic"]]
        self.require_near(gained, energy, allowed * max(run["energy.kinetic"]))
        self.require_closed_ledger(run)


if __name__ == "__main__":
    LINKSTUDY, TREE = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
