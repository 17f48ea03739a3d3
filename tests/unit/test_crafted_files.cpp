// Run files that HDF5's own tools changed, under a seal that was made right again. tests/torture has hundreds of them
// for the program; here are the kinds.

#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_check.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>

#include "tests/unit/error_code.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/synthetic_run.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t seal_size = 24;
const char* const position_time = "/particles/fibers/position/time";
const char* const curvature = "/observables/curvature/value";

class CraftedFiles : public testing::Test {
 protected:
  CraftedFiles() : folder_(RunFolder::create(scratch_.path() / "run", "scene", false)) {
    write_three_segments(folder_, {});
    for (const Fiber& fiber : make_synthetic_layout().fibers) scene_.fibers.push_back(fiber.config);
  }

  fs::path segment() const { return folder_.segments() / "000002.h5"; }  // frames 3 and 4

  void craft(const fs::path& path, const std::function<void(hid_t)>& change) const {
    std::string bytes = read_file(path);
    write_file_atomically(path, std::string_view(bytes).substr(0, bytes.size() - seal_size));
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    change(file);
    ASSERT_GE(H5Fclose(file), 0);
    bytes = read_file(path);
    write_file_atomically(path, bytes + "SKEINSUM" + compute_seal(bytes));
  }

  /// In place of an array, one of these extents, with these numbers or none.
  static void replace(const hid_t file, const char* name, const std::vector<hsize_t>& shape, const hid_t type,
                      const void* values, const hid_t creation = H5P_DEFAULT) {
    EXPECT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    EXPECT_GE(dataset, 0);
    if (values != nullptr) {
      EXPECT_GE(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
    }
    H5Dclose(dataset);
    H5Sclose(space);
  }

  /// What reading all frames says.
  std::string fault_of_frames() const {
    std::string message;
    const ExitCode code =
        code_of([&] { TrajectoryReader(folder_, scene_).for_each_frame([](const Frame&) {}); }, &message);
    EXPECT_EQ(code, ExitCode::damaged_data) << message;
    return message;
  }

  void expect_fault(const char* object, const char* why) const {
    const std::string message = fault_of_frames();
    EXPECT_NE(message.find(fmt_quoted(object)), std::string::npos) << message;
    EXPECT_NE(message.find("000002.h5"), std::string::npos) << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }

  static std::string fmt_quoted(const std::string& text) { return "'" + text + "'"; }

  ScratchFolder scratch_;
  RunFolder folder_;
  SceneConfig scene_;
};

TEST_F(CraftedFiles, UnchangedTheyAreRead) {
  std::vector<double> times;
  const TrajectoryReader reader(folder_, scene_);
  reader.for_each_frame([&](const Frame& frame) { times.push_back(frame.time); });
  EXPECT_EQ(times, (std::vector<double>{0.0, 0.05, 0.05 * 2, 0.05 * 3, 0.05 * 4}));
  EXPECT_EQ(reader.read_times(), times);
  const Frame frame = reader.read_frame(3), expected = make_synthetic_frame(make_synthetic_layout(), 3);
  EXPECT_EQ(frame.step, expected.step);
  EXPECT_EQ(frame.position, expected.position);
  EXPECT_EQ(frame.centreline, expected.centreline);
  EXPECT_EQ(frame.curvature, expected.curvature);
}

TEST_F(CraftedFiles, ATextThatIsAListIsRefused) {
  craft(folder_.index(), [](const hid_t file) {
    H5Adelete_by_name(file, "/parameters", "status", H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    const hsize_t n = 100;
    const hid_t space = H5Screate_simple(1, &n, nullptr);
    const hid_t attribute =
        H5Acreate_by_name(file, "/parameters", "status", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const std::vector<const char*> texts(n, "done");
    EXPECT_GE(H5Awrite(attribute, type, texts.data()), 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
  });
  std::string message;
  EXPECT_EQ(code_of([&] { read_run_summary(folder_.path()); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("'/parameters@status'"), std::string::npos) << message;
  EXPECT_NE(message.find("100"), std::string::npos) << message;
}

TEST_F(CraftedFiles, ATextOfFixedLengthIsRead) {
  craft(folder_.index(), [](const hid_t file) {
    H5Adelete_by_name(file, "/parameters", "status", H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 4);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate_by_name(file, "/parameters", "status", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(attribute, type, "done"), 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
  });
  EXPECT_EQ(read_run_summary(folder_.path()).status, "done");
}

TEST_F(CraftedFiles, ArraysOfOtherLengthsAreRefused) {
  craft(segment(), [](const hid_t file) {
    const std::vector<double> values(12, 1.0);
    replace(file, curvature, {1, 12}, H5T_IEEE_F64LE, values.data());
  });
  expect_fault(curvature, "1 x 12 and should be 2 x 12");
}

TEST_F(CraftedFiles, ArraysOfAnotherSceneAreRefused) {
  scene_.fibers.back().sections += 1;
  EXPECT_NE(fault_of_frames().find("should be 2 x 96 x 3"), std::string::npos) << fault_of_frames();
}

TEST_F(CraftedFiles, NumbersThatAreNoneAreRefused) {
  craft(segment(), [](const hid_t file) {
    std::vector<double> values(24, 1.0);
    values[17] = std::numeric_limits<double>::quiet_NaN();
    replace(file, curvature, {2, 12}, H5T_IEEE_F64LE, values.data());
  });
  expect_fault(curvature, "number 17 of 24 is nan");
}

TEST_F(CraftedFiles, TimesThatDoNotGrowAreRefused) {
  craft(segment(), [](const hid_t file) {
    const double times[] = {0.2, 0.2};
    replace(file, position_time, {2}, H5T_IEEE_F64LE, times);
  });
  expect_fault(position_time, "the one before is 0.2");
  craft(segment(), [](const hid_t file) {
    const double times[] = {0.05, 0.3};  // frame 1 was at 0.05, frame 2 at 0.1
    replace(file, position_time, {2}, H5T_IEEE_F64LE, times);
  });
  expect_fault(position_time, "comes after one at 0.1");
}

TEST_F(CraftedFiles, NumbersFromAnotherFileAreNotRead) {
  const fs::path secret = scratch_.path() / "secret";
  write_file_atomically(secret, std::string(8 * 24, 'x'));
  craft(segment(), [&](const hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, secret.c_str(), 0, H5F_UNLIMITED);
    replace(file, curvature, {2, 12}, H5T_IEEE_F64LE, nullptr, creation);
    H5Pclose(creation);
  });
  expect_fault(curvature, "from another file");
}

TEST_F(CraftedFiles, LinksAreNotFollowed) {
  craft(segment(), [](const hid_t file) {
    H5Lmove(file, "/observables/curvature", file, "/moved", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/moved", file, "/observables/curvature", H5P_DEFAULT, H5P_DEFAULT);
  });
  expect_fault(curvature, "/observables/curvature is a link");
  craft(segment(), [&](const hid_t file) {
    H5Ldelete(file, "/observables/curvature", H5P_DEFAULT);
    H5Lcreate_external("000001.h5", "/observables/curvature", file, "/observables/curvature", H5P_DEFAULT, H5P_DEFAULT);
  });
  expect_fault(curvature, "is a link");
}

TEST_F(CraftedFiles, AnExtentBeyondTheFileAsksForNoMemory) {
  craft(folder_.index(), [](const hid_t file) {
    replace(file, "/parameters/segments/frames", {hsize_t{1} << 44}, H5T_STD_I64LE, nullptr);
  });
  std::string message;
  EXPECT_EQ(code_of([&] { read_run_summary(folder_.path()); }, &message), ExitCode::damaged_data);
  EXPECT_NE(message.find("'/parameters/segments/frames'"), std::string::npos) << message;
  EXPECT_NE(message.find("are not all among the file's"), std::string::npos) << message;
}

TEST_F(CraftedFiles, ChunksAndVirtualDatasetsAreRefused) {
  craft(segment(), [](const hid_t file) {
    const std::vector<double> values(24, 1.0);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk[] = {1, 12};
    H5Pset_chunk(creation, 2, chunk);
    replace(file, curvature, {2, 12}, H5T_IEEE_F64LE, values.data(), creation);
    H5Pclose(creation);
  });
  expect_fault(curvature, "in one piece");
}

TEST_F(CraftedFiles, CountsOfTheIndexAreNotBelieved) {
  for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{1} << 62}) {
    craft(folder_.index(), [&](const hid_t file) {
      const std::int64_t counts[] = {2, count, 2};
      replace(file, "/parameters/segments/frames", {3}, H5T_STD_I64LE, counts);
    });
    std::string message;
    EXPECT_EQ(code_of([&] { read_run_summary(folder_.path()); }, &message), ExitCode::damaged_data);
    EXPECT_NE(message.find("a segment cannot have"), std::string::npos) << message;
  }
  craft(folder_.index(), [](const hid_t file) {
    const std::int64_t counts[] = {2, 1, 3};
    replace(file, "/parameters/segments/frames", {3}, H5T_STD_I64LE, counts);
  });
  expect_fault(position_time, "holds 2 frames, and the run's index lists 3");
}

}  // namespace
}  // namespace skein
