// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli_test.h"
#include "label_files.h"
#include "reference/label_images.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pcl_mrf_planes::test {

inline const evaluation::LabelImage TRUTH =
    reference::drawn({"11112222", "11112222", "33330000"});
inline const evaluation::LabelImage MERGED =
    reference::drawn({"11111111", "11111111", "33330000"});

/** \brief The evaluation, run in a folder of its own. */
class EvaluationApp : public CliTest {
protected:
  Outcome evaluate(const std::vector<std::string>& arguments) const
  {
    return run(PCL_MRF_PLANES_EVALUATION_APP, arguments);
  }

  /// What --json says, the run having gone well.
  nlohmann::json report(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.end(), {"--quiet", "--json", path("report.json")});
    const Outcome outcome = evaluate(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    return nlohmann::json::parse(read("report.json"), nullptr, false);
  }

  /// Two sets of two frames and one: c is perfect, a merges planes, b has no result.
  void writeSets() const
  {
    writeLabels(path("truth/one/a.gt.png"), TRUTH);
    writeLabels(path("truth/one/b.pgt.png"), TRUTH);
    writeLabels(path("truth/two/deep/c.faces.png"), TRUTH);
    writeLabels(path("result/one/a.png"), MERGED);
    writeLabels(path("result/two/deep/c.labels.png"), TRUTH);
  }

  /// The run fails with one line that holds \a message, and leaves no trace.
  void expectFailure(const std::vector<std::string>& arguments, int status,
                     const std::string& message) const
  {
    const auto before = files();
    const Outcome outcome = evaluate(arguments);
    EXPECT_EQ(outcome.status, status) << message << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.find("pcl_mrf_plane_evaluation: "), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos)
        << "expected '" << message << "' in: " << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1)
        << "more than one line: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before) << message << ": a file was left";
  }

  /// A result that cannot be scored, beside a good truth; and in the truth's place.
  void expectBadFile(const std::string& name, const std::string& message) const
  {
    SCOPED_TRACE(name);
    writeLabels(path("good.gt.png"), TRUTH);
    const std::string good = path("good.gt.png");
    const std::vector<std::string> outputs = {"--json", path("o.json"), "--csv",
                                              path("o.csv")};
    for (const auto& pair : {std::vector<std::string>{good, path(name)},
                             std::vector<std::string>{path(name), good}}) {
      std::vector<std::string> arguments = pair;
      arguments.insert(arguments.end(), outputs.begin(), outputs.end());
      expectFailure(arguments, 1, message);
      expectFailure(arguments, 1, name);
    }
  }
};

} // namespace pcl_mrf_planes::test
