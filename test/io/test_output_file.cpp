// SPDX-License-Identifier: BSD-3-Clause
// Files that are there whole or not at all.
#include "io_files.h"

#include <pcl_mrf_planes/io/output_file.h>

#include <fstream>

namespace pcl_mrf_planes::test {

namespace fs = std::filesystem;

class OutputFile : public IoTest {
protected:
  std::size_t filesThere() const
  {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(path("")))
      count += entry.is_regular_file() ? 1 : 0;
    return count;
  }
};

TEST_F(OutputFile, IsReplacedInOneStep)
{
  io::writeBytes(path("a"), "old");
  io::writeAtomically(path("a"), [&](const std::string& temporary) {
    std::ofstream(temporary) << "new";
    EXPECT_EQ(read("a"), "old") << "until all is written";
    EXPECT_EQ(filesThere(), 2u);
  });
  EXPECT_EQ(read("a"), "new");
  EXPECT_EQ(filesThere(), 1u);
}

TEST_F(OutputFile, StaysWhereWritingFails)
{
  io::writeBytes(path("a"), "old");
  EXPECT_THROW(io::writeAtomically(path("a"),
                                   [](const std::string& temporary) {
                                     std::ofstream(temporary) << "half";
                                     throw std::runtime_error("the disk is full");
                                   }),
               std::runtime_error);
  EXPECT_EQ(read("a"), "old");
  EXPECT_EQ(filesThere(), 1u);
}

TEST_F(OutputFile, ASignalHandlerCanRemoveWhatIsUnderWay)
{
  io::writeBytes(path("a"), "old");
  try {
    io::writeAtomically(path("a"), [&](const std::string& temporary) {
      std::ofstream(temporary) << "half";
      io::removePartialFiles();
      EXPECT_FALSE(fs::exists(temporary));
      EXPECT_EQ(filesThere(), 1u);
    });
    ADD_FAILURE() << "there was nothing left to put in place";
  }
  catch (const std::runtime_error&) {
  }
  EXPECT_EQ(read("a"), "old");
  io::removePartialFiles(); // nothing is under way
  EXPECT_EQ(read("a"), "old");
}

} // namespace pcl_mrf_planes::test
