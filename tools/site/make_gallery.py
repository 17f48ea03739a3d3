#!/usr/bin/env python3
"""Runs the scenes that come with skein, draws them, and writes the part of the gallery's page that shows them.

make_gallery.py PROGRAM CONFIGS RUNS PARTS [--scenes all|none|NAME,...]

A run stays in RUNS as long as its scene does, and the page says which program made it; to have all anew, remove RUNS. PARTS/extra/gallery gets pictures and pages, PARTS/gallery.md
what the page of the gallery says.
"""

import argparse
import hashlib
import html
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

PICTURES = ("shapes", "curvature", "angle", "energy")
CAPTIONS = {"shapes": "shapes", "curvature": "curvature over arclength and time", "angle": "angle", "energy": "elastic energy"}
COST = re.compile(r"cost: ([\d.]+) s wall time.*?(\d+) steps.*?(\d+) evaluations of ([\d.e+-]+) ms", re.DOTALL)


def call(*words):
    """Of the program. @returns what it prints"""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"make_gallery.py: {' '.join(map(str, words))} ends with {done.returncode}:\n{done.stderr}")
    return done.stdout


def read_comment(text):
    """The words at the head of a scene, as Markdown."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        words = line.removeprefix("#")
        lines.append(f"`{words.strip()}`" if words.startswith("   ") else words.strip())  # a command stands farther in
    parts = re.split(r"(`[^`]*`)", "\n".join(lines).strip())
    return "".join(part if number % 2 else re.sub(r"([*_<$|])", r"\\\1", part) for number, part in enumerate(parts))


def make_run(program, scene, folder):
    """Runs, draws and shows a scene, unless what is there was made of the same."""
    made_of = hashlib.sha256(scene.read_bytes()).hexdigest()
    stamp = folder.with_suffix(".made_of")
    if stamp.exists() and stamp.read_text() == made_of and (folder / "plots/view.html").exists():
        return
    stamp.unlink(missing_ok=True)
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    print(f"gallery: {scene.stem}", flush=True)
    call(program, "run", scene, "-o", folder, "-q")
    call(program, "analyze", folder)
    call(program, "plot", folder)
    call(program, "view", folder)
    stamp.write_text(made_of)


def read_cost(folder):
    """In words: what the run took, as its cost card says."""
    log = (folder / "run.log").read_text(encoding="utf-8")
    found = COST.search(log)
    if not found:
        return "what it took is not in its log"
    seconds, steps, evaluations, milliseconds = found.groups()
    program = re.search(r"skein [\d.]+ \((\S+?)(?:-dirty)?\) on .*", log)
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file() and "plots" not in path.parts)
    return (f"{float(seconds):.3g} s; {steps} steps, {evaluations} evaluations of {milliseconds} ms; "
            f"{1e-6 * size:.3g} MB on disk" + (f"; by {program[0]}" if program else ""))


def describe_fibers(scene):
    fibers = scene.get("fiber", {})
    fibers = fibers if isinstance(fibers, list) else [fibers]
    count = scene.get("placement", {}).get("count", len(fibers))
    return f"{count} fiber{'s' if count > 1 else ''}"


def make_sweep(program, sweep, folder):
    """Runs what is open of a sweep, and draws it. Which runs are done the sweep itself knows."""
    print(f"gallery: {sweep.stem}, a sweep", flush=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    call(program, "sweep", sweep, "-o", folder, "-q")


def show_sweep(sweep, folder, target):
    text = sweep.read_text(encoding="utf-8")
    parts = [f"### {sweep.stem}", "", f"**{tomllib.loads(text)['title']}.** {read_comment(text)}", ""]
    pictures = sorted((folder / "pictures").glob("*.png")) if folder else []
    for picture in pictures:
        shutil.copy(picture, target / f"sweep_{sweep.stem}_{picture.name}")
    figures = [f'<figure><a href="../gallery/sweep_{sweep.stem}_{picture.name}"><img loading="lazy" alt="{sweep.stem}" '
               f'src="../gallery/sweep_{sweep.stem}_{picture.name}"></a></figure>' for picture in pictures]
    return "\n".join(parts + (['<div class="gallery">', *figures, "</div>", ""] if figures else []))


def show_scene(scene, run, target):
    text = scene.read_text(encoding="utf-8")
    content = tomllib.loads(text)
    parts = [f"## {scene.stem}", "", f"**{content.get('title', scene.stem)}.** {describe_fibers(content)}, to t = "
             f"{content['time']['end']:g}.", "", read_comment(text), "", "```sh", f"skein new {scene.stem}", "```", ""]
    if run is None:
        return "\n".join(parts)
    name = scene.stem
    shutil.copy(run / "plots/view.html", target / f"{name}.html")
    figures = []
    for picture in PICTURES:
        if (run / f"plots/{picture}.png").exists():
            shutil.copy(run / f"plots/{picture}.png", target / f"{name}_{picture}.png")
            figures.append(f'<figure><a href="../gallery/{name}_{picture}.png"><img loading="lazy" alt="{html.escape(name)}: '
                           f'{CAPTIONS[picture]}" src="../gallery/{name}_{picture}.png"></a></figure>')
    return "\n".join(parts + ['<div class="gallery">', *figures, "</div>", "",
                              f'<p>Took {html.escape(read_cost(run))}. '
                              f'<a href="../gallery/{name}.html">In three dimensions</a></p>', ""])


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    for name in ("configs", "runs", "parts"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--scenes", default="all", help="which are run; the others are listed without pictures")
    return parser.parse_args()


def main():
    options = parse_arguments()
    scenes = sorted(options.configs.glob("*.toml"))
    wanted = [scene.stem for scene in scenes] if options.scenes == "all" else options.scenes.split(",")
    if unknown := set(wanted) - {scene.stem for scene in scenes} - {"none"}:
        sys.exit(f"make_gallery.py: there are no scenes {sorted(unknown)} in {options.configs}")
    target = options.parts / "extra/gallery"
    target.mkdir(parents=True, exist_ok=True)
    shown = []
    for scene in scenes:
        run = options.runs / scene.stem if scene.stem in wanted else None
        if run is not None:
            make_run(options.program, scene, run)
        shown.append(show_scene(scene, run, target))
    shown += ["## Sweeps", "", "Many runs of one scene, in [configs/sweeps](../configs/sweeps) ([how](sweeps.md)).", ""]
    for sweep in sorted(options.configs.glob("sweeps/*.toml")):
        folder = options.runs / f"sweep_{sweep.stem}" if options.scenes == "all" else None
        if folder:
            make_sweep(options.program, sweep, folder)
        shown.append(show_sweep(sweep, folder, target))
    (options.parts / "gallery.md").write_text("\n".join(shown), encoding="utf-8")


if __name__ == "__main__":
    main()
