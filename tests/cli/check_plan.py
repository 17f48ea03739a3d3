"""`skein plan` and `run --plan`: the planned run answers as the scene's own does, at a fraction of its cost.

Called as check_plan.py PROGRAM SOURCES.
"""

import json
import re
import subprocess

from cli_case import DONE, SOURCES, USAGE, InFreshFolder, main, skein

NO_RUNG = 76
# A half turn of the paper's shortest fiber, with nine nodes on a section.
SCENE = """title = "planned"
[flow]
rate = 2.5
[fiber]
sections = 41
nodes_per_section = 9
spring_stiffness = 0.0245
blob = 0.0024
[time]
end = 7.0
[output]
frame_interval = 0.05
"""


class Planning(InFreshFolder):
    def setUp(self):
        super().setUp()
        self.write(SCENE)

    def plan(self, *words):
        result = skein("plan", "scene.toml", "--json", "-q", *words, cwd=self.folder, timeout=400)
        return result.returncode, json.loads(result.stdout)

    def half_turn(self, name):
        """Time at which the fiber stands across the flow."""
        self.expect(DONE, "analyze", name, "--no-forces")
        rows = (self.folder / name / "analysis/diagnostics.csv").read_text().splitlines()
        angle = rows[0].split(",").index("angle [degree]")
        before = None
        for row in rows[1:]:
            cells = row.split(",")
            now = float(cells[0]), float(cells[angle])
            if before and before[1] < 90.0 <= now[1]:
                return before[0] + (now[0] - before[0]) * (90.0 - before[1]) / (now[1] - before[1])
            before = now
        self.fail("the fiber does not turn")

    def test_the_planned_run_answers_within_the_tolerance(self):
        code, plan = self.plan("--tolerance", "0.03", "-o", "planned.toml")
        self.assertEqual(code, DONE, plan)
        self.assertLess(plan["chosen"], 9)
        chosen = next(c for c in plan["candidates"] if c["nodes_per_section"] == plan["chosen"])
        self.assertLessEqual(chosen["error"], 0.03)
        self.assertEqual(chosen["verdict"], "chosen")
        self.expect(DONE, "run", "scene.toml", "-o", "whole", "-q")
        self.expect(DONE, "run", "planned.toml", "-o", "planned", "-q")
        self.expect(DONE, "verify", "planned")
        self.assertAlmostEqual(self.half_turn("planned") / self.half_turn("whole"), 1.0, delta=0.03)
        # Shapes are compared at equal shares of the centrelines, which have other numbers of sections.
        for at_most, code in (("0.03", 0), ("0.0005", 1)):
            compared = subprocess.run([(SOURCES / "tools/compare_runs.py").resolve(), "whole", "planned", "--at-most", at_most],
                                      cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(compared.returncode, code, compared.stdout + compared.stderr)

    def test_a_fiber_of_the_table_of_convergence_is_planned_by_it(self):
        """The paper's shortest one: its chain is 5.6 % off in perf/ladder.csv, four nodes are 1.2 %."""
        def plan(*words):
            scene = (SOURCES / "configs/lagrone2019_L0139.toml").resolve()
            result = skein("plan", scene, "--json", "-q", *words, cwd=self.folder, timeout=400)
            self.assertEqual(result.returncode, DONE, result.stderr)
            return json.loads(result.stdout)

        for words, rung in ((("--tolerance", "0.1"), 1), (("--tolerance", "0.03", "--within", "0.000001"), 4)):
            planned = plan(*words)
            self.assertTrue(planned["by_table"])
            self.assertEqual(planned["chosen"], rung)
            self.assertIn("table of convergence", planned["reason"])
        # Where no pilot has time to choose longer steps, they are the table's own.
        self.assertEqual(planned["time_tolerance"], 3e-5)
        self.assertEqual(planned["time_error"], 0)
        self.assertFalse(plan("--tolerance", "0.1", "--set", "time.end=3")["by_table"])

    def test_run_plans_and_runs(self):
        self.expect(DONE, "run", "scene.toml", "-o", "quick", "-q", "--plan", "0.1", "--set", "time.end=2.0")
        self.expect(DONE, "verify", "quick")
        nodes = int(re.search(r"nodes_per_section = (\d+)", (self.folder / "quick/scene.toml").read_text()).group(1))
        self.assertLess(nodes, 9)

    def test_a_fiber_that_nothing_bends_is_taken_for_rigid(self):
        code, plan = self.plan("--tolerance", "0.02", "--set", "fiber.spring_stiffness=2.0", "-o", "planned.toml")
        self.assertEqual(code, DONE, plan)
        self.assertEqual(plan["chosen"], 0)
        self.assertIn("contact: ", plan["known_contact"])
        self.assertIn('model = "rigid"', (self.folder / "planned.toml").read_text())
        self.expect(DONE, "run", "planned.toml", "-o", "planned", "-q")
        self.expect(DONE, "verify", "planned")
        for override, known in (("fiber.spring_stiffness=0.0245", "fails"), ("fiber.start_amplitude=0.01", "bent")):
            _, plan = self.plan("--tolerance", "0.2", "--set", override, "--set", "time.end=6")
            self.assertNotEqual(plan["chosen"], 0)
            self.assertIn(known, plan["candidates"][0]["verdict"])

    def test_a_tolerance_that_no_rung_meets_is_told_with_what_fails(self):
        code, plan = self.plan("--tolerance", "0.0001", "--for", "curvature_max", "--set", "time.end=1.0")
        self.assertEqual(code, NO_RUNG)
        self.assertIsNone(plan["chosen"])
        self.assertIn("curvature_max", plan["reason"])

    def test_no_time_for_pilots_is_told(self):
        code, plan = self.plan("--within", "0.000001")
        self.assertEqual(code, NO_RUNG)
        self.assertIn("more time", plan["reason"])

    def test_what_nobody_can_answer_is_refused(self):
        result = self.expect(USAGE, "plan", "scene.toml", "--for", "shape,colour")
        self.assertIn("'colour'", result.stderr)
        self.assertIn("half_period", result.stderr)
        self.expect(USAGE, "plan", "scene.toml", "--tolerance", "0")
        for number in ("nan", "-nan", "inf", "0", "-1", "1e-5", "x"):
            self.expect(USAGE, "run", "scene.toml", "-o", "x", "--plan", number)
            self.expect(USAGE, "plan", "scene.toml", "--tolerance", number)
            self.expect(USAGE, "phases", "-o", "x", "--from", number)
        self.expect(USAGE, "bench", "ladder", "-o", "x", "--lengths", "0.139,nan")
        for rung in ("2", "25", "6.0", "cable", "-6"):
            self.expect(USAGE, "phases", "-o", "x", "--rung", rung)
            self.expect(USAGE, "reproduce", "lagrone2019", "-o", "x", "--rung", rung)
        self.assertFalse((self.folder / "x").exists())

    def test_rungs_keep_the_scenes_symmetry_or_are_named(self):
        """An odd number of nodes on a section allows no half turn."""
        code, plan = self.plan("--tolerance", "0.1", "--set", "time.end=2.0", "--set", "fiber.nodes_per_section=12",
                               "--set", "fiber.sections=54", "--set", "symmetry.mirror=z", "--set",
                               "symmetry.half_turn=z", "-o", "planned.toml")
        self.assertEqual(code, DONE, plan)
        barred = [rung for rung in plan["candidates"] if rung["barred"]]
        self.assertEqual([rung["rung"] for rung in barred], ["5", "9"])
        for rung in barred:
            self.assertIn("half_turn", rung["verdict"])
            self.assertIn("no partner", rung["verdict"])
        self.assertIn('half_turn = "z"', (self.folder / "planned.toml").read_text())

    def test_a_fold_that_stays_where_it_is_does_not_snake(self):
        """A U-turn is folded for a while, but its fold travels by a third of its radius only."""
        code, plan = self.plan("--tolerance", "0.1", "--set", "fiber.sections=60", "--set", "fiber.start_amplitude=0.11",
                               "--set", "time.end=6.0")
        self.assertEqual(code, DONE, plan)
        chosen = next(c for c in plan["candidates"] if c["nodes_per_section"] == plan["chosen"])
        self.assertEqual(sorted(chosen["differences"]), ["shape"])

    def test_surfaces_that_are_pressed_into_each_other_are_no_answer_to_contact(self):
        """A fiber this soft folds; the chain in its place overlaps itself, tubes of it do not, and rigid it would not fold."""
        soft = ("--set", "fiber.nodes_per_section=6", "--set", "fiber.sections=60", "--set",
                "fiber.spring_stiffness=4e-4", "--set", "fiber.blob=0.00285")
        code, plan = self.plan("--tolerance", "0.1", "--for", "contact", *soft)
        self.assertEqual(code, DONE)
        self.assertEqual(plan["chosen"], 4)
        rigid, chain, tube = plan["candidates"][:3]
        self.assertEqual(rigid["verdict"], "not looked at")
        self.assertGreater(chain["contact"]["depth"], 0.1)
        self.assertGreater(chain["contact"]["first_inside"], 3.0)
        self.assertIn("pressed into each other", chain["verdict"])
        self.assertEqual(tube["contact"]["depth"], 0.0)

    def test_nothing_is_left_behind(self):
        before = self.snapshot(self.folder)
        self.plan("--tolerance", "0.1", "--set", "time.end=1.0")
        self.assertEqual(self.snapshot(self.folder), before)


if __name__ == "__main__":
    main()
