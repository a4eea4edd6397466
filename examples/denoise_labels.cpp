// SPDX-License-Identifier: BSD-3-Clause
/** \file The random field for its own sake: takes the noise out of a label image.
 *
 * denoise_labels IN.png OUT.png [SMOOTHNESS]
 *
 * IN.png is an 8-bit gray picture of a few values, such as a label image in which some
 * pixels are wrong. A pixel pays 1 for a value that is not the one it has, and SMOOTHNESS
 * (0.6 if not given, 0.05 to 20) for each neighbour with another one. Belief propagation
 * finds the labelling that costs least, or nearly. */
#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/grid_field.h>

#include <png.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct GrayPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

GrayPicture readGray(const char* path)
{
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path) == 0)
    throw std::runtime_error(std::string("cannot read '") + path +
                             "' as PNG; check its name");
  png.format = PNG_FORMAT_GRAY;
  GrayPicture picture;
  picture.width = static_cast<int>(png.width);
  picture.height = static_cast<int>(png.height);
  picture.pixels.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, picture.pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("'") + path + "' is damaged; copy it again");
  return picture;
}

void writeGray(const char* path, const GrayPicture& picture)
{
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(picture.width);
  png.height = static_cast<png_uint_32>(picture.height);
  png.format = PNG_FORMAT_GRAY;
  if (png_image_write_to_file(&png, path, 0, picture.pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("cannot write '") + path +
                             "'; check the space on the disk");
}

/// The values of a picture in their order: label k is values[k].
std::vector<std::uint8_t> valuesOf(const GrayPicture& picture)
{
  constexpr std::size_t MOST = 64;
  std::vector<std::uint8_t> values = picture.pixels;
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() > MOST)
    throw std::runtime_error("has more than 64 values; it is no label image");
  return values;
}

/// Potts energy of the picture in whole units, as GridField wants it: a wrong value costs
/// ONE, a change between neighbours its share of it.
pcl_mrf_planes::GridField makeField(const GrayPicture& picture,
                                    const std::vector<std::uint8_t>& values,
                                    double smoothness)
{
  // A data cost and four prices must stay below 65536.
  constexpr int ONE = 800;
  const auto price = static_cast<std::uint16_t>(ONE * smoothness);
  const auto labels = static_cast<int>(values.size());
  pcl_mrf_planes::GridField field(picture.width, picture.height, labels);
  for (int a = 0; a < labels; ++a)
    for (int b = 0; b < a; ++b)
      field.setPairwise(a, b, price);
  std::size_t i = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++i) {
      for (int l = 0; l < labels; ++l)
        field.setData(x, y, l,
                      picture.pixels[i] == values[static_cast<std::size_t>(l)] ? 0
                                                                               : ONE);
      // Weight 0: the whole price. Edges out of the picture do not exist.
      if (x + 1 < picture.width)
        field.setRightEdge(x, y, 0);
      if (y + 1 < picture.height)
        field.setDownEdge(x, y, 0);
    }
  return field;
}

GrayPicture denoise(const GrayPicture& noisy, double smoothness)
{
  constexpr int ITERATIONS = 40;
  const std::vector<std::uint8_t> values = valuesOf(noisy);
  const pcl_mrf_planes::GridField field = makeField(noisy, values, smoothness);
  pcl_mrf_planes::BeliefPropagation propagation(field);
  const int done = propagation.iterate(ITERATIONS, 0);
  const std::vector<std::uint16_t> labels = propagation.mapLabels();
  std::cout << values.size() << " labels, " << done << " iterations, energy "
            << field.energy(labels) << '\n';
  GrayPicture clean = noisy;
  for (std::size_t i = 0; i < labels.size(); ++i)
    clean.pixels[i] = values[labels[i]];
  return clean;
}

} // namespace

int main(int argc, char** argv)
{
  const double smoothness = argc > 3 ? std::atof(argv[3]) : 0.6;
  if (argc < 3 || argc > 4 || !(smoothness >= 0.05 && smoothness <= 20.0)) {
    std::cerr << "usage: denoise_labels IN.png OUT.png [SMOOTHNESS from 0.05 to 20]\n";
    return 2;
  }
  try {
    writeGray(argv[2], denoise(readGray(argv[1]), smoothness));
    return 0;
  }
  catch (const std::exception& error) {
    std::cerr << "denoise_labels: " << error.what() << '\n';
    return 1;
  }
}
