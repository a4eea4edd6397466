// SPDX-License-Identifier: BSD-3-Clause
// The JSON of the app against the schema in doc/, by another's validator.
#include "batch_test.h"

namespace pcl_mrf_planes::test {

class Schema : public BatchTest {
protected:
  void SetUp() override
  {
    BatchTest::SetUp();
    if (run("/usr/bin/python3", {"-c", "import jsonschema"}).status != 0)
      GTEST_SKIP() << "python3-jsonschema is not installed";
  }

  Outcome validate(const std::string& name) const
  {
    return run("/usr/bin/python3",
               {"-c",
                "import json, sys, jsonschema\n"
                "schema = json.load(open(sys.argv[1]))\n"
                "jsonschema.Draft7Validator.check_schema(schema)\n"
                "jsonschema.validate(json.load(open(sys.argv[2])), schema,\n"
                "                    cls=jsonschema.Draft7Validator)\n",
                PCL_MRF_PLANES_SOURCE "/doc/frame.schema.json", path(name)});
  }
};

TEST_F(Schema, HoldsForEveryProfileAndReader)
{
  writeScene("in/1.pcd");
  writeDepth("in/2.depth.png");
  write("in/camera.json", R"({"fx": 150, "fy": 150, "cx": 80, "cy": 60})");
  ASSERT_EQ(batch({}).status, 0);
  for (const char* name : {"out/1.json", "out/2.json"}) {
    const Outcome outcome = validate(name);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{},
        {"--timing", "--repeat", "2"},
        {"--profile", "paper", "--energy"},
        {"--profile", "fast"},
        {"--max-growth", "1", "--min-points", "1000000"}}) {
    std::vector<std::string> arguments = {path("in/1.pcd"), "--models", path("m.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ASSERT_EQ(segment(arguments).status, 0);
    const Outcome outcome = validate("m.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
}

TEST_F(Schema, DoesNotHoldForOthers)
{
  writeScene("in/1.pcd");
  ASSERT_EQ(batch({}).status, 0);
  const Json good = Json::parse(read("out/1.json"));
  const auto expectWrong = [&](const char* pointer, const Json& value) {
    Json bad = good;
    bad[Json::json_pointer(pointer)] = value;
    write("bad.json", bad.dump());
    EXPECT_NE(validate("bad.json").status, 0) << pointer;
  };
  expectWrong("/planes/0/label", 0);
  expectWrong("/planes/0/coefficients", {1, 2, 3});
  expectWrong("/counts/labelled_share", 1.5);
  expectWrong("/version", "new");
  expectWrong("/parameters/profile", "other");
  expectWrong("/counts/surprise", 1);
}

} // namespace pcl_mrf_planes::test
