#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/vtk_image.hpp>

#include <fmt/format.h>

#include <bit>

namespace skein {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are written as they lie in memory");
constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

std::string describe_arrays(const std::vector<ImageField>& fields) {
  std::string arrays;
  std::uint64_t offset = 0;
  for (const ImageField& field : fields) {
    arrays += fmt::format(
        "        <DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"3\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        field.name, offset);
    offset += sizeof(std::uint64_t) + field.values.size() * sizeof(Vec3);
  }
  return arrays;
}

}  // namespace

Vec3 ImageGrid::point(const std::int64_t index) const {
  const std::int64_t i = index % n_points[0], j = index / n_points[0] % n_points[1],
                     k = index / n_points[0] / n_points[1];
  return origin + Vec3{spacing.x * static_cast<double>(i), spacing.y * static_cast<double>(j),
                       spacing.z * static_cast<double>(k)};
}

void write_vtk_image(const std::filesystem::path& path, const ImageGrid& grid, const double time,
                     const std::vector<ImageField>& fields) {
  SKEIN_REQUIRE(!fields.empty(), "an image holds a field");
  const std::string extent =
      fmt::format("0 {} 0 {} 0 {}", grid.n_points[0] - 1, grid.n_points[1] - 1, grid.n_points[2] - 1);
  AtomicFile file(path);
  file.write(fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"{0}\" header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"{1}\" Origin=\"{2} {3} {4}\" Spacing=\"{5} {6} {7}\">\n"
      "    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{8}</DataArray>\n"
      "    </FieldData>\n"
      "    <Piece Extent=\"{1}\">\n"
      "      <PointData Vectors=\"{9}\">\n",
      byte_order, extent, grid.origin.x, grid.origin.y, grid.origin.z, grid.spacing.x, grid.spacing.y, grid.spacing.z,
      time, fields.front().name));
  file.write(describe_arrays(fields));
  file.write("      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_");
  for (const ImageField& field : fields) {
    SKEIN_REQUIRE(static_cast<std::int64_t>(field.values.size()) == grid.size(), "a field has a value at each point");
    const std::uint64_t n_bytes = field.values.size() * sizeof(Vec3);
    file.write(&n_bytes, sizeof n_bytes);
    file.write(field.values.data(), n_bytes);
  }
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace skein
