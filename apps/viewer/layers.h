// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_contours.h"
#include "point_colours.h"
#include "tile_cells.h"

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

using Props = std::vector<vtkSmartPointer<vtkProp>>;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief The points that are shown, in their colours.
 * \param[in] cloud as measured, or moved
 * \param[in] size of a point, pixels
 * \param[in] step 2: only every second point of every second row */
vtkSmartPointer<vtkProp> cloudLayer(const Cloud& cloud, const PointColours& colours,
                                    float size, int step = 1);

/** \brief Contours as lines in one colour that stands out from the background. */
vtkSmartPointer<vtkProp> contourLayer(const Cloud& cloud,
                                      const std::vector<LabelContour>& contours,
                                      const ViewSettings& settings);

/** \brief An arrow along the normal of every plane that is shown. */
vtkSmartPointer<vtkProp> normalLayer(const SegmentedView& view,
                                     const ViewSettings& settings);

/** \brief The numbers of the planes, at the tips of their arrows. */
Props numberMarks(const SegmentedView& view, const ViewSettings& settings);

/** \brief Creases of the planes that are shown as thick lines: convex ones red, concave
 * ones blue. */
Props creaseLayer(const std::vector<PlaneCrease>& creases,
                  const ViewSettings& settings);

/** \brief The angles between the normals, degrees, in the middle of the creases. */
Props angleMarks(const std::vector<PlaneCrease>& creases, const ViewSettings& settings);

/** \brief Polygons of the planes that are shown, see-through, with their rings; or their
 * convex hulls as lines.
 * \param[in] classes colour of each plane */
Props shapeLayer(const std::vector<RegionOutline>& outlines,
                 const std::vector<std::uint32_t>& classes,
                 const ViewSettings& settings);

/** \brief Every tile as a square on its points: filled in the colour of the plane that it
 * merged into; tiles that were not kept as gray outlines. */
Props tileLayer(const ViewFrame& frame, const TileCells& cells);

/** \brief A picture as a flat image, a unit a pixel, from the bottom left. */
vtkSmartPointer<vtkProp> imageLayer(const io::ColourImage& image);

/** \brief Energy after 0, 1, ... iterations up to \a shown, as a curve; the axes hold all
 * of it. */
vtkSmartPointer<vtkProp> energyLayer(const std::vector<double>& energy, int shown,
                                     bool dark);

/** \brief A bar with the colours of a scale and the values that they stand for, on a plate.
 * \param[in] right its right edge, in shares of the window */
Props scaleLayer(const ColourScale& scale, double right, bool dark);

/** \brief Lines of text on a plate; (x, y) in shares of the window.
 * \param[in] from_top y is the upper edge, else the lower */
vtkSmartPointer<vtkProp> textLayer(const std::string& text, double x, double y,
                                   bool from_top, bool dark, int font_size);

} // namespace pcl_mrf_planes::viewer
