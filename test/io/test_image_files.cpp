// SPDX-License-Identifier: BSD-3-Clause
// Pictures: what is in them comes out, and damaged ones give a message.
#include "io_files.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>

#include <functional>

namespace pcl_mrf_planes::test {

class ImageFiles : public IoTest {
protected:
  /// Every shorter file, and every file with a byte exchanged, throws or gives an image.
  void expectSafe(const std::string& bytes,
                  const std::function<void(const std::string&)>& read) const
  {
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 16) {
      write("cut", bytes.substr(0, size));
      EXPECT_THROW(read(path("cut")), std::runtime_error) << "cut to " << size;
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 80); ++i) {
      std::string other = bytes;
      other[i] = static_cast<char>(other[i] ^ 0x55);
      write("other", other);
      try {
        read(path("other"));
      }
      catch (const std::runtime_error&) {
      }
    }
  }
};

TEST_F(ImageFiles, PngOfSixteenBits)
{
  const auto values = slantedWall(37, 23);
  writePng16(path("a.png"), values, 37, 23);
  const io::Image16 image = io::readGrayPng(path("a.png"), "depth images");
  EXPECT_EQ(image.width, 37);
  EXPECT_EQ(image.pixels, values) << "most significant byte first in the file";
  expectSafe(read("a.png"),
             [](const std::string& file) { io::readGrayPng(file, "depth images"); });
}

TEST_F(ImageFiles, PngOfColours)
{
  writeColourPng(path("c.png"), 40, 30);
  const io::ColourImage image = io::readColourImage(path("c.png"));
  ASSERT_EQ(image.pixels.size(), 1200u);
  EXPECT_EQ(image.pixels[40 * 7 + 11], (io::Colour{11, 7, 33}));
  EXPECT_THROW(io::readGrayPng(path("c.png"), "depth images"), std::runtime_error);
}

TEST_F(ImageFiles, JpegOfColours)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(40, 30, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 30; ++y) // VTK's rows start at the bottom
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c)
        data->SetScalarComponentFromDouble(x, y, 0, c, y >= 15 ? 200 - 50 * c : 20);
  vtkNew<vtkJPEGWriter> writer;
  writer->SetFileName(path("c.jpg").c_str());
  writer->SetInputData(data);
  writer->SetQuality(100);
  writer->Write();
  const io::ColourImage image = io::readColourImage(path("c.jpg"));
  ASSERT_EQ(image.width, 40);
  ASSERT_EQ(image.height, 30);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(image.pixels[40 * 3 + 5][static_cast<std::size_t>(c)], 200 - 50 * c, 6);
    EXPECT_NEAR(image.pixels[40 * 26 + 5][static_cast<std::size_t>(c)], 20, 6);
  }
  write("cut.jpg", read("c.jpg").substr(0, 40));
  EXPECT_THROW(io::readColourImage(path("cut.jpg")), std::runtime_error);
}

TEST_F(ImageFiles, PgmInBothByteOrders)
{
  const auto values = slantedWall(37, 23);
  write("big.pgm", pgm16(values, 37, 23, true));
  write("little.pgm", pgm16(values, 37, 23, false));
  using io::ByteOrder;
  EXPECT_EQ(io::readPgm(path("big.pgm"), ByteOrder::BIG_ENDIAN_FIRST).pixels, values);
  EXPECT_EQ(io::readPgm(path("little.pgm"), ByteOrder::LITTLE_ENDIAN_FIRST).pixels,
            values);
  expectSafe(read("big.pgm"), [](const std::string& file) {
    io::readPgm(file, ByteOrder::BIG_ENDIAN_FIRST);
  });
}

TEST_F(ImageFiles, PpmOfColours)
{
  write("c.ppm", std::string("P6 2 1 255\n") + "\x01\x02\x03\x04\x05\x06");
  const io::ColourImage image = io::readColourImage(path("c.ppm"));
  ASSERT_EQ(image.pixels.size(), 2u);
  EXPECT_EQ(image.pixels[1], (io::Colour{4, 5, 6}));
}

TEST_F(ImageFiles, SunRasterRowsAreFilledToAnEvenNumber)
{
  std::string bytes("\x59\xa6\x6a\x95\0\0\0\3\0\0\0\2\0\0\0\x08\0\0\0\x08\0\0\0\1"
                    "\0\0\0\0\0\0\0\0",
                    32);
  bytes += std::string("\1\2\3\xff\4\5\6\xff", 8);
  write("a.ras", bytes);
  const io::Image16 image = io::readSunRaster(path("a.ras"));
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.pixels, (std::vector<std::uint16_t>{1, 2, 3, 4, 5, 6}));
  expectSafe(bytes, [](const std::string& file) { io::readSunRaster(file); });
}

TEST_F(ImageFiles, HugeClaimsAreRefused)
{
  write("huge.pgm", "P5 16000000 16000000 65535\n");
  EXPECT_THROW(io::readPgm(path("huge.pgm"), io::ByteOrder::BIG_ENDIAN_FIRST),
               std::runtime_error);
}

} // namespace pcl_mrf_planes::test
