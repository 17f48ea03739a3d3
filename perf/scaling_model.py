#!/usr/bin/python3
"""A model of evaluations that ranks share by the fast multipole method, from what bench_ranks measured, drawn up to 64 nodes.

Usage: for n in 1 2 4; do for what in "run" "run sections=5600" "cube only=200000" "cube"; do
         mpirun --oversubscribe -n $n bench_ranks $what; done; done > ranks.csv
       scaling_model.py ranks.csv ranks.png

One thread a rank. Of lines of several numbers of nodes those of the largest count. From the lines of one rank come the seconds
a node of near field, far field, forces, flow and integrator, from those of two what a part of a tree takes, from all bytes and
messages. A rank of the model is a node of CORES cores that share its part; what is assumed beyond the measurements is said below
and in the picture:

  shared   near field, far field, forces, flow, integrator: seconds of one rank / ranks / cores
  tree     a part on each rank, and its nodes on their way to their places: half of it serial; in a step it serves KEPT sums
  top      boxes above several ranks, made by all: (ranks - 1) boxes a level of the far field, and TOP_BOXES for each rank of
           the tree, TOP_BOX seconds each
  leader   the end of a step, rank 0's alone: the search for faults and a copy of the state
  network  bytes by rank 0's link, which is the busiest: a gather, also to all, passes it once but for the rank's own part;
           coefficients and copies of nodes as fitted. In a run positions and forces go to the ranks that have their places in
           the tree, velocities come back (all but one of as many parts of a rank's, if nodes and places have nothing to do
           with each other), rank 0 gathers positions and what a checkpoint takes, once a step, and what goes to all is as
           measured; besides the centroids of all sections, where fibers repel each other.
           Sums by themselves broadcast positions and forces, which pass the link once for two ranks, nearly twice for more (a
           part to each, which gives it to all others), and gather velocities. Arrays take two latencies each, as the receiver
           is asked first; orders travel with them.
perf/shaped_network.py compares this with networks that are slow enough to be made on one machine.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

CORES = 32
LATENCY = 2e-6  # seconds a message
BANDWIDTH = 1e10  # bytes / second, of a node's link, each way
SENDING = 5e-7  # seconds that rank 0 takes for a message to or from each other rank
ORDERS = 2.0  # of the messages of a sum
ORDERS_IN_RUN = 3.0  # of an evaluation's
VECTOR = 24.0  # bytes a node
NODES_PER_SECTION = 18.0
NEW_TREE = 16.0  # bytes a node, of keys, and of what each took
SERIAL_TREE = 0.5  # of building a tree
TOP_BOXES, TOP_BOX = 55.0, 1e-6  # for each rank; seconds a tree
KEPT = 8.0  # sums that a tree serves in a run (docs/hydrodynamics.md)
PARTS = ("shared", "tree", "top", "leader", "network")
COLORS = dict(zip(PARTS, ("tab:blue", "tab:orange", "tab:red", "tab:purple", "tab:green")))


def read_rows(path):
    rows, steps, names = [], [], {}
    with open(path, encoding="utf-8") as file:
        for row in csv.reader(line for line in file if "," in line and not line.startswith("#")):
            if row[1] == "ranks":
                names["cube" if row[0] == "sum" else row[0]] = row
            elif len(row) == len(names.get(row[0], [])):
                numbers = {name: float(value) for name, value in list(zip(names[row[0]], row))[1:]}
                {"cube": rows, "steps": steps}.get(row[0], []).append(numbers)
    rows = [row for row in rows if row["nodes"] == max(row["nodes"] for row in rows)]
    steps = [row for row in steps if row["nodes"] == max(row["nodes"] for row in steps)]
    if not any(row["ranks"] == 1 for row in rows) or not any(row["ranks"] > 1 for row in rows):
        sys.exit("scaling_model.py: lines of the cube on one rank and on several are needed")
    return rows, steps


class Model:
    def __init__(self, rows, steps=()):
        one = [row for row in rows if row["ranks"] == 1]
        several = [row for row in rows if row["ranks"] > 1]
        per_node = lambda *names: float(np.mean([sum(row[name] for name in names) / row["nodes"] for row in one]))
        self.shared = per_node("far_s", "leaf_s")
        self.whole_tree = per_node("tree_s", "sort_s")
        two = [row for row in several if row["ranks"] == 2]
        self.tree = float(np.mean([(row["tree_s"] + row["sort_s"]) * row["ranks"] / row["nodes"] for row in two])) if two else self.whole_tree
        alone = [row for row in steps if row["ranks"] == 1]
        of_steps = lambda *names: float(np.mean([sum(row[name] for name in names) / row["nodes"] for row in alone])) if alone else 0.0
        self.leader = of_steps("alone_s")
        self.owned = of_steps("forces_s", "flow_s", "integrator_s") - self.leader
        self.far_box = float(np.mean([row["far_s"] / row["boxes"] for row in one]))
        self.box_nodes = float(np.mean([row["nodes"] / row["boxes"] for row in one]))
        # Boxes and nodes at the surface of a part: so many bytes for (nodes a rank)^(2/3).
        self.surface = float(np.mean([(row["exchanged_B"] - self.moved(row["nodes"], row["ranks"], 1.0))
                                      / (row["nodes"] / row["ranks"]) ** (2 / 3) for row in several]))
        self.broadcast = float(np.mean([row["broadcast_B"] / row["nodes"] for row in several]))
        self.gather = float(np.mean([row["gathered_B"] / row["nodes"] for row in several]))
        self.messages = {n: float(np.mean([row["messages"] for row in several if row["ranks"] == n]))
                         for n in sorted({row["ranks"] for row in several})}
        shared_steps = [row for row in steps if row["ranks"] > 1]
        self.kept = float(np.mean([row["gathered_B"] / row["nodes"] for row in shared_steps])) if shared_steps else 0.0
        self.to_all = float(np.mean([row["shared_B"] / row["nodes"] for row in shared_steps])) if shared_steps else 0.0
        self.run_messages = float(np.mean([row["messages"] for row in shared_steps])) if shared_steps else 0.0

    @staticmethod
    def moved(n, ranks, kept):
        """Bytes of a rank's nodes to their places and back, and of a new tree now and then."""
        return (3.0 * VECTOR + NEW_TREE / kept) * n / ranks * (ranks - 1) / ranks

    def network(self, n, ranks, latency, bandwidth, in_run, kept, repels):
        if ranks == 1:
            return 0.0
        others = (ranks - 1) / ranks
        if in_run:
            by_link = (self.to_all + (VECTOR / NODES_PER_SECTION if repels else 0.0) + self.kept) * others
            messages, orders = self.run_messages, ORDERS_IN_RUN
        else:
            by_link = self.broadcast * (1.0 if ranks == 2 else 2.0 * others) + self.gather * others
            # Of the largest number of ranks that was measured, if not of this one.
            messages, orders = self.messages.get(float(ranks), list(self.messages.values())[-1]), ORDERS
        bytes_moved = by_link * n + self.moved(n, ranks, kept) + self.surface * (n / ranks) ** (2 / 3)
        return bytes_moved / bandwidth + 2.0 * (messages - orders) * latency + messages * (ranks - 1) * SENDING

    def seconds(self, n, ranks, cores=CORES, latency=LATENCY, bandwidth=BANDWIDTH, kept=KEPT, in_run=True, repels=False):
        levels = max(1.0, np.log(n / self.box_nodes) / np.log(8.0))
        return {
            "shared": (self.shared + (self.owned if in_run else 0.0)) * n / ranks / cores,
            "tree": (self.tree if ranks > 1 else self.whole_tree) / kept * n / ranks * (SERIAL_TREE + (1.0 - SERIAL_TREE) / cores),
            "top": (ranks - 1) * (self.far_box * levels / cores + TOP_BOXES * TOP_BOX / kept),
            "leader": self.leader * n / cores if in_run else 0.0,
            "network": self.network(n, ranks, latency, bandwidth, in_run, kept, repels),
        }


def compare(model, rows):
    """What the model says of this machine, whose processors the ranks shared."""
    for row in rows:
        if row["ranks"] < 2:
            continue
        parts = model.seconds(row["nodes"], int(row["ranks"]), cores=1, latency=5e-6, bandwidth=3e9, kept=1.0, in_run=False)
        work = sum(parts[name] for name in ("shared", "tree", "top"))
        print(f"{row['nodes']:.0f} nodes, {row['ranks']:.0f} ranks: work of the busiest rank {row['busiest_work_s']:.3g} s, "
              f"by the model {work:.3g} s; exchanged {row['exchanged_B']:.3g} bytes, by the model "
              f"{model.moved(row['nodes'], row['ranks'], 1.0) + model.surface * (row['nodes'] / row['ranks']) ** (2 / 3):.3g}")


def draw(model, path):
    ranks = np.array([1, 2, 4, 8, 16, 32, 64])
    figure, axes = plt.subplots(1, 3, figsize=(12, 4), sharey=False)
    for axis, n in zip(axes, (1e6, 1e7, 1e8)):
        parts = {name: [model.seconds(n, int(p))[name] for p in ranks] for name in PARTS}
        total = np.sum([parts[name] for name in PARTS], axis=0)
        for name in PARTS:
            axis.loglog(ranks, np.maximum(parts[name], 1e-7), color=COLORS[name], marker=".", label=name)
        axis.loglog(ranks, total, "k", linewidth=2, label="all")
        axis.loglog(ranks, total[0] / ranks, "k:", linewidth=1, label="ideal")
        axis.set_title(f"N = {n:.0e}")
        axis.set_xlabel(f"nodes of {CORES} cores")
        axis.set_ylim(total[-1] / 3e3, total[0] * 2)
        efficiency = total[0] / total / ranks
        fixed = np.sum([parts[name] for name in PARTS if name != "shared"], axis=0)
        ends = ranks[np.argmax(fixed > parts["shared"])] if np.any(fixed > parts["shared"]) else None
        largest = max((name for name in PARTS if name != "shared"), key=lambda name: parts[name][-1])
        print(f"N = {n:.0e}: {total[0]:.3g} s on one node, {total[-1]:.3g} s on 64; half of the time is not shared from "
              f"{ends} nodes on, most of it {largest}; efficiency on 4, 16, 64: "
              f"{efficiency[2]:.2f}, {efficiency[4]:.2f}, {efficiency[6]:.2f}; where fibers repel each other "
              f"{sum(model.seconds(n, 64, repels=True).values()):.3g} s on 64")
    axes[0].set_ylabel("seconds of an evaluation")
    figure.legend(*axes[0].get_legend_handles_labels(), fontsize=8, loc="lower center", ncol=7)
    figure.suptitle(f"Extrapolated: {LATENCY * 1e6:g} us, {BANDWIDTH / 1e9:g} GB/s; a tree in parts for {KEPT:g} sums", fontsize=10)
    figure.tight_layout(rect=(0.0, 0.06, 1.0, 1.0))
    figure.savefig(path, dpi=120)


def main():
    rows, steps = read_rows(sys.argv[1])
    model = Model(rows, steps)
    print(f"a node: shared {model.shared:.3g} s, forces, flow and integrator {model.owned:.3g} s, tree {model.tree:.3g} s, rank 0's alone "
          f"{model.leader:.3g} s, broadcast {model.broadcast:.3g} and gathered "
          f"{model.gather:.3g} bytes, in a run {model.kept:.3g}; {list(model.messages.values())[-1]:.3g} messages a sum; exchanged {model.surface:.3g} bytes (N / ranks)^(2/3)")
    compare(model, rows)
    draw(model, sys.argv[2])


if __name__ == "__main__":
    main()
