"""The viewer's page and the report: check_view.py PROGRAM SOURCES [CHROMIUM]."""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from cli_case import CANNOT_CREATE, DONE, MISSING_INPUT, SMALL_SCENE, InFreshFolder, main

CHROMIUM = sys.argv[3] if len(sys.argv) > 3 else None
MEGABYTE = 1 << 20


def numbers(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


def read_view(page):
    return json.loads(re.search(r'<script type="application/json" id="view">(.*?)</script>', page, re.S)[1])


class Page(InFreshFolder):
    def make_page(self, *arguments, verb="view", scene=SMALL_SCENE):
        self.write(scene, "small.toml")
        self.expect(DONE, "run", "small.toml", "-o", "run", "-q")
        result = self.expect(DONE, verb, "run", *arguments, timeout=300)
        path = self.folder / result.stdout.rstrip("\n")
        self.assertTrue(path.is_file(), result)
        return path

    def test_it_needs_no_other_file(self):
        page = self.make_page().read_text()
        self.assertFalse(re.findall(r"<(?:script|img|iframe|audio|video)\b[^>]*\bsrc=\"(?!data:)", page))
        self.assertFalse(re.findall(r"<link\b[^>]*href=\"(?!data:)", page))
        self.assertFalse(re.findall(r"@import|url\((?!['\"]?data:)", read_style(page)))
        self.assertLess(len(page), 2 * MEGABYTE)

    def test_it_holds_the_frames(self):
        view = read_view(self.make_page().read_text())
        with h5py.File(self.folder / "run/trajectory.h5") as file:
            lines = file["observables/centreline/value"][()]
        with h5py.File(self.folder / "run/analysis/diagnostics.h5") as file:
            curvature = file["fiber_0/signed_curvature"][()]
        steps = numbers(view["places"]["steps"], "<u2").reshape(lines.shape).astype(float)
        half, middles = view["places"]["half"], numbers(view["places"]["middles"], "<f4").reshape(-1, 1, 3)
        found = (steps / 65535.0 * 2.0 - 1.0) * half + middles
        self.assertLess(np.abs(found - lines).max(), 2.0 * half / 65535.0)
        self.assertLess(2.0 * half / 65535.0, 1e-3 * view["radius"][0])
        shown = numbers(view["curvature"]["steps"], "<u2").reshape(curvature.shape) / 65534.0
        span = view["curvature"]["high"] - view["curvature"]["low"]
        self.assertTrue(view["curvature"]["signed"])
        self.assertLess(np.abs(view["curvature"]["low"] + shown * span - curvature).max(), span / 65534.0)
        self.assertEqual((view["times"][0], view["times"][-1], view["points"]), (0.0, 0.3, [10]))
        flow = view["flow"]
        points, velocities = numbers(flow["points"], "<f4").reshape(-1, 3), numbers(flow["velocities"], "<f4").reshape(-1, 3)
        np.testing.assert_allclose(velocities[:, 0], 2.5 * points[:, 1], rtol=1e-6, atol=1e-9)
        self.assertFalse(velocities[:, 1:].any())
        self.assertLess(points.min(axis=0)[0], lines[..., 0].min())

    def test_no_text_of_a_run_becomes_a_part_of_the_page(self):
        title = "</script><script>document.title='taken'</script>@view@&amp;"
        page = self.make_page(scene=SMALL_SCENE.replace('"small"', f'"{title}"')).read_text()
        self.assertNotIn("<script>document.title", page)
        self.assertEqual(len(re.findall(r"<script\b", page)), len(re.findall(r"</script>", page)))
        self.assertEqual(read_view(page)["title"], title)

    def test_a_flow_with_a_course_and_one_that_is_not_there(self):
        for flow, n_times in (('kind = "none"', 0), ("angular_frequency = 30.0", 4)):
            with self.subTest(flow):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                view = read_view(self.make_page(scene=SMALL_SCENE + f"[flow]\n{flow}\n").read_text())
                self.assertEqual(len(view["flow"]["times"]) if "flow" in view else 0, n_times)

    def test_a_page_elsewhere_leaves_the_run_as_it_is(self):
        self.make_run()
        before = self.snapshot(self.folder / "run")
        self.expect(DONE, "view", "run", "-o", "pages/new.html", timeout=300)
        self.assertEqual(self.snapshot(self.folder / "run"), before)
        self.assertTrue((self.folder / "pages/new.html").is_file())
        self.expect(CANNOT_CREATE, "view", "run", "-o", "run/scene.toml")
        self.expect(MISSING_INPUT, "view", "nowhere")
        self.expect(DONE, "view", "run", timeout=300)
        self.expect(DONE, "run", "small.toml", "-o", "run", "-q", "--overwrite")  # the page goes with the run
        self.assertFalse((self.folder / "run/plots").exists())

    def test_a_report_has_all_that_is_known(self):
        page = self.make_page(verb="report").read_text()
        certificate = re.search(r"certificate: (\w+)", self.expect(DONE, "verify", "run").stdout)[0]
        self.assertIn(certificate, page)
        self.assertIn("verdict: whole", page)
        self.assertGreater(len(re.findall(r'<img src="data:image/png;base64,', page)), 4)
        for line in self.expect(DONE, "analyze", "run").stdout.splitlines()[:3]:
            self.assertIn(line.split("  ")[0].replace("&", "&amp;").replace(">", "&gt;"), page)
        self.assertIn("evaluations", page)  # of the cost card
        self.assertLess(len(page), 6 * MEGABYTE)

    @unittest.skipUnless(CHROMIUM, "there is no Chromium")
    def test_it_draws_and_plays_in_a_browser(self):
        cloud = '[placement]\nkind = "grid"\ngrid = [3.0, 2.0, 1.0]\nspacing = [0.1, 0.05, 0.05]\n'
        for scene, least in ((SMALL_SCENE, 500), (SMALL_SCENE + cloud, 2000)):
            with self.subTest(scene):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                page = self.make_page(scene=scene)
                result = subprocess.run(
                    [CHROMIUM, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     f"--user-data-dir={self.folder / 'profile'}", "--window-size=900,600", "--enable-logging=stderr",
                     "--virtual-time-budget=8000", "--dump-dom", f"file://{page}#check"],
                    capture_output=True, text=True, timeout=400, env={**os.environ, "HOME": str(self.folder)})
                said = [line for line in result.stderr.splitlines() if "CONSOLE" in line]
                self.assertEqual([line for line in said if "GPU stall" not in line], [])
                body = dict(re.findall(r'data-(\w+)="([^"]*)"', re.search(r"<body[^>]*>", result.stdout)[0]))
                self.assertGreater(int(body["coloured"]), least, body)  # pixels
                self.assertGreater(int(body["played"]), 1, body)
                self.assertEqual(body["frame"], "3", body)


def read_style(page):
    return re.search(r"<style>(.*?)</style>", page, re.S)[1]


if __name__ == "__main__":
    main()
