// SPDX-License-Identifier: BSD-3-Clause
#include "region_files.h"

#include "label_colours.h"
#include "output_file.h"
#include "pictures.h"
#include "polygon_mesh.h"

#include <pcl_mrf_planes/io/cloud_fields.h>

#include <vtkNew.h>
#include <vtkPLYWriter.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace pcl_mrf_planes::apps {

namespace {

const pcl::PCLPointField& fieldOf(const io::CloudFile& file, const std::string& name)
{
  for (const auto& field : file.cloud.fields)
    if (field.name == name)
      return field;
  throw std::runtime_error("has no field '" + name + "'");
}

/// Writes x, y and z, floats or doubles.
class CoordinateWriter {
public:
  explicit CoordinateWriter(io::CloudFile& file)
  : file_(file)
  , fields_{fieldOf(file, "x"), fieldOf(file, "y"), fieldOf(file, "z")}
  {}

  void operator()(std::size_t i, const Eigen::Vector3f& p) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const pcl::PCLPointField& field = fields_[axis];
      std::uint8_t* to = &file_.cloud.data[i * file_.cloud.point_step + field.offset];
      const float value = p[static_cast<Eigen::Index>(axis)];
      const auto number = static_cast<double>(value);
      if (field.datatype == pcl::PCLPointField::FLOAT64)
        std::memcpy(to, &number, sizeof number);
      else
        std::memcpy(to, &value, sizeof value);
    }
  }

private:
  io::CloudFile& file_;
  std::array<pcl::PCLPointField, 3> fields_;
};

} // namespace

io::CloudFile withCoordinates(const io::CloudFile& file,
                              const pcl::PointCloud<pcl::PointXYZ>& coordinates)
{
  io::CloudFile result = file;
  const CoordinateWriter write(result);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    write(i, coordinates[i].getVector3fMap());
  return result;
}

io::CloudFile withoutPlanes(const io::CloudFile& file,
                            const pcl::PointCloud<pcl::Label>& labels)
{
  io::CloudFile result = file;
  const CoordinateWriter write(result);
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i].label != 0)
      write(i, Eigen::Vector3f::Constant(nothing));
  result.cloud.is_dense = 0;
  return result;
}

void writeConfidenceImage(const std::string& path, const std::vector<float>& confidence,
                          int width, int height)
{
  pcl::PointCloud<pcl::Label> gray;
  gray.resize(confidence.size());
  gray.width = static_cast<std::uint32_t>(width);
  gray.height = static_cast<std::uint32_t>(height);
  for (std::size_t i = 0; i < confidence.size(); ++i)
    gray[i].label = static_cast<std::uint32_t>(std::lround(65535.0f * confidence[i]));
  writeLabelImage(path, gray);
}

void writePolygonMesh(const std::string& path,
                      const std::vector<RegionOutline>& outlines)
{
  std::vector<std::array<std::uint8_t, 3>> colours;
  for (std::size_t k = 0; k < outlines.size(); ++k)
    colours.push_back(labelColour(static_cast<std::uint32_t>(k + 1)));
  const vtkSmartPointer<vtkPolyData> mesh = polygonMesh(outlines, colours);
  writeAtomically(path, [&](const std::string& temporary) {
    vtkNew<vtkPLYWriter> writer;
    writer->SetFileName(temporary.c_str());
    writer->SetInputData(mesh);
    writer->SetArrayName("colour");
    writer->SetFileTypeToBinary();
    if (writer->Write() != 1 || writer->GetErrorCode() != 0)
      throw std::runtime_error("cannot write '" + path +
                               "'; check the space on the disk");
  });
}

void writeRegionFiles(const RegionOptions& options, const io::CloudFile& file,
                      const pcl::PointCloud<pcl::Label>& labels,
                      const RegionAnalysis& analysis)
{
  if (!options.confidence_image.empty())
    writeConfidenceImage(options.confidence_image, analysis.confidence,
                         static_cast<int>(file.cloud.width),
                         static_cast<int>(file.cloud.height));
  if (!options.polygons.empty())
    writePolygonMesh(options.polygons, analysis.outlines);
  if (!options.rest.empty())
    io::writeCloud(options.rest, withoutPlanes(file, labels), file.format);
}

io::CloudFile withRegions(const RegionOptions& options, const io::CloudFile& file,
                          const RegionAnalysis& analysis)
{
  io::CloudFile result = file;
  if (options.project)
    result = withCoordinates(result, analysis.projected);
  if (options.confidence)
    result = io::withConfidence(result, analysis.confidence);
  return result;
}

} // namespace pcl_mrf_planes::apps
