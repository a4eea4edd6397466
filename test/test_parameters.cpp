// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/parameter_table.h>
#include <pcl_mrf_planes/parameters.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace pcl_mrf_planes {
namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double ENDLESS = std::numeric_limits<double>::infinity();

TEST(ParametersTest, PaperHasTheValuesOfSectionV)
{
  const Parameters p = Parameters::fromProfile(Profile::PAPER);
  EXPECT_EQ(p.tile_width, 40);
  EXPECT_EQ(p.tile_height, 40);
  EXPECT_EQ(p.beta, 0.4);
  EXPECT_EQ(p.merge_threshold, 0.15);
  EXPECT_EQ(p.iterations, 5);
  EXPECT_EQ(p.lambda, 0.2);
  EXPECT_EQ(p.tau, 0.5);
  EXPECT_EQ(p.fit, PlaneFit::ALGEBRAIC) << "equation (4) is the scatter matrix";
  EXPECT_EQ(p.smoothness, Smoothness::HYBRID) << "the paper's choice is equation (10)";
  EXPECT_EQ(p.noise_multiplier, 1.0);
  EXPECT_EQ(p.noise.sigma(2.0), NoiseModel::kinect().sigma(2.0));
  EXPECT_EQ(p.min_inliers, 0) << "in the paper every plane stays";
  EXPECT_LT(p.convergence_tolerance, 0.0) << "the paper does all its iterations";
  EXPECT_EQ(p.validate(), "") << "the paper's own values must be valid";
}

struct Setting {
  const char* name;
  std::function<void(Parameters&, double)> set;
  double low, high;
  bool whole; ///< an integer parameter
};

void PrintTo(const Setting& setting, std::ostream* out)
{
  *out << setting.name;
}

Setting whole(const char* name, int Parameters::*member, double low, double high)
{
  return {name, [member](Parameters& p, double v) { p.*member = static_cast<int>(v); },
          low, high, true};
}

Setting real(const char* name, double Parameters::*member, double low, double high)
{
  return {name, [member](Parameters& p, double v) { p.*member = v; }, low, high, false};
}

Setting whole(const char* name, int AdaptiveParameters::*member, double low,
              double high)
{
  return {
      name,
      [member](Parameters& p, double v) { p.adaptive.*member = static_cast<int>(v); },
      low, high, true};
}

Setting real(const char* name, double AdaptiveParameters::*member, double low,
             double high)
{
  return {name, [member](Parameters& p, double v) { p.adaptive.*member = v; }, low,
          high, false};
}

class ParameterRangeTest : public testing::TestWithParam<Setting> {};

TEST_P(ParameterRangeTest, EndsAreTakenAndBeyondIsNamed)
{
  const Setting& setting = GetParam();
  const auto complaint = [&](double value) {
    Parameters p;
    setting.set(p, value);
    return p.validate();
  };
  EXPECT_EQ(complaint(setting.low), "") << "the lower end belongs to the range";
  EXPECT_EQ(complaint(setting.high), "") << "the upper end belongs to the range";
  for (const double bad : {setting.low - 1.0, setting.high + 1.0}) {
    const std::string said = complaint(bad);
    EXPECT_NE(said.find(setting.name), std::string::npos)
        << "a value of " << bad << " must be refused by name, got '" << said << "'";
  }
  if (!setting.whole) {
    for (const double bad : {NOT_A_NUMBER, ENDLESS, -ENDLESS}) {
      EXPECT_NE(complaint(bad).find(setting.name), std::string::npos)
          << bad << " must be refused by name";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ParameterRangeTest,
    testing::Values(whole("tile_width", &Parameters::tile_width, 2, 4096),
                    whole("tile_height", &Parameters::tile_height, 2, 4096),
                    real("noise_multiplier", &Parameters::noise_multiplier, 1e-6, 1e6),
                    real("min_valid_share", &Parameters::min_valid_share, 0, 1),
                    real("beta", &Parameters::beta, 0, 1e6),
                    real("merge_threshold", &Parameters::merge_threshold, 0, 1e6),
                    whole("max_planes", &Parameters::max_planes, 1, 4096),
                    real("lambda", &Parameters::lambda, 0, 1e6),
                    real("tau", &Parameters::tau, 1e-6, 1e6),
                    real("gamma", &Parameters::gamma, 0, 1e6),
                    whole("iterations", &Parameters::iterations, 0, 100000),
                    real("convergence_tolerance", &Parameters::convergence_tolerance,
                         -1e6, 1e6),
                    whole("min_inliers", &Parameters::min_inliers, 0, 1e9)));

INSTANTIATE_TEST_SUITE_P(
    Adaptive, ParameterRangeTest,
    testing::Values(
        whole("levels", &AdaptiveParameters::levels, 2, 8),
        real("tile_tolerance", &AdaptiveParameters::tile_tolerance, 1e-6, 1e6),
        real("min_fill", &AdaptiveParameters::min_fill, 0, 1),
        real("noise_percentile", &AdaptiveParameters::noise_percentile, 0, 1),
        real("growth_percentile", &AdaptiveParameters::growth_percentile, 0, 1),
        real("max_growth", &AdaptiveParameters::max_growth, 1, 1e6),
        real("long_range", &AdaptiveParameters::long_range, 1, 1e6),
        real("flatness", &AdaptiveParameters::flatness, 0, 1e6),
        real("max_flatness", &AdaptiveParameters::max_flatness, 0, 1e6),
        real("flatness_noise", &AdaptiveParameters::flatness_noise, 0, 1e6),
        real("quiet_flatness", &AdaptiveParameters::quiet_flatness, 0, 1),
        real("min_sigma", &AdaptiveParameters::min_sigma, 1e-9, 1e6),
        whole("local_reach", &AdaptiveParameters::local_reach, 0, 16),
        real("local_percentile", &AdaptiveParameters::local_percentile, 0, 1),
        real("max_local", &AdaptiveParameters::max_local, 1, 1e6),
        real("merge_tolerance", &AdaptiveParameters::merge_tolerance, 1e-6, 1e6),
        real("region_tolerance", &AdaptiveParameters::region_tolerance, 1e-6, 1e6),
        real("accept_tolerance", &AdaptiveParameters::accept_tolerance, 1e-6, 1e6),
        whole("min_points", &AdaptiveParameters::min_points, 1, 1e9),
        real("min_evidence", &AdaptiveParameters::min_evidence, 0, 1e9),
        real("join_tolerance", &AdaptiveParameters::join_tolerance, 1e-6, 1e6),
        real("join_gap", &AdaptiveParameters::join_gap, 0, 1e4),
        real("join_seen", &AdaptiveParameters::join_seen, 0, 1),
        whole("fan_parts", &AdaptiveParameters::fan_parts, 0, 1e6),
        real("fan_angle", &AdaptiveParameters::fan_angle, 0, 90),
        real("fan_share", &AdaptiveParameters::fan_share, 0, 1),
        real("fan_border", &AdaptiveParameters::fan_border, 0, 1e6),
        real("fan_gap", &AdaptiveParameters::fan_gap, 0, 1e6),
        real("fan_ring", &AdaptiveParameters::fan_ring, 0, 2),
        real("bend_angle", &AdaptiveParameters::bend_angle, 0, 720),
        whole("support_reach", &AdaptiveParameters::support_reach, 1, 512),
        real("none_cost", &AdaptiveParameters::none_cost, 1e-6, 1e3),
        real("label_change", &AdaptiveParameters::label_change, 0, 1e3),
        real("step_sigmas", &AdaptiveParameters::step_sigmas, 1e-6, 1e6),
        real("min_weight", &AdaptiveParameters::min_weight, 0, 1),
        whole("sampling", &AdaptiveParameters::sampling, 1, 8),
        whole("least_samples", &AdaptiveParameters::least_samples, 0, 1e9),
        whole("passes", &AdaptiveParameters::passes, 0, 100000),
        whole("rounds", &AdaptiveParameters::rounds, 1, 10)));

TEST(ParametersTest, TheSmallestTilesAreNoneOfTheLargest)
{
  Parameters p;
  p.adaptive.levels = 3;
  for (const int good : {0, 1, 2}) {
    p.adaptive.smallest_level = good;
    EXPECT_EQ(p.validate(), "") << good << " of 3 sizes left out";
  }
  for (const int bad : {-1, 3, 8}) {
    p.adaptive.smallest_level = bad;
    EXPECT_EQ(p.validate().find("smallest_level is " + std::to_string(bad)), 0U)
        << "no size is left, got '" << p.validate() << "'";
  }
}

TEST(ParametersTest, NoNumberOfLevelsIsTooFarOut)
{
  // Found by fuzzing: the check of the next parameter took one from this one.
  Parameters p;
  p.adaptive.levels = std::numeric_limits<int>::min();
  EXPECT_NE(p.validate().find("levels"), std::string::npos) << p.validate();
}

TEST(ParametersTest, OnePlaneIsNoFan)
{
  Parameters p;
  p.adaptive.fan_parts = 1;
  EXPECT_EQ(p.validate().find("fan_parts is 1"), 0U)
      << "every plane would be one, got '" << p.validate() << "'";
}

TEST(ParametersTest, ANoiseWithoutLimitIsForThePaperOnly)
{
  Parameters p;
  p.noise = NoiseModel::none();
  EXPECT_EQ(p.validate(), "") << "the default profile estimates the noise";
  p.adaptive.estimate_noise = false;
  EXPECT_EQ(p.validate().find("noise has no limit"), 0U) << p.validate();
  p.method = Method::PAPER;
  EXPECT_EQ(p.validate(), "") << "the paper keeps every tile then";
  p.method = Method::ADAPTIVE;
  p.noise = {0.01, 0.0, 1e5};
  EXPECT_EQ(p.validate().find("noise has no limit"), 0U)
      << "far away: " << p.validate();
}

TEST(ParametersTest, ProfilesNameTheMethodAndShareTheOtherValues)
{
  EXPECT_EQ(Parameters().method, Method::ADAPTIVE) << "the default in the class";
  EXPECT_EQ(Parameters::fromProfile(Profile::DEFAULT).method, Method::ADAPTIVE);
  EXPECT_EQ(Parameters::fromProfile(Profile::PAPER).method, Method::PAPER);
  EXPECT_EQ(Parameters::fromProfile(Profile::FAST).method, Method::ADAPTIVE);
  for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER})
    EXPECT_EQ(Parameters::fromProfile(profile).validate(), "")
        << "the values of a profile must be valid";
}

TEST(ParametersTest, ThreadsHaveAnUpperEnd)
{
  Parameters p;
  for (const unsigned int good : {0U, 1U, 64U}) {
    p.number_of_threads = good;
    EXPECT_EQ(p.validate(), "") << good << " threads must be allowed";
  }
  p.number_of_threads = 4000000000U;
  EXPECT_NE(p.validate().find("number_of_threads"), std::string::npos)
      << "a negative number cast to unsigned must be caught";
}

TEST(ParametersTest, NoiseMustBePositiveAndANumber)
{
  Parameters p;
  for (const NoiseModel& bad :
       {NoiseModel{0, 0, 0}, NoiseModel{-1, 0, 0}, NoiseModel{NOT_A_NUMBER, 0, 0},
        NoiseModel{0, NOT_A_NUMBER, 0}, NoiseModel{0, 0, NOT_A_NUMBER},
        NoiseModel{std::numeric_limits<double>::infinity(), 1e308, -1e308}}) {
    p.noise = bad;
    EXPECT_NE(p.validate().find("noise"), std::string::npos)
        << "noise " << bad.a << " " << bad.b << " " << bad.c << " must be refused";
  }
  p.noise = NoiseModel::none();
  EXPECT_EQ(p.validate(), "") << "the preset none is a valid choice";
}

TEST(ParametersTest, TheFirstComplaintIsOneSentenceWithTheRange)
{
  Parameters p;
  p.lambda = -3;
  const std::string said = p.validate();
  EXPECT_NE(said.find("-3"), std::string::npos) << "must quote the value: " << said;
  EXPECT_NE(said.find("0"), std::string::npos) << "must state the range: " << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << "one sentence: " << said;
}

TEST(ParameterTableTest, EveryEntrySetsItsOwnValueOnly)
{
  const Parameters defaults;
  for (const ParameterEntry& entry : parameterTable()) {
    Parameters changed;
    const double other = entry.get(defaults) == entry.high ? entry.low : entry.high;
    entry.set(changed, other);
    EXPECT_EQ(entry.get(changed), other) << entry.name;
    for (const ParameterEntry& rest : parameterTable()) {
      if (&rest != &entry) {
        EXPECT_EQ(rest.get(changed), rest.get(defaults))
            << entry.name << " changes " << rest.name;
      }
    }
  }
}

TEST(ParameterTableTest, SlidersLieInTheRangeAroundTheValuesOfAllProfiles)
{
  for (const ParameterEntry& entry : parameterTable()) {
    EXPECT_LE(entry.low, entry.usual_low) << entry.name;
    EXPECT_LT(entry.usual_low, entry.usual_high) << entry.name;
    EXPECT_LE(entry.usual_high, entry.high) << entry.name;
    EXPECT_FALSE(entry.help.empty()) << entry.name;
    for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER}) {
      const double value = entry.get(Parameters::fromProfile(profile));
      EXPECT_LE(entry.usual_low, value) << entry.name;
      EXPECT_GE(entry.usual_high, value) << entry.name;
    }
  }
}

TEST(ParameterTableTest, ValuesOutsideComeToTheNearerEnd)
{
  const ParameterEntry* tau = findParameter("tau");
  ASSERT_NE(tau, nullptr);
  Parameters p;
  tau->set(p, 1e9);
  EXPECT_EQ(p.tau, tau->high);
  tau->set(p, NOT_A_NUMBER);
  EXPECT_EQ(p.tau, tau->low);
  EXPECT_EQ(findParameter("no_such_name"), nullptr);
}

TEST(ParameterTableTest, ChoicesPrintTheirNames)
{
  Parameters p;
  p.smoothness = Smoothness::PREDICTED_DEPTH;
  p.fit = PlaneFit::GEOMETRIC;
  p.depth_measure = DepthMeasure::OPTICAL_AXIS;
  p.adaptive.join_coplanar = false;
  EXPECT_EQ(findParameter("smoothness")->print(p), "predicted-depth");
  EXPECT_EQ(findParameter("fit")->print(p), "geometric");
  EXPECT_EQ(findParameter("depth_measure")->print(p), "z");
  EXPECT_EQ(findParameter("join_coplanar")->print(p), "false");
}

TEST(ParameterTableTest, NumbersPrintTheShortestThatReadsBack)
{
  const ParameterEntry* tau = findParameter("tau");
  Parameters p;
  for (const double value : {0.25, 0.1, 1e-6, 1.0 / 3.0, 0.1 + 0.2}) {
    tau->set(p, value);
    EXPECT_EQ(std::stod(tau->print(p)), value) << tau->print(p);
  }
  tau->set(p, 0.1);
  EXPECT_EQ(tau->print(p), "0.1");
  const ParameterEntry* points = findParameter("min_inliers");
  points->set(p, 250.9);
  EXPECT_EQ(points->print(p), "250") << "whole numbers have no fraction";
}

TEST(ParameterTableTest, KnowsWhatIsWholeAndWhoUsesIt)
{
  for (const char* name : {"min_inliers", "levels", "smoothness", "join_coplanar"})
    EXPECT_TRUE(findParameter(name)->isWhole()) << name;
  for (const char* name : {"tau", "min_area", "min_sigma"})
    EXPECT_FALSE(findParameter(name)->isWhole()) << name;
  EXPECT_TRUE(findParameter("tau")->isUsedBy(Method::PAPER));
  EXPECT_FALSE(findParameter("tau")->isUsedBy(Method::ADAPTIVE));
  EXPECT_FALSE(findParameter("levels")->isUsedBy(Method::PAPER));
  EXPECT_TRUE(findParameter("levels")->isUsedBy(Method::ADAPTIVE));
  EXPECT_TRUE(findParameter("min_inliers")->isUsedBy(Method::PAPER));
  EXPECT_TRUE(findParameter("min_inliers")->isUsedBy(Method::ADAPTIVE));
}

} // namespace
} // namespace pcl_mrf_planes
