// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"
#include "marks.h"

#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageMapper3D.h>
#include <vtkNew.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr int THIN = 13; // below it strokes are less than a pixel wide

} // namespace

vtkSmartPointer<vtkProp> imageLayer(const io::ColourImage& image)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* out = static_cast<unsigned char*>(data->GetScalarPointer());
  for (int y = image.height - 1; y >= 0; --y) // VTK's rows go up
    for (int x = 0; x < image.width; ++x) {
      const int i = y * image.width + x;
      const io::Colour& c = image.pixels[static_cast<std::size_t>(i)];
      out = std::copy(c.begin(), c.end(), out);
    }
  auto actor = vtkSmartPointer<vtkImageActor>::New();
  actor->GetMapper()->SetInputData(data);
  return actor;
}

vtkSmartPointer<vtkProp> textLayer(const std::string& text, double x, double y,
                                   bool from_top, bool dark, int font_size)
{
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  std::string lines = text;
  while (!lines.empty() && lines.back() == '\n')
    lines.pop_back();
  actor->SetInput(lines.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToCourier();
  property->SetFontSize(font_size);
  property->SetBold(font_size < THIN ? 1 : 0);
  dressText(property, dark);
  if (from_top)
    property->SetVerticalJustificationToTop();
  else
    property->SetVerticalJustificationToBottom();
  return actor;
}

} // namespace pcl_mrf_planes::viewer
