// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "process.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::test {

/** \brief A folder of its own for each test, and the apps run in it. */
class CliTest : public ::testing::Test {
protected:
  void SetUp() override
  {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("pcl_mrf_planes_") + info->test_suite_name() + '_' +
                       info->name() + '_' + std::to_string(::getpid());
    for (char& c : name)
      c = c == '/' ? '_' : c;
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(folder_ / "files");
    std::filesystem::create_directories(folder_ / "scratch");
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  /** \brief Path of a file in the test's folder. */
  std::string path(const std::string& name) const
  {
    return (folder_ / "files" / name).string();
  }

  Outcome
  run(const std::string& program, const std::vector<std::string>& arguments,
      const std::vector<std::pair<std::string, std::string>>& environment = {}) const
  {
    return runProcess(program, arguments, (folder_ / "scratch").string(), environment);
  }

  Outcome segment(const std::vector<std::string>& arguments) const
  {
    return run(PCL_MRF_PLANES_SEGMENTATION_APP, arguments);
  }

  /** \brief Names of the files there are, to see what a run left behind. */
  std::set<std::string> files() const
  {
    std::set<std::string> names;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_ / "files"))
      names.insert(entry.path().filename().string());
    return names;
  }

  void write(const std::string& name, const std::string& content) const
  {
    std::ofstream(path(name), std::ios::binary) << content;
  }

  std::string read(const std::string& name) const
  {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }

private:
  std::filesystem::path folder_;
};

} // namespace pcl_mrf_planes::test
