// SPDX-License-Identifier: BSD-3-Clause
/** \file What is seen, without a window. */
#include "label_contours.h"
#include "model_test.h"
#include "panel_image.h"
#include "pick_point.h"
#include "point_colours.h"
#include "view_text.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <set>

namespace pcl_mrf_planes::test {

namespace {

using namespace viewer;

class Model : public ModelTest {};

TEST(Actions, KeysAreDifferentAndAllHelp)
{
  std::set<std::string> keys, texts;
  std::set<Action> actions;
  for (const KeyBinding& binding : keyBindings()) {
    EXPECT_TRUE(keys.insert(binding.key).second) << binding.key;
    EXPECT_TRUE(texts.insert(binding.help).second) << binding.help;
    actions.insert(binding.action);
    EXPECT_NE(keyHelp().find(binding.help), std::string::npos);
    EXPECT_EQ(actionOfKey(binding.key), binding.action);
  }
  EXPECT_EQ(actions.size(), static_cast<std::size_t>(Action::QUIT) + 1);
  EXPECT_FALSE(actionOfKey("F35"));
}

TEST(Sliders, SetWhatTheyShowAndStayValid)
{
  for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER}) {
    const Parameters start = Parameters::fromProfile(profile);
    for (const ParameterSlider& slider : slidersOf(start.method)) {
      EXPECT_GE(slider.get(start), slider.low) << slider.title;
      EXPECT_LE(slider.get(start), slider.high) << slider.title;
      for (const double share : {-1.0, 0.0, 0.37, 1.0, 2.0}) {
        Parameters changed = start;
        const double value = slider.low + share * (slider.high - slider.low);
        moveSlider(slider, value, changed);
        EXPECT_EQ(changed.validate(), "") << slider.title << ' ' << value;
        const double inside = std::min(slider.high, std::max(slider.low, value));
        EXPECT_NEAR(slider.get(changed), inside, slider.whole ? 0.5 : 1e-9)
            << slider.title;
      }
    }
  }
}

TEST(PickPoint, TakesTheForemostOfThoseShown)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.push_back({0.0f, 0.0f, 0.5f});
  cloud.push_back({0.0f, 0.0f, 0.2f});
  cloud.push_back({0.6f, 0.0f, 0.0f});
  const Eigen::Matrix4d same = Eigen::Matrix4d::Identity();
  const Eigen::Vector2d reach(0.1, 0.1);
  EXPECT_EQ(pickPoint(cloud, {true, true, true}, same, {0.05, 0.0}, reach), 1);
  EXPECT_EQ(pickPoint(cloud, {true, false, true}, same, {0.05, 0.0}, reach), 0);
  EXPECT_EQ(pickPoint(cloud, {true, true, true}, same, {0.0, 0.5}, reach), -1);
}

TEST_F(Model, ColoursStayWithTheirPlanesWhenParametersChange)
{
  Session session = open({room("room.pcd")});
  const SegmentedView before = session.main();
  const std::vector<std::uint32_t> colours = session.mainColours();
  Parameters changed = session.parameters();
  changed.min_inliers = 2000;
  session.setParameters(changed);
  ASSERT_LT(session.main().planes.size(), before.planes.size());
  std::size_t same = 0, labelled = 0;
  for (std::size_t i = 0; i < before.labels.size(); ++i) {
    const std::uint16_t now = session.main().labels[i];
    if (before.labels[i] == 0 || now == 0)
      continue;
    ++labelled;
    same += colours[before.labels[i] - 1u] == session.mainColours()[now - 1u];
  }
  EXPECT_GT(static_cast<double>(same), 0.95 * static_cast<double>(labelled));
}

TEST_F(Model, SelectionAndHiddenPlanesStayWhenParametersChange)
{
  Session session = open({room("room.pcd")});
  session.settings.hidden = {1};
  session.settings.selected = 2;
  const std::uint32_t hidden = session.mainColours()[0];
  const std::uint32_t selected = session.mainColours()[1];
  Parameters changed = session.parameters();
  changed.min_inliers = 2000;
  session.setParameters(changed);
  ASSERT_EQ(session.settings.hidden.size(), 1u);
  EXPECT_EQ(session.mainColours()[*session.settings.hidden.begin() - 1u], hidden);
  ASSERT_NE(session.settings.selected, 0);
  EXPECT_EQ(session.mainColours()[session.settings.selected - 1u], selected);

  changed.min_inliers = static_cast<int>(session.frame().cloud->size());
  session.setParameters(changed); // no plane is left
  EXPECT_TRUE(session.main().planes.empty());
  EXPECT_TRUE(session.settings.hidden.empty());
  EXPECT_EQ(session.settings.selected, 0);
}

TEST_F(Model, ComparesSideBySide)
{
  Session session = open({room("room.pcd")});
  std::set<std::string> methods;
  for (int k = 0; k < 4; ++k) {
    session.perform(Action::COMPARE);
    ASSERT_TRUE(session.compares());
    EXPECT_EQ(session.other().labels.size(), session.main().labels.size());
    EXPECT_EQ(session.otherColours().size(), session.other().planes.size());
    EXPECT_GE(session.other().planes.size(), 2u) << session.other().method;
    methods.insert(session.other().method);
  }
  EXPECT_EQ(methods.size(), 4u);
  session.perform(Action::COMPARE);
  EXPECT_FALSE(session.compares());
}

TEST_F(Model, WhatIsComparedHasOneScale)
{
  Session session = open({room("room.pcd")});
  session.settings.mode = ColourMode::DISTANCE;
  const auto colours = [&](const SegmentedView& view,
                           const std::optional<ColourScale>& scale) {
    return colourPoints(session.frame(), view, {}, session.settings, {}, scale);
  };
  Session paper = open({path("room.pcd")}, Profile::PAPER);
  const PointColours left = colours(session.main(), {});
  ASSERT_TRUE(left.scale);
  const PointColours alone = colours(paper.main(), {});
  const PointColours right = colours(paper.main(), left.scale);
  EXPECT_EQ(right.scale->high, left.scale->high);
  EXPECT_GT(alone.scale->high, left.scale->high) << "worse planes";
  EXPECT_NE(right.colours, alone.colours);
  session.settings.mode = ColourMode::PLANE;
  EXPECT_FALSE(colours(session.main(), {}).scale);
}

TEST_F(Model, HidesAndIsolatesPlanes)
{
  Session session = open({room("room.pcd")});
  const auto shown = [&] {
    const PointColours colours =
        colourPoints(session.frame(), session.main(), session.tiles(), session.settings,
                     session.mainColours());
    return static_cast<std::size_t>(
        std::count(colours.shown.begin(), colours.shown.end(), true));
  };
  const std::size_t all = shown();
  const std::size_t first = session.main().planes[0].points;
  session.perform(Action::SELECT_NEXT);
  session.perform(Action::ISOLATE);
  EXPECT_EQ(shown(), first);
  session.perform(Action::ISOLATE);
  session.perform(Action::HIDE);
  EXPECT_EQ(shown(), all - first);
  session.perform(Action::SHOW_ALL);
  EXPECT_EQ(shown(), all);
  session.perform(Action::HIDE);
  EXPECT_FALSE(session.message().empty());
}

TEST_F(Model, PickedPointTellsOfItsPlane)
{
  Session session = open({room("room.pcd")});
  const auto place = std::find(session.main().labels.begin(),
                               session.main().labels.end(), std::uint16_t{1});
  session.pick(place - session.main().labels.begin());
  EXPECT_EQ(session.settings.selected, 1);
  for (const char* word : {"plane 1", "m2", "rms", "distance", "confidence", "depth",
                           "standard deviation"})
    EXPECT_NE(selectionText(session).find(word), std::string::npos) << word;
  session.perform(Action::DESELECT);
  EXPECT_EQ(selectionText(session), "");
}

TEST_F(Model, DistancesAreThoseToThePlane)
{
  Session session = open({room("room.pcd")});
  const SegmentedView& view = session.main();
  for (std::size_t k = 0; k < view.planes.size(); ++k) {
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < view.labels.size(); ++i)
      if (view.labels[i] == k + 1) {
        squares += std::pow(distanceToPlane(session.frame(), view, i), 2);
        ++count;
      }
    EXPECT_EQ(count, view.planes[k].points);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), view.planes[k].rms,
                1e-4);
  }
}

TEST_F(Model, DeviationsAreThoseOfTheCovariance)
{
  Session session = open({room("room.pcd")});
  const std::vector<PlaneUncertainty> expected = uncertaintiesOf(session);
  const std::vector<PlaneDeviations> deviations = session.main().deviations();
  ASSERT_EQ(deviations.size(), expected.size());
  ASSERT_GE(deviations.size(), 2u);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double variance = std::pow(deviations[k].normal, 2);
    // The larger eigenvalue lies between the larger diagonal element and the trace.
    EXPECT_GE(variance * (1.0 + 1e-9),
              std::max(expected[k].minimal(0, 0), expected[k].minimal(1, 1)));
    const double trace = expected[k].minimal(0, 0) + expected[k].minimal(1, 1);
    EXPECT_LE(variance, (1.0 + 1e-9) * trace);
    EXPECT_NEAR(deviations[k].offset, std::sqrt(expected[k].minimal(2, 2)), 1e-12);
  }
}

TEST_F(Model, CreasesLieOnBothPlanes)
{
  Session session = open({room("room.pcd")});
  session.perform(Action::CREASES);
  EXPECT_TRUE(session.settings.creases);
  const SegmentedView& view = session.main();
  const std::vector<PlaneCrease> creases = view.creases();
  ASSERT_FALSE(creases.empty());
  for (const PlaneCrease& crease : creases)
    for (const std::size_t k : {crease.first, crease.second})
      for (const Eigen::Vector3d& end : {crease.start, crease.end})
        EXPECT_NEAR(view.planes.at(k).normal.dot(end) + view.planes[k].d, 0.0, 1e-3);
}

TEST_F(Model, FilmEndsWithTheResult)
{
  for (const Profile profile : {Profile::DEFAULT, Profile::PAPER}) {
    Session session = open({room("room.pcd")}, profile);
    session.perform(Action::FILM);
    const AlgorithmFilm& film = session.film();
    ASSERT_GT(film.steps.size(), 4u);
    EXPECT_EQ(film.steps.back().labels, session.main().labels);
    ASSERT_GE(film.energy.size(), 2u);
    for (std::size_t k = 0; k < 2 * film.steps.size(); ++k)
      session.perform(Action::FILM_FORWARD);
    EXPECT_EQ(session.settings.film_step, static_cast<int>(film.steps.size()) - 1);
    for (const FilmStep& step : film.steps)
      for (const std::uint16_t label : step.labels)
        ASSERT_LE(label, step.classes.size()) << step.title;
  }
}

TEST_F(Model, FilmsCurveIsTheEnergyOfTheInference)
{
  Session session = open({room("room.pcd")}, Profile::PAPER);
  session.perform(Action::FILM);
  Parameters parameters = session.parameters();
  parameters.compute_energy = true;
  const auto energy = segmentPlanes(session.frame().points, parameters).report.energy;
  ASSERT_EQ(session.film().energy.size(), energy.size());
  for (std::size_t k = 0; k < energy.size(); ++k)
    EXPECT_DOUBLE_EQ(session.film().energy[k], energy[k].total()) << k;
}

TEST_F(Model, SequenceStopsAtItsEndOrLoops)
{
  std::filesystem::create_directories(path("frames"));
  for (int k = 0; k < 2; ++k)
    room("frames/" + std::to_string(k) + ".pcd", k);
  Session session = open({path("frames")});
  EXPECT_FALSE(session.advance(10.0)); // paused
  session.perform(Action::PLAY);
  EXPECT_FALSE(session.advance(0.01));
  EXPECT_TRUE(session.advance(10.0));
  EXPECT_EQ(session.frameIndex(), 1u);
  EXPECT_TRUE(session.advance(10.0));
  EXPECT_EQ(session.frameIndex(), 0u);
  session.perform(Action::LOOP);
  session.advance(10.0);
  session.advance(10.0);
  EXPECT_EQ(session.frameIndex(), 1u);
  EXPECT_FALSE(session.playing());
}

TEST_F(Model, FramesWorkedOnAheadAreThoseOfADirectLook)
{
  std::filesystem::create_directories(path("frames"));
  for (int k = 0; k < 4; ++k)
    room("frames/" + std::to_string(k) + ".pcd", k);
  Session session = open({path("frames")});
  const auto expectDirectLook = [&] {
    const std::string name = std::to_string(session.frameIndex());
    Session direct = open({path("frames/" + name + ".pcd")});
    direct.setParameters(session.parameters());
    EXPECT_EQ(session.frame().name, name);
    EXPECT_EQ(session.main().labels, direct.main().labels) << name;
    const bool compared = session.other().labels.size() == direct.main().labels.size();
    EXPECT_EQ(compared, session.compares()) << name;
  };
  session.perform(Action::PLAY); // begins with frame 1
  session.advance(10.0);
  expectDirectLook();
  Parameters changed = session.parameters();
  changed.min_inliers = 3000;
  session.setParameters(changed); // frame 2 was begun without
  session.advance(10.0);
  expectDirectLook();
  session.perform(Action::COMPARE); // so was frame 3
  session.advance(10.0);
  expectDirectLook();
  session.perform(Action::PREVIOUS_FRAME); // where frame 0 was begun
  session.perform(Action::PREVIOUS_FRAME);
  expectDirectLook();
  EXPECT_EQ(session.frameIndex(), 1u);
}

TEST_F(Model, BadParametersAreRefused)
{
  Session session = open({room("room.pcd")});
  const std::size_t planes = session.main().planes.size();
  Parameters bad = session.parameters();
  bad.min_inliers = -1;
  session.setParameters(bad);
  EXPECT_NE(session.message().find("min_inliers"), std::string::npos);
  EXPECT_EQ(session.parameters().min_inliers, 0);
  EXPECT_EQ(session.main().planes.size(), planes);
}

TEST_F(Model, ContoursRunAlongTheirPlane)
{
  Session session = open({room("room.pcd")});
  std::set<std::uint16_t> labels;
  for (const LabelContour& contour : contoursOf(session.frame(), session.main())) {
    labels.insert(contour.label);
    for (const int i : contour.points)
      EXPECT_EQ(session.main().labels[static_cast<std::size_t>(i)], contour.label);
  }
  EXPECT_EQ(labels.size(), session.main().planes.size());
}

} // namespace

} // namespace pcl_mrf_planes::test
