#!/usr/bin/python3
"""The scaling model beside sums that ranks share over networks of a known latency and bandwidth, on one machine.

Usage, as root: shaped_network.py BENCH_RANKS [ranks=2,4] [nodes=100000] [points=0.2ms:100Mbit/s,5ms:1Gbit/s]

Each rank is in a network namespace of its own, with a link of its own (perf/shaped_links.py); Open MPI talks TCP. What a
link does is measured by a stream of bytes and by answers to single ones before ranks use it, and the model is told these
numbers. Its other numbers come from one rank alone, and from bytes and messages, which no network changes. Ranks share this machine's
processors: the model divides work by as many of them as there are."""

import csv
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

from scaling_model import Model
from shaped_links import DEVICE, ShapedNetwork, address_of

REPEATS = 4
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1.0, "Mbit/s": 1e6 / 8.0, "Gbit/s": 1e9 / 8.0}
# Starts a daemon of Open MPI, as ssh would on another machine; the names keep daemons from taking each other for one machine.
AGENT = """#!/bin/sh
number=$((${{1##*.}} - 1))
shift
exec ip netns exec {prefix}-$number unshare --uts sh -c "hostname rank$number; $*"
"""
ANSWERING = """
import socket
line, _ = socket.create_server(("", 5001)).accept()
line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
for _ in range(40): line.sendall(line.recv(1))
for _ in range(3):
    left = {n_bytes}
    while left > 0: left -= len(line.recv(1 << 20))
    line.sendall(b"x")
"""
ASKING = """
import socket, time
for _ in range(100):
    try:
        line = socket.create_connection(("{address}", 5001))
        break
    except OSError:
        time.sleep(0.05)
line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
def ask(question):
    start = time.monotonic()
    line.sendall(question)
    line.recv(1)
    return time.monotonic() - start
latency = 0.5 * sorted(ask(b"x") for _ in range(40))[20]
print(latency, {n_bytes} / (min(ask(b"x" * {n_bytes}) for _ in range(3)) - 2.0 * latency))
"""


def read_quantity(text):
    unit = text.lstrip("0123456789.")
    if unit not in UNITS:
        sys.exit(f"shaped_network.py: {text} has none of the units {', '.join(UNITS)}")
    return float(text.removesuffix(unit)) * UNITS[unit]


def rows_of(text):
    lines = [line for line in text.splitlines() if "," in line and not line.startswith("#")]
    return [{name: value if name == "sum" else float(value) for name, value in row.items()} for row in csv.DictReader(lines)]


def measure_link(network, bandwidth):
    n_bytes = int(0.5 * bandwidth)  # half a second
    inside = [["ip", "netns", "exec", namespace, sys.executable, "-c"] for namespace in network.namespaces]
    answering = subprocess.Popen([*inside[1], ANSWERING.format(n_bytes=n_bytes)])
    asked = subprocess.run([*inside[0], ASKING.format(n_bytes=n_bytes, address=address_of(1))], capture_output=True, text=True,
                           check=True, timeout=120)
    answering.wait()
    return [float(word) for word in asked.stdout.split()]


def run_bench(bench, n_nodes, network, folder):
    """@returns its line for one rank without a network, or for a rank in each namespace"""
    words = [bench, "cube", f"only={n_nodes}", f"repeats={REPEATS}"]
    if network is None:
        command = ["mpirun", "-n", "1", *words]
    else:
        agent = pathlib.Path(folder) / "agent"
        agent.write_text(AGENT.format(prefix=network.namespaces[0].rsplit("-", 1)[0]), encoding="ascii")
        agent.chmod(0o755)
        hosts = ",".join(address_of(number) for number in range(len(network.namespaces)))
        command = ["ip", "netns", "exec", network.namespaces[0], "unshare", "--uts", "sh", "-c", 'hostname rank0; exec "$@"', "sh",
                   "mpirun", "-n", str(len(network.namespaces)), "--host", hosts, "--bind-to", "none", "-x", "OMP_NUM_THREADS"]
        for name, value in (("plm_rsh_agent", agent), ("btl", "tcp,self"), ("pml", "ob1"), ("btl_tcp_if_include", DEVICE),
                            ("oob_tcp_if_include", DEVICE)):
            command += ["--mca", name, str(value)]
        command += words
    done = subprocess.run(command, capture_output=True, text=True, env=ENVIRONMENT, timeout=300, stdin=subprocess.DEVNULL)
    rows = [row for row in rows_of(done.stdout) if row["sum"] == "cube"]
    if not rows:
        sys.exit(f"shaped_network.py: no line of {' '.join(command)}:\n{done.stdout}{done.stderr}")
    return rows[0]


def main():
    # So that namespaces go in any case.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    bench, *options = sys.argv[1:]
    options = dict(option.split("=", 1) for option in options)
    numbers = [int(word) for word in options.get("ranks", "2,4").split(",")]
    n_nodes = int(options.get("nodes", "100000"))
    points = [point.split(":") for point in options.get("points", "0.2ms:100Mbit/s,5ms:1Gbit/s").split(",")]
    measured = []
    with tempfile.TemporaryDirectory() as folder:
        alone = run_bench(bench, n_nodes, None, folder)
        for latency, bandwidth in points:
            for n in numbers:
                with ShapedNetwork(n, read_quantity(latency), read_quantity(bandwidth)) as network:
                    link = measure_link(network, read_quantity(bandwidth))
                    measured.append(((latency, bandwidth), link, run_bench(bench, n_nodes, network, folder)))
    model = Model([alone] + [row for _, _, row in measured])
    model.tree = model.whole_tree  # what ranks measured of their parts has the network in it
    print(f"{n_nodes} nodes in a cube, one rank alone: {alone['fastest_s']:.3g} s, of which the model knows "
          f"{sum(model.seconds(n_nodes, 1, cores=1, kept=1.0, in_run=False)[part] for part in ('shared', 'tree')):.3g} s")
    print("| link | as measured | ranks | sum | by the model | of this the network | model / measured |")
    print("|---|---|---|---|---|---|---|")
    for asked, (latency, bandwidth), row in measured:
        n = int(row["ranks"])
        parts = model.seconds(n_nodes, n, cores=1, latency=latency, bandwidth=bandwidth, kept=1.0, in_run=False)
        crowd = max(1.0, n / os.cpu_count())
        total = parts["network"] + crowd * sum(parts[name] for name in ("shared", "tree", "top"))
        print(f"| {asked[0]}, {asked[1]} | {1e3 * latency:.3g} ms, {8e-6 * bandwidth:.4g} Mbit/s | {n} | {row['fastest_s']:.3g} s | "
              f"{total:.3g} s | {parts['network']:.3g} s | {total / row['fastest_s']:.2f} |")


if __name__ == "__main__":
    main()
