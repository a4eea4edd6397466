// SPDX-License-Identifier: BSD-3-Clause
// Everything that the evaluation refuses, and what it says then.
#include "evaluation_test.h"

#include <pcl/io/png_io.h>

#include <filesystem>

namespace pcl_mrf_planes::test {

using reference::drawn;
using EvaluationErrors = EvaluationApp;

TEST_F(EvaluationErrors, WrongUse)
{
  writeLabels(path("a.png"), TRUTH);
  const std::string a = path("a.png");
  expectFailure({}, 2, "nothing to score");
  expectFailure({a}, 2, "has no partner");
  expectFailure({a, a, a}, 2, "has no partner");
  expectFailure({a, a, "--truth", path("")}, 2, "both files and folders");
  expectFailure({"--truth", path("")}, 2, "--truth needs --labels");
  expectFailure({"--labels", path("")}, 2, "--labels needs --truth");
  expectFailure({a, a, "--no-such-option"}, 2, "no-such-option");
  expectFailure({a, a, "-x"}, 2, "unknown option '-x'");
  expectFailure({a, a, "--json", ""}, 2, "--json");
  for (const char* tolerance : {"0.5", "1.1", "nan", "high", "0.8x"})
    expectFailure({a, a, "--tolerance", tolerance}, 2, tolerance);
  for (const char* count : {"-1", "0.5", "many"})
    expectFailure({a, a, "--min-points", count}, 2, count);
  expectFailure({a, a, "--border", "-1"}, 2, "whole number from 0");
  expectFailure({a, a, "--json", path("o"), "--csv", path("o")}, 2, "the same file");
  expectFailure({a, a, "--json", a}, 2, "would overwrite");
}

TEST_F(EvaluationErrors, FoldersThatDoNotServe)
{
  writeSets();
  writeLabels(path("a.png"), TRUTH);
  std::filesystem::create_directories(path("empty"));
  expectFailure({"--truth", path("none"), "--labels", path("result")}, 1,
                "none' does not exist");
  expectFailure({"--truth", path("truth"), "--labels", path("none")}, 1,
                "none' does not exist");
  expectFailure({"--truth", path("a.png"), "--labels", path("result")}, 1,
                "is not a folder");
  expectFailure({"--truth", path("empty"), "--labels", path("result")}, 1,
                "has no file that ends in gt.png or faces.png or pgt.png");
  expectFailure(
      {"--truth", path("truth"), "--labels", path("result"), "--cloud", path("none")},
      1, "none' does not exist");
  expectFailure({path("a.png"), path("empty")}, 1, "is a folder");
  expectFailure({path("a.png"), path("a.png"), "--csv", path("none/o.csv")}, 1,
                "there is no folder");
}

TEST_F(EvaluationErrors, FilesThatAreNoLabelImages)
{
  write("text.png", "This is not a picture.");
  write("empty.png", "");
  const std::vector<unsigned char> bytes(3 * 24, 1);
  pcl::io::saveCharPNGFile(path("eight.png"), bytes.data(), 8, 3, 1);
  pcl::io::saveRgbPNGFile(path("colour.png"), bytes.data(), 8, 3);
  writeLabels(path("narrow.png"), drawn({"1111"}));
  expectBadFile("none.png", "does not exist");
  expectBadFile("text.png", "is not a PNG file");
  expectBadFile("empty.png", "is not a PNG file");
  expectBadFile("eight.png", "has 8 bits a point");
  expectBadFile("colour.png", "in colour");
  expectBadFile("narrow.png", "4 x 1");

  writeLabels(path("whole.png"), TRUTH);
  const std::string whole = read("whole.png");
  for (std::size_t length = 8; length < whole.size() - 4; length += 5) {
    write("cut.png", whole.substr(0, length));
    expectBadFile("cut.png", "truncated or damaged");
  }
  std::string wrong = whole;
  wrong[whole.find("IDAT") + 8] ^= 0x40;
  write("wrong.png", wrong);
  expectBadFile("wrong.png", "truncated or damaged");
}

TEST_F(EvaluationErrors, CloudsThatHaveNoLabels)
{
  writeLabelCloud(path("labels.pcd"), TRUTH);
  const std::string whole = read("labels.pcd");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    return text.replace(text.find(from), from.size(), to);
  };
  write("other.pcd", with("label", "ladle"));
  write("float.pcd", with("F F F U", "F F F F"));
  std::string large = whole;
  large[large.size() - 2] = 1; // of the last label, the lowest byte first
  write("large.pcd", large);
  write("cut.pcd", whole.substr(0, whole.size() - 10));
  expectBadFile("other.pcd", "has no field 'label'");
  expectBadFile("float.pcd", "no whole number");
  expectBadFile("large.pcd", "has the label 65536");
  expectBadFile("cut.pcd", "truncated");
}

} // namespace pcl_mrf_planes::test
