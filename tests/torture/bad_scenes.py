"""Mutated scenes: refused with line and column, or valid; never a crash or a hang, and nothing written."""

import concurrent.futures
import random
import re

from program import DONE, MISSING, SCENE_ERROR, require

VALUES = ["nan", "inf", "-inf", "-1", "0", "1e300", "-1e300", "1e-300", "true", '"word"', "[]", "{}", "[1, 2]",
          "99999999999999999999", "1979-05-27", "''", "0x10", "[nan, 0, 0]", ""]
PIECES = [b'"', b"'", b"[", b"]", b"{", b"}", b"=", b".", b"\n", b"#", b"\x00", b"\xff", b"\xc3", b"\\u0", b'"""',
          b"[[fiber]]"]


def change_value(lines, draw):
    at = draw.choice([i for i, line in enumerate(lines) if b" = " in line])
    lines[at] = lines[at].split(b" = ")[0] + b" = " + draw.choice(VALUES).encode()


def change_key(lines, draw):
    at = draw.choice([i for i, line in enumerate(lines) if b" = " in line])
    key, value = lines[at].split(b" = ", 1)
    cut = draw.randrange(len(key))
    lines[at] = key[:cut] + bytes([draw.randrange(97, 123)]) + key[cut + 1 :] + b" = " + value


def change_bytes(lines, draw):
    text = b"\n".join(lines)
    for _ in range(draw.randint(1, 4)):
        at = draw.randrange(len(text) + 1)
        kind = draw.randrange(4)
        if kind == 0:
            text = text[:at] + draw.choice(PIECES) + text[at:]
        elif kind == 1:
            text = text[:at] + text[at + draw.randint(1, 40) :]
        elif kind == 2:
            text = text[:at] + draw.randbytes(draw.randint(1, 3)) + text[at:]
        else:
            text = text[:at] + text[draw.randrange(len(text) + 1) :][: draw.randint(0, 60)] + text[at:]
    lines[:] = text.split(b"\n")


def mutate(scene, draw):
    if draw.random() < 0.01:
        return b"" if draw.random() < 0.5 else draw.randbytes(300)
    lines = scene.split(b"\n")
    for _ in range(draw.randint(1, 2)):
        draw.choice([change_value, change_key, change_bytes, change_bytes])(lines, draw)
        if not any(b" = " in line for line in lines):
            break
    return b"\n".join(lines)


def judge(program, number, scene):
    path = program.folder / f"mutated_{number % 8}" / "scene.toml"
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(scene)
    output = path.parent / "result"
    result = program.call([program.path, "validate", path], timeout=20)
    valid = result.returncode == DONE
    known = valid or result.returncode in (SCENE_ERROR, MISSING)
    require(known, f"scene {number}: exit code {result.returncode}: {result.stderr}\n{scene!r}")
    if not valid:
        named = re.search(r"scene\.toml:\d+:\d+:", result.stderr)
        require(named, f"scene {number}: no place is named: {result.stderr}")
        if number % 10 == 0:
            refused = program.call([program.path, "run", path, "-o", output], timeout=20)
            require(refused.returncode == result.returncode, f"scene {number}: run says {refused.returncode}")
    require(not output.exists(), f"scene {number}: something was written")
    require(sorted(p.name for p in path.parent.iterdir()) == ["scene.toml"], f"scene {number}: something was written")
    return valid


def torture(program, counts, seed=6):
    draw = random.Random(seed)
    valid_scene = program.call([program.path, "defaults"]).stdout
    plain = b"\n".join(line for line in valid_scene.encode().split(b"\n") if not line.startswith(b"#"))
    scenes = [mutate(plain, draw) for _ in range(counts["scenes"])]

    def judge_half(part):  # even and odd numbers use different folders
        return sum(judge(program, number, scenes[number]) for number in range(part, len(scenes), 2))

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        n_valid = sum(pool.map(judge_half, (0, 1)))
    require(n_valid < 0.6 * len(scenes), f"{n_valid} of {len(scenes)} mutations are valid: they are too tame")
    return len(scenes), f"{len(scenes) - n_valid} refused, {n_valid} valid after all"
