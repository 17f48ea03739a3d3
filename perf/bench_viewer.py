#!/usr/bin/python3
"""How large the viewer's pages are, how long they take to open, and how many pictures a second they play.

bench_viewer.py SKEIN FOLDER [CHROMIUM]: makes the runs of the table in FOLDER, where they are not there yet (three minutes), shows
each by `skein view`, opens the page from the disk in headless Chromium, plays it, and leaves a picture of it in FOLDER. WebGL is
drawn by the processor there (SwiftShader): a graphics card is faster. Pictures are counted by requestAnimationFrame, which a
screen bounds at 60 a second.
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from browser import Browser

CONFIGS = pathlib.Path(__file__).resolve().parent.parent / "configs"
RUNS = {
    "tangle": ("lagrone2019_L228", {}, "t=110&camera=oblique"),
    "suspension": ("random_suspension", {
        "fiber.model": "chain", "placement.count": 200, "placement.box": [0.4, 0.3, 0.3]}, "t=2.5&camera=oblique"),
    "thousand": ("lagrone2019_L0196", {
        "fiber.nodes_per_section": 4, "fiber.spacing": 0.00173648, "fiber.spring_stiffness": 0.14,
        "output.frame_interval": 0.015}, "t=6.5"),
}
PLAY = """new Promise((resolve) => {
  const times = [];
  document.getElementById("play").click();
  const count = (now) => { times.push(now); times.length < 2 || now - times[0] < SECONDS * 1e3 ?
    requestAnimationFrame(count) : resolve(times); };
  requestAnimationFrame(count);
})"""
SECONDS = 6


def make_page(skein, folder, name):
    config, changes, _ = RUNS[name]
    run = folder / name
    if not (run / "trajectory.h5").exists():
        sets = [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
        subprocess.run([skein, "run", CONFIGS / f"{config}.toml", "-o", run, "-q", *sets], check=True)
    page = folder / f"{name}.html"
    said = subprocess.run([skein, "view", run, "-o", page], check=True, capture_output=True, text=True).stderr
    return page, said.strip().removeprefix("skein view: ")


def measure(chromium, page, place, picture):
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(chromium, profile)
        try:
            seconds = browser.open(f"file://{page}#{place}")
            drawn = float(browser.evaluate("document.body.dataset.seconds"))
            browser.take_picture(picture)
            times = browser.evaluate(PLAY.replace("SECONDS", str(SECONDS)))
            said = [line for line in browser.said if "GPU stall" not in line]
        finally:
            browser.close()
    apart = sorted(b - a for a, b in zip(times, times[1:]))
    return seconds, drawn, len(apart) / (times[-1] - times[0]) * 1e3, statistics.median(apart), apart[-1], said


def main(skein, folder, chromium=shutil.which("chromium")):
    folder = pathlib.Path(folder).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    print("run,page,opened in s,of which drawing s,pictures/s,median ms,longest ms")
    for name, (_, _, place) in RUNS.items():
        page, words = make_page(skein, folder, name)
        opened, drawn, rate, median, longest, said = measure(chromium, page, place, folder / f"{name}.png")
        print(f"{name},\"{words}\",{opened:.2f},{drawn:.2f},{rate:.0f},{median:.1f},{longest:.1f}", flush=True)
        if said:
            sys.exit(f"the console says: {said}")
    return 0


if __name__ == "__main__":
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    sys.exit(main(*sys.argv[1:]))
