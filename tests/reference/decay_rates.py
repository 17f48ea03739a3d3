"""Rates at which the straight fiber's small motions decay, and forward Euler's limit. Takes half a minute.

The rates are those of dx/dt = -M K x (angular_modes.py), in 1 / time. Forward Euler is stable below 2 over the largest.

Numbers for tests/accuracy/test_decay_rates.cpp and tests/stability/test_euler_limit.cpp.
"""

import numpy as np

import straight_tube as tube
from angular_modes import SmallMotions

SECTIONS = 80
N_MODES = tube.NODES_PER_SECTION // 2 + 1


def rates_along(rates, motions, component):
    """Rates of motions that go mostly along x (0), outwards (1) or around (2), without those of rigid motions."""
    parts = np.sum(np.abs(motions[component::3])**2, axis=0) / np.sum(np.abs(motions)**2, axis=0)
    return rates[(parts > 0.5) & (rates > 1e-7 * rates[-1])]


def largest_rates(sections, blob):
    """The largest rate of each mode."""
    motions = SmallMotions(sections, blob)
    return np.array([motions.decay(mode)[0][-1] for mode in range(N_MODES)])


def main():
    small = SmallMotions(SECTIONS)
    modes = [small.decay(mode) for mode in range(4)]
    show = lambda values: ", ".join(f"{value:.6g}" for value in values)
    print(f"bending: {show(modes[1][0][2:4])}")
    print(f"stretching: {show(rates_along(*modes[0], 0)[:4])}")
    print(f"torsion: {show(rates_along(*modes[0], 2)[:2])}")
    print(f"warping of sections, mode 1: {show(rates_along(*modes[1], 0)[:1])}")
    print(f"slowest of mode 2: {show(modes[2][0][:1])}; outwards: {show(rates_along(*modes[2], 1)[:1])}")
    for sections, blob_ratio in ((80, 1.0), (80, 0.5), (80, 2.0), (40, 1.0), (113, 1.0)):
        largest = largest_rates(sections, blob_ratio * tube.BLOB)
        print(f"{sections} sections, blob times {blob_ratio:g}: largest rate of modes 0 to 3: {show(largest[:4])}; "
              f"of all: {largest.max():.6g} in mode {largest.argmax()}; Euler's limit {2.0 / largest.max():.4g}")


if __name__ == "__main__":
    main()
