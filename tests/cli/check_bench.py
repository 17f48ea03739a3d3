"""What `skein bench machine` says of a machine fits together: check_bench.py SKEIN SOURCES"""

import json


from cli_case import DONE, USAGE, InFreshFolder, main


class Bench(InFreshFolder):
    def test_the_machine_is_measured_and_written_as_json(self):
        result = self.expect(DONE, "bench", "machine", "--json", "--seconds", "0.05", "--lengths", "0.05,0.139",
                             timeout=300)
        report = json.loads(result.stdout)
        peaks = report["peaks"]
        for name in ("single_operations_per_second", "double_operations_per_second", "bytes_per_second"):
            self.assertGreater(peaks[name], 1e7, name)
        self.assertGreater(peaks["launch_seconds"], 0.0)
        self.assertGreater(peaks["graph_launch_seconds"], 0.0)
        self.assertGreater(peaks["wait_seconds"], 0.0)
        self.assertEqual({row["precision"] for row in report["direct"]}, {"double", "single"})
        for row in report["direct"]:
            self.assertAlmostEqual(row["pairs_per_second"] * row["seconds"] / row["nodes"] ** 2, 1.0, places=9)
            self.assertGreater(row["share_of_peak"], 0.0)
        for row in report["fmm"]:
            self.assertLess(row["error"], row["tolerance"])
            parts = sum(row[part] for part in ("tree_seconds", "sort_seconds", "far_seconds", "leaf_seconds"))
            self.assertGreater(parts, 0.0)
        self.assertEqual([row["length"] for row in report["lengths"]], [0.05, 0.139])
        for row in report["lengths"]:
            self.assertGreater(row["seconds_per_time"], row["seconds_per_evaluation"])
            self.assertGreater(row["fluid_share"], 0.0)
            self.assertLess(row["fluid_share"] + row["springs_share"], 1.0)

    def test_tables_name_what_they_show(self):
        text = self.expect(DONE, "bench", "machine", "--seconds", "0.02", "--lengths", "0.05", timeout=300).stdout
        for word in ("peaks:", "direct sums", "fast multipole", "steps", "of the peak"):
            self.assertIn(word, text)

    def test_what_cannot_be_measured_is_refused(self):
        self.expect(USAGE, "bench", "machine", "--seconds", "0")
        self.expect(USAGE, "bench", "machine", "--lengths", "7")
        self.assertIn("machine", self.expect(USAGE, "bench", "engine").stderr)


if __name__ == "__main__":
    main()
