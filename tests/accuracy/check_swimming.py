"""A tube with a travelling wave of preferred curvature swims as surface nodes do that are given this motion, and as theory says.

Called as check_swimming.py PROGRAM [--fine], or with a scene that has one wave on one fiber. The dense reference shares nothing
with the program: it moves plane sections along a centreline of the preferred curvature and solves for forces without sum and
torque. The theory is G. I. Taylor's of 1952 (Proc. R. Soc. A 211, 225), for any radius and for sections that turn with the
centreline; its K0 formula is what it comes to where the radius is small against the wave.
"""

import pathlib
import sys
import tomllib

import numpy as np

from dense_stokes import Claims, make_mobility, make_rigid_motions, mean_velocity, place_tube, run, solve_rigid, write_tube

SMALL = {"sections": 33, "nodes_per_section": 4, "radius": 0.005, "blob": 0.0035, "spring_stiffness": 6.0, "spacing": 0.006,
         "curvature": 12.0, "wavelength": 0.1, "end": 2.5}


def write_scene(of):
    return f"""[flow]
kind = "none"
[fiber]
{write_tube(of["sections"], of["nodes_per_section"], of["radius"], of["blob"], of["spacing"], of["spring_stiffness"])}
[[undulation]]
curvature = {of["curvature"]}
wavelength = {of["wavelength"]}
angular_frequency = {2 * np.pi}
ramp = 0.5
[time]
method = "trbdf2"
tolerance = {of.get("tolerance", 1e-5)}
end = {of["end"]}
[output]
frame_interval = 0.0625
"""


def place_nodes(fiber, wave, time):
    """[n_nodes, 3]: plane sections across a centreline that has the preferred curvature."""
    h, n_sections, n = fiber["spacing"], fiber["sections"], fiber["nodes_per_section"]
    halfway = h * (np.arange(n_sections - 1) + 0.5)
    curvature = wave["curvature"] * np.cos(2 * np.pi * halfway / wave["wavelength"] - wave["angular_frequency"] * time)
    section = np.r_[0, np.cumsum(curvature * h)]
    link = (section[1:] + section[:-1]) / 2
    x, y = np.r_[0, np.cumsum(np.cos(link) * h)], np.r_[0, np.cumsum(np.sin(link) * h)]
    angle = 2 * np.pi * np.arange(n) / n
    across = fiber["radius"] * np.cos(angle)
    nodes = np.stack([x[:, None] - np.sin(section)[:, None] * across, y[:, None] + np.cos(section)[:, None] * across,
                      np.broadcast_to(fiber["radius"] * np.sin(angle), (n_sections, n))], axis=-1).reshape(-1, 3)
    return nodes - nodes.mean(axis=0) * [1, 1, 0]


def swim(fiber, wave, n_times=16, step=1e-5):
    """Speed along the line on which it swims, and power spent, means of a period, in a fluid of viscosity 1."""
    period = 2 * np.pi / wave["angular_frequency"]
    angle, moved, power = 0.0, np.zeros(2), 0.0
    for time in np.arange(n_times) * period / n_times:
        nodes = place_nodes(fiber, wave, time)
        velocity = (place_nodes(fiber, wave, time + step) - place_nodes(fiber, wave, time - step)).T.reshape(-1) / (2 * step)
        rigid = make_rigid_motions(nodes)[:, [0, 1, 5]]
        solved = np.linalg.solve(make_mobility(nodes, fiber["blob"]), np.c_[velocity, rigid])
        motion = -np.linalg.solve(rigid.T @ solved[:, 1:], rigid.T @ solved[:, 0])
        u, v, turn = motion
        power += (solved[:, 0] + solved[:, 1:] @ motion) @ velocity / n_times
        moved += np.array([np.cos(angle) * u - np.sin(angle) * v, np.sin(angle) * u + np.cos(angle) * v]) / n_times
        angle += turn * period / n_times
    # Only the line along which it swims is the same: the reference starts with its first link along x.
    return np.hypot(*moved), power


def check_dense(program, claims, text, within):
    config = tomllib.loads(text)
    fiber, wave = config["fiber"], config.get("undulation", [{}])[0]
    time, position, columns, summary = run(program, text)
    velocity = mean_velocity(time, position, time[-1] - 2 * np.pi / wave["angular_frequency"], time[-1])
    speed, power = swim(fiber, wave)
    claims.compare("a swimmer's speed against its wave", -velocity[0], speed, "given nodes in dense matrices", within)
    claims.check("... sideways, over the speed", velocity[1] / speed, 0.02)
    claims.check("... out of its plane, over the speed", velocity[2] / speed, 1e-9)
    swimming = summary["fibers"][0]["swimming"]
    straight = place_tube(fiber["sections"], fiber["nodes_per_section"], fiber["radius"], fiber["spacing"])
    towing = solve_rigid([straight], fiber["blob"])[1][0, 0] * speed**2
    claims.compare("... mean power", swimming["power"], power, "given nodes in dense matrices", 2 * within)
    claims.compare("... efficiency", swimming["efficiency"], towing / power, "dense matrices", 2 * within)
    check_balance(claims, columns[0], fiber)


def check_balance(claims, columns, fiber):
    """No force and no torque from outside, but for rounding: of springs as strong as their stiffness."""
    scale = fiber["spring_stiffness"]
    force = max(abs(columns[name]).max() for name in ("force_x", "force_y", "force_z"))
    torque = max(abs(columns[name]).max() for name in ("torque_x", "torque_y", "torque_z"))
    claims.check("... sum of its forces over the stiffness of a spring", force / scale, 1e-12)
    claims.check("... torque over that times its length", torque / (scale * fiber["sections"] * fiber["spacing"]), 1e-12)


def bessel_k(order, z):
    """The modified Bessel function of the second kind, as an integral."""
    t = np.linspace(0, 15, 6001)
    return np.trapz(np.exp(-z * np.cosh(t)) * np.cosh(order * t), t)


def taylors_factor(wave_number, is_turning=True):
    """Speed over that of the wave and half of the square of its slope, for an endless cylinder of radius 1.

    First order: Stokes flow outside of it with the velocity of the surface, displaced by (cos, -sin, -i k cos if sections turn)
    along r, the angle and x, times exp(i (k x - t)). Second order: the mean of (displacement . grad) u_x on the surface.
    """
    k = wave_number

    def modes(r):
        """Components by the harmonic functions of r d/dr(grad Pi) + (0, 0, d Pi/dx) + grad Psi + curl (0, 0, Omega)."""
        k0, k1, k2, k3 = (bessel_k(n, k * r) for n in range(4))
        slope, second = -k * (k0 + k2) / 2, k**2 * (3 * k1 + k3) / 4
        return np.array([[r * second, slope, k1 / r], [k1 / r - slope, -k1 / r, -slope],
                         [1j * k * (r * slope + k1), 1j * k * k1, 0]])

    displaced = np.array([1, -1, -1j * k if is_turning else 0])
    strengths = np.linalg.solve(modes(1), -1j * displaced)
    step = 1e-4
    along_r = ((modes(1 + step) - modes(1 - step)) / (2 * step) @ strengths)[2]
    u_x = (modes(1) @ strengths)[2]
    slip = np.real(np.conj(displaced[0]) * along_r - np.conj(displaced[1]) * u_x + np.conj(displaced[2]) * 1j * k * u_x) / 4
    return -slip / (k**2 / 2) * k


def find_thickness(fiber):
    """Radius of the cylinder of 60 radii that slender-body theory gives the tube's drag across itself."""
    radius = fiber["radius"]
    sections = round(60 * radius / fiber["spacing"])
    length = sections * fiber["spacing"]
    tube = place_tube(sections, fiber["nodes_per_section"], radius, fiber["spacing"])
    drag = solve_rigid([tube], fiber["blob"])[1][1, 1]
    return length * 2 * np.exp(-0.5 - 4 * np.pi * length / drag)


def check_taylor(program, claims, wave_number, n_waves, slope=0.1):
    """@param wave_number  times the radius of sections"""
    radius, wavelength = 0.005, 2 * np.pi * 0.005 / wave_number
    k = wave_number / radius
    # So stiff that the fluid takes a few per cent of the wave, in quadrature with it.
    fiber = {"sections": round(n_waves * wavelength / radius) + 1, "nodes_per_section": 6, "radius": radius, "blob": 0.00285,
             "spacing": radius, "spring_stiffness": 6.4e6 / k**4, "curvature": slope * k, "wavelength": wavelength, "end": 1.5, "tolerance": 1e-6}
    time, position, columns, _ = run(program, write_scene(fiber))
    speed = -mean_velocity(time, position, 0.5, 1.5)[0]
    thickness = wave_number * find_thickness(fiber) / radius
    by_theory = slope**2 / 2 * wavelength * taylors_factor(thickness)
    k0 = bessel_k(0, thickness)
    print(f"a tube of {n_waves} waves, kR = {thickness:.3g} by its drag, kb = {slope}")
    claims.compare("speed", speed, by_theory * (1 - 12 / (2 * np.pi * n_waves)**2), "Taylor 1952, and the sway of a free fiber", 0.05)
    claims.compare("...", speed, by_theory, "Taylor 1952 with turning sections, endless", 0.06)
    claims.compare("...", speed, slope**2 / 2 * wavelength * (k0 - 0.5) / (k0 + 0.5), "Taylor's K0 formula, endless", 0.06 if wave_number <= 0.1 else 0.2)
    check_balance(claims, columns[0], fiber)


def main(program, option=""):
    claims = Claims()
    if option.endswith(".toml"):
        check_dense(program, claims, pathlib.Path(option).read_text(encoding="utf-8"), 0.01)
        return claims.finish()
    check_dense(program, claims, write_scene(SMALL), 0.04)
    # Ends make a fiber of n waves slower by about 0.2 / n.
    check_taylor(program, claims, 0.1 if option == "--fine" else 0.25, 12)
    return claims.finish()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
