"""A scene with [symmetry] moves like the same scene without, stays symmetric to the last bit, and all verbs serve.

Called as check_symmetry.py SKEIN SCENE FOLDER; SCENE is the paper's fiber of length 0.196, which is run with six nodes on a
section until it has folded.
"""

import json
import pathlib
import shutil
import sys

import h5py
import numpy as np

from checks import certificate, check, kill_and_resume, run_command, skein

LENGTH, N_SECTIONS, N_AROUND = 0.22, 44, 6
TOLERANCE, END = 1e-4, 8.0
OVERRIDES = [f"fiber.sections={N_SECTIONS}", f"fiber.nodes_per_section={N_AROUND}", "fiber.blob=0.0045",
             "fiber.spring_stiffness=0.0409", f"time.end={END}", "output.frame_interval=0.5",
             "checkpoint.simulated_interval=0.25"]
SYMMETRY = ['symmetry.mirror="z"', 'symmetry.half_turn="z"']


def read_positions(folder):
    with h5py.File(folder / "trajectory.h5") as file:
        position = file["/particles/fibers/position/value"][()]
    return position.reshape(len(position), -1, N_AROUND, 3)


def check_symmetric(position):
    """Angle 0 is towards y: node a is mirrored onto node -a in z, and turned onto N/2 - a of the section at the other
    end."""
    nodes = np.arange(N_AROUND)
    mirrored = position[:, :, -nodes % N_AROUND] * np.array([1.0, 1.0, -1.0])
    check(np.array_equal(mirrored, position), "the run has left its plane of symmetry")
    turned = position[:, ::-1][:, :, (N_AROUND // 2 - nodes) % N_AROUND] * np.array([-1.0, -1.0, 1.0])
    check(np.array_equal(turned, position), "the run has lost its half turn")


def check_verbs(program, run, folder):
    report = skein(program, "analyze", run).stdout
    check("by assumption" in report, f"analyze sells the symmetry for a result: {report}")
    fiber = json.loads(skein(program, "analyze", run, "--json").stdout)["fibers"][0]
    check(fiber["out_of_plane"] < 1e-12 and fiber["symmetry_defect"] < 1e-12, f"defects {fiber}")
    check(fiber["energy_defect"] < 0.05, f"the power balance is open by {fiber['energy_defect']}")
    skein(program, "field", run, "-o", folder / "field.vti", "--points", 8)
    skein(program, "plot", run)
    skein(program, "info", run)


def check_going_on(program, run, folder):
    """The scene's symmetry is not a thing that a run may change; a new run may begin with the state, also without."""
    refused = skein(program, "resume", run, "--set", 'symmetry.mirror="none"', codes=(64,)).stderr
    check("mirror" in refused, f"resume: {refused}")
    skein(program, "resume", run, "-q", "--set", f"time.end={END + 0.1}")
    for name, overrides in (("free", ['symmetry.mirror="none"', 'symmetry.half_turn="none"']), ("kept", [])):
        shutil.rmtree(folder / name, ignore_errors=True)
        sets = [word for override in [f"time.end={END + 0.2}", *overrides] for word in ("--set", override)]
        skein(program, "run", "--from", run, "-o", folder / name, "-q", *sets)
    check_symmetric(read_positions(folder / "kept"))
    distance = np.abs(read_positions(folder / "kept")[-1] - read_positions(folder / "free")[-1]).max()
    check(distance < TOLERANCE * LENGTH, f"the run without symmetry is {distance} away")


def check_other_ways(program, scene, folder):
    """Implicit steps, the fast multipole method and chains are as symmetric."""
    short = [f"time.end={END / 4}"]
    for name, overrides in (("implicit", ['time.method="trbdf2"']),
                            ("fmm", ['hydrodynamics.method="fmm"', "hydrodynamics.tolerance=1e-3", "fiber.sections=300"])):
        skein(*run_command(program, scene, folder / name, OVERRIDES + SYMMETRY + short + overrides), "-q")
        check_symmetric(read_positions(folder / name))
    skein(*run_command(program, scene, folder / "chain", SYMMETRY + short + ['fiber.model="chain"']), "-q")
    with h5py.File(folder / "chain" / "trajectory.h5") as file:
        line = file["/particles/fibers/position/value"][()]
    check(not line[:, :, 2].any(), "the chain has left its plane")
    check(np.array_equal(line[:, ::-1] * np.array([-1.0, -1.0, 1.0]), line), "the chain has lost its half turn")


def check_unsymmetric_state(program, scene, folder):
    """A state that never was symmetric is refused, at the key."""
    bent = folder / "bent"
    skein(*run_command(program, scene, bent, ["time.end=0.01", "fiber.start_noise=1e-4", "fiber.sections=20"]), "-q")
    file = folder / "symmetric.toml"
    file.write_text('[fiber]\nsections = 20\n[symmetry]\nhalf_turn = "none"\nmirror = "z"\n')
    refused = skein(program, "run", "--from", bent, file, "-o", folder / "x", codes=(78,)).stderr
    check(f"{file}:5:10" in refused and "not symmetric" in refused, f"a state without symmetry: {refused}")
    check(not (folder / "x").exists(), "the refused run has a folder")


def main():
    program, scene, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(exist_ok=True)
    whole, killed, full = folder / "whole", folder / "killed", folder / "full"
    said = skein(*run_command(program, scene, whole, OVERRIDES + SYMMETRY)).stderr
    check("no result" in said, f"the run does not say what it takes for granted: {said}")
    check("times fewer pairs" in said, f"the run does not say how it sums: {said}")
    kill_and_resume(run_command(program, scene, killed, OVERRIDES + SYMMETRY), killed)
    check(certificate(program, whole) == certificate(program, killed), "a killed run goes on otherwise")
    skein(*run_command(program, scene, full, OVERRIDES), "-q")

    position = read_positions(whole)
    check_symmetric(position)
    distance = np.abs(position - read_positions(full)).max()
    check(distance < TOLERANCE * END * LENGTH, f"the run without symmetry is {distance} away")
    check_verbs(program, whole, folder)
    check_going_on(program, killed, folder)
    check_unsymmetric_state(program, scene, folder)
    check_other_ways(program, scene, folder)


main()
