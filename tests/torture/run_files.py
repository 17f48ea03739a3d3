"""Run folders as the torture reads them: with h5py, and checkpoints with a decoder written from their description."""

import pathlib
import struct

import h5py

from program import DONE, require


def read_arrays(folder):
    """Every frame and every step record of a run, as bytes by name."""
    arrays = {}
    with h5py.File(pathlib.Path(folder) / "trajectory.h5", "r") as file:
        for group in ("particles", "observables"):

            def keep(name, item, group=group):
                if isinstance(item, h5py.Dataset):
                    arrays[f"{group}/{name}"] = item[()].tobytes()

            file[group].visititems(keep)
    assert len(arrays) > 12, f"hardly anything to compare in {folder}"
    return arrays


def step_times(folder):
    with h5py.File(pathlib.Path(folder) / "trajectory.h5", "r") as file:
        return tuple(float(time) for time in file["observables/energy/time"][()])


def checkpoints(folder):
    return sorted((pathlib.Path(folder) / "checkpoints").glob("*.checkpoint"))


def read_checkpoint(path):
    """The values of a checkpoint by name. The checksum is skein's to check."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89SKEIN\r\n", path
    _, n_values, size = struct.unpack_from("<IIQ", data, 8)
    assert size == len(data), path
    values, at = {}, 24

    def padded(n_bytes):
        return (n_bytes + 7) // 8 * 8

    for _ in range(n_values):
        kind, name_size, count = struct.unpack_from("<IIQ", data, at)
        at += 16
        name = data[at : at + name_size].decode()
        at += padded(name_size)
        if kind == 2:
            values[name] = data[at : at + count].decode()
            at += padded(count)
        else:
            values[name] = list(struct.unpack_from(f"<{count}{'dq'[kind]}", data, at))
            at += 8 * count
    assert at + 16 == len(data), path
    return values


# What a run's history may change without changing the run.
HISTORY = ("run.seconds", "program.", "trajectory.segments", "trajectory.xxh3")


def as_bytes(value):
    if isinstance(value, str):
        return value.encode()
    kind = "q" if value and isinstance(value[0], int) else "d"
    return struct.pack(f"<{len(value)}{kind}", *value)


def final_state(folder):
    """What two runs must share in every bit: frames, step records, and the memory from which they would go on."""
    values = read_checkpoint(checkpoints(folder)[-1])
    memory = {name: as_bytes(value) for name, value in values.items() if not name.startswith(HISTORY)}
    return {**read_arrays(folder), **memory}


def differences(folder, reference):
    found = final_state(folder)
    return sorted(name for name in {*reference, *found} if reference.get(name) != found.get(name))


def run_unbroken(program):
    """The final state of a run that nothing happens to: what every other one is compared with."""
    folder = program.fresh("unbroken")
    require(program.run(folder).returncode == DONE, "the unbroken run fails")
    return final_state(folder)
