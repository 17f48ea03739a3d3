#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_writer.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/file_size_limit.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/synthetic_run.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

// Reads with the C API alone, none of the code under test.
template <class Value>
std::vector<Value> read_dataset(const fs::path& file, const std::string& name, const hid_t type,
                                std::vector<hsize_t> expected_shape) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
  EXPECT_GE(dataset, 0) << name;
  const hid_t space = H5Dget_space(dataset);
  std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  EXPECT_EQ(shape, expected_shape) << name;
  std::vector<Value> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(id);
  return values;
}

std::string read_text(const fs::path& file, const std::string& object, const std::string& name) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t attribute = H5Aopen_by_name(id, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(attribute, 0) << object << "@" << name;
  const hid_t type = H5Aget_type(attribute);
  char* text = nullptr;
  EXPECT_GE(H5Aread(attribute, type, &text), 0);
  const std::string result = text == nullptr ? "" : text;
  H5free_memory(text);
  H5Tclose(type);
  H5Aclose(attribute);
  H5Fclose(id);
  return result;
}

TEST(Trajectory, ReadsBackThroughTheIndexAsOneArray) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "a" / "run", "scene", false);
  write_three_segments(folder, {});

  const TrajectoryLayout layout = make_synthetic_layout();
  const hsize_t n_nodes = 7 * 6 + 5 * 9;
  const auto position =
      read_dataset<double>(folder.index(), "/particles/fibers/position/value", H5T_NATIVE_DOUBLE, {5, n_nodes, 3});
  const auto centreline =
      read_dataset<double>(folder.index(), "/observables/centreline/value", H5T_NATIVE_DOUBLE, {5, 12, 3});
  const auto curvature =
      read_dataset<double>(folder.index(), "/observables/curvature/value", H5T_NATIVE_DOUBLE, {5, 12});
  const auto step = read_dataset<std::int64_t>(folder.index(), "/observables/curvature/step", H5T_NATIVE_INT64, {5});
  const auto time = read_dataset<double>(folder.index(), "/particles/fibers/position/time", H5T_NATIVE_DOUBLE, {5});
  for (int f = 0; f < 5; ++f) {
    const Frame frame = make_synthetic_frame(layout, f);
    EXPECT_EQ(step[f], frame.step);
    EXPECT_EQ(time[f], frame.time);
    for (std::size_t node = 0; node < n_nodes; ++node) {
      const double* x = &position[3 * (f * n_nodes + node)];
      ASSERT_EQ((Vec3{x[0], x[1], x[2]}), frame.position[node]) << "frame " << f << ", node " << node;
    }
    for (std::size_t section = 0; section < 12; ++section) {
      const double* x = &centreline[3 * (f * 12 + section)];
      ASSERT_EQ((Vec3{x[0], x[1], x[2]}), frame.centreline[section]);
      ASSERT_EQ(curvature[f * 12 + section], frame.curvature[section]);
    }
  }

  const auto energy = read_dataset<double>(folder.index(), "/observables/energy/value", H5T_NATIVE_DOUBLE, {40, 2});
  const auto end_to_end =
      read_dataset<double>(folder.index(), "/observables/end_to_end/value", H5T_NATIVE_DOUBLE, {40, 2, 3});
  const auto evaluations =
      read_dataset<std::int64_t>(folder.index(), "/observables/evaluations/value", H5T_NATIVE_INT64, {40});
  const auto record_step = read_dataset<std::int64_t>(folder.index(), "/observables/dt/step", H5T_NATIVE_INT64, {40});
  for (int r = 0; r < 40; ++r) {
    const StepRecord record = make_synthetic_record(r + 1);
    EXPECT_EQ(record_step[r], record.step);
    EXPECT_EQ(evaluations[r], record.evaluations);
    EXPECT_EQ(energy[2 * r + 1], record.energy[1]);
    EXPECT_EQ(end_to_end[6 * r + 1], record.end_to_end[0].y);
  }
}

TEST(Trajectory, SaysWhatTheArraysAre) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  write_three_segments(folder, {});

  const fs::path index = folder.index();
  EXPECT_EQ(read_text(index, "/particles/fibers/position/value", "unit"), "length");
  EXPECT_EQ(read_text(index, "/observables/curvature/time", "unit"), "time");
  EXPECT_EQ(read_text(index, "/observables/spectral_radius/value", "unit"), "1/time");
  EXPECT_EQ(read_text(index, "/parameters/bending_rigidity", "unit"), "force*length^2");
  EXPECT_EQ(read_text(index, "/parameters", "version"), "1.2.3");
  EXPECT_EQ(read_text(index, "/parameters", "status"), "done");
  EXPECT_EQ(read_dataset<double>(index, "/parameters/shear_rate", H5T_NATIVE_DOUBLE, {}), std::vector<double>{2.5});
  EXPECT_EQ(read_dataset<int>(index, "/parameters/first_node", H5T_NATIVE_INT, {2}), (std::vector<int>{0, 42}));
  EXPECT_EQ(read_dataset<double>(index, "/parameters/fiber_radius", H5T_NATIVE_DOUBLE, {2}),
            (std::vector<double>{0.03, 0.07}));
  // 6 x 6 and 4 x 9 on the tubes; a hexagon is two quadrilaterals, a nonagon three and a triangle.
  read_dataset<int>(index, "/connectivity/surface", H5T_NATIVE_INT, {36 + 2 * 2 + 36 + 2 * 4, 4});
}

TEST(Trajectory, KeepsTextsLongerThanAnHdf5AttributeOfFixedLength) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  TrajectoryLayout layout = make_synthetic_layout();
  layout.attributes["scene"] = std::string(300'000, 'x');
  TrajectoryWriter(folder, layout, {}).finish("done");

  EXPECT_EQ(read_text(folder.index(), "/parameters", "scene"), layout.attributes["scene"]);
}

TEST(Trajectory, StoresPositionsInSinglePrecisionOnRequestAndTimesNever) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  OutputConfig output;
  output.precision = Precision::in_single;
  write_three_segments(folder, output);

  const auto position =
      read_dataset<double>(folder.index(), "/particles/fibers/position/value", H5T_NATIVE_DOUBLE, {5, 87, 3});
  const Frame frame = make_synthetic_frame(make_synthetic_layout(), 3);
  const double stored = position[3 * (3 * 87 + 5)];
  EXPECT_EQ(stored, static_cast<double>(static_cast<float>(frame.position[5].x)));
  EXPECT_NE(stored, frame.position[5].x);
  EXPECT_EQ(read_dataset<double>(folder.index(), "/particles/fibers/position/time", H5T_NATIVE_DOUBLE, {5})[3],
            frame.time);
}

TEST(Trajectory, ChainsSegmentsFromTheSceneOn) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "one", "scene", false);
  const RunFolder same = RunFolder::create(scratch.path() / "two", "scene", false);
  const RunFolder other = RunFolder::create(scratch.path() / "three", "another scene", false);
  for (const RunFolder& run : {folder, same, other}) write_three_segments(run, {});

  const auto checksum = [](const RunFolder& run, const char* segment, const char* name) {
    return read_text(run.segments() / segment, "/", name);
  };
  EXPECT_EQ(checksum(folder, "000001.h5", "previous_xxh3"), checksum(folder, "000000.h5", "xxh3"));
  EXPECT_EQ(checksum(folder, "000002.h5", "previous_xxh3"), checksum(folder, "000001.h5", "xxh3"));
  EXPECT_EQ(read_text(folder.index(), "/parameters/segments", "xxh3"), checksum(folder, "000002.h5", "xxh3"));
  EXPECT_EQ(checksum(folder, "000002.h5", "xxh3"), checksum(same, "000002.h5", "xxh3"));
  EXPECT_NE(checksum(folder, "000002.h5", "xxh3"), checksum(other, "000002.h5", "xxh3"));
}

TEST(Trajectory, ClosesASegmentByItselfWhenTheBufferOrTheTimeIsFull) {
  const ScratchFolder scratch;
  const TrajectoryLayout layout = make_synthetic_layout();
  const std::uint64_t frame_bytes = 8 * (87 * 3 + 12 * 3 + 12 + 2);
  const RunFolder by_bytes = RunFolder::create(scratch.path() / "bytes", "scene", false);
  TrajectoryWriter full(by_bytes, layout, {}, {.bytes = 3 * frame_bytes, .seconds = 1e9});
  for (int frame = 0; frame < 5; ++frame) full.append(make_synthetic_frame(layout, frame));
  EXPECT_EQ(read_run_summary(by_bytes.path()).frames, 3);

  const RunFolder by_time = RunFolder::create(scratch.path() / "time", "scene", false);
  TrajectoryWriter late(by_time, layout, {}, {.bytes = 1 << 30, .seconds = 0.0, .largest_share = 1e9});
  late.append(make_synthetic_frame(layout, 0));
  EXPECT_EQ(read_run_summary(by_time.path()).frames, 1);
}

TEST(Trajectory, RefusesTimesThatDoNotGrowAndWrongShapes) {
  const ScratchFolder scratch;
  const TrajectoryLayout layout = make_synthetic_layout();
  TrajectoryWriter writer(RunFolder::create(scratch.path() / "run", "scene", false), layout, {}, never);
  writer.append(make_synthetic_frame(layout, 1));
  writer.close_segment();

  EXPECT_EQ(code_of([&] { writer.append(make_synthetic_frame(layout, 1)); }), ExitCode::internal);
  Frame frame = make_synthetic_frame(layout, 2);
  frame.curvature.pop_back();
  EXPECT_EQ(code_of([&] { writer.append(frame); }), ExitCode::internal);
  writer.append(make_synthetic_frame(layout, 2));  // a refused frame left nothing behind
  writer.finish("done");
  EXPECT_EQ(read_run_summary(scratch.path() / "run").frames, 2);
}

TEST(Trajectory, KeepsFramesThatCouldNotBeWrittenAndWritesThemLater) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  const TrajectoryLayout layout = make_synthetic_layout();
  TrajectoryWriter writer(folder, layout, {}, never);
  writer.append(make_synthetic_frame(layout, 0));
  writer.close_segment();
  for (int frame = 1; frame < 9; ++frame) writer.append(make_synthetic_frame(layout, frame));
  std::string message;
  {
    const FileSizeLimit limit(10'000);  // a frame has 2.4 kB
    EXPECT_EQ(code_of([&] { writer.close_segment(); }, &message), ExitCode::io_error);
  }
  EXPECT_NE(message.find("000001.h5"), std::string::npos) << message;
  EXPECT_EQ(read_run_summary(folder.path()).frames, 1);
  EXPECT_EQ(names_in(folder.segments()), std::set<std::string>{"000000.h5"});

  writer.finish("done");
  EXPECT_EQ(read_run_summary(folder.path()).frames, 9);
  read_dataset<double>(folder.index(), "/particles/fibers/position/time", H5T_NATIVE_DOUBLE, {9});
}

TEST(Trajectory, NamesTheIndexWhenItIsTheIndexThatDoesNotFit) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", std::string(300'000, 'x'), false);
  const TrajectoryLayout layout = make_synthetic_layout(std::string(300'000, 'x'));
  TrajectoryWriter writer(folder, layout, {}, never);
  writer.append(make_synthetic_frame(layout, 0));
  std::string message;
  {
    const FileSizeLimit limit(100'000);  // a segment has 30 kB
    EXPECT_EQ(code_of([&] { writer.close_segment(); }, &message), ExitCode::io_error);
  }
  EXPECT_NE(message.find("trajectory.h5"), std::string::npos) << message;
  EXPECT_EQ(read_run_summary(folder.path()).frames, 0);

  writer.close_segment();
  EXPECT_EQ(read_run_summary(folder.path()).frames, 1);
}

TEST(Trajectory, LeavesOpenReadersTheIndexTheyOpened) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  const TrajectoryLayout layout = make_synthetic_layout();
  TrajectoryWriter writer(folder, layout, {}, never);
  for (int frame = 0; frame < 4; ++frame) {
    writer.append(make_synthetic_frame(layout, frame));
    writer.close_segment();
  }
  const hid_t old_index = H5Fopen(folder.index().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t old_time = H5Dopen2(old_index, "/particles/fibers/position/time", H5P_DEFAULT);
  writer.append(make_synthetic_frame(layout, 4));
  writer.close_segment();
  std::vector<double> time(4, -1.0);
  EXPECT_GE(H5Dread(old_time, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, time.data()), 0);
  EXPECT_EQ(time[3], 0.05 * 3);
  H5Dclose(old_time);
  H5Fclose(old_index);
  for (const std::string& name : names_in(folder.path())) EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
}

// A reader finds a whole document with nearly all frames at any time, and what is written in all stays in proportion to
// the last.
TEST(Trajectory, RewritesTheXdmfOnlyWhenItHasGrown) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  const TrajectoryLayout layout = make_synthetic_layout();
  const auto count_frames = [&folder] {
    const std::string text = read_file(folder.xdmf());
    EXPECT_TRUE(text.ends_with("</Xdmf>\n"));
    std::size_t n = 0;
    for (std::size_t at = text.find("<Time "); at != std::string::npos; at = text.find("<Time ", at + 1)) ++n;
    return n;
  };
  TrajectoryWriter writer(folder, layout, {}, never);
  std::size_t last = 0, n_written = 0;
  constexpr std::size_t n_frames = 150;
  for (std::size_t frame = 1; frame <= n_frames; ++frame) {
    writer.append(make_synthetic_frame(layout, static_cast<int>(frame)));
    writer.close_segment();
    const std::size_t found = count_frames();
    EXPECT_GE(9 * found, 8 * frame);
    n_written += found > last ? found : 0;
    last = found;
  }
  EXPECT_LE(n_written, 10 * n_frames);
  writer.finish("done");
  EXPECT_EQ(count_frames(), n_frames);
  EXPECT_LT(fs::file_size(folder.xdmf()), 220 * n_frames + 1000);
}

TEST(Trajectory, SavesWhatIsBufferedWhenAnErrorUnwindsTheRun) {
  const ScratchFolder scratch;
  const RunFolder folder = RunFolder::create(scratch.path() / "run", "scene", false);
  const TrajectoryLayout layout = make_synthetic_layout();
  try {
    TrajectoryWriter writer(folder, layout, {}, never);
    writer.append(make_synthetic_frame(layout, 0));
    throw Error(ExitCode::numerical, "blow-up");
  } catch (const Error&) {
  }
  EXPECT_EQ(read_run_summary(folder.path()).frames, 1);
  EXPECT_EQ(read_run_summary(folder.path()).status, "running");
}

}  // namespace
}  // namespace skein
