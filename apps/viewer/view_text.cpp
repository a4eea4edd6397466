// SPDX-License-Identifier: BSD-3-Clause
#include "view_text.h"

#include <iomanip>
#include <sstream>

namespace pcl_mrf_planes::viewer {

namespace {

void describe(std::ostream& out, const SegmentedView& view)
{
  out << view.method << ": " << view.planes.size() << " planes, " << std::fixed
      << std::setprecision(1) << view.totalMs() << " ms\n";
}

void describe(std::ostream& out, const PlaneDeviations& deviations)
{
  constexpr double DEGREES = 57.29577951308232; // a radian
  out << "one standard deviation: normal " << DEGREES * deviations.normal
      << " degrees, d " << 1000.0 * deviations.offset << " mm\n";
}

} // namespace

std::string factsText(const Session& session)
{
  std::ostringstream out;
  out << session.frame().name;
  if (session.frameCount() > 1) {
    out << "   frame " << session.frameIndex() + 1 << " of " << session.frameCount();
    out << (session.playing() ? ", playing " : ", paused, ") << session.speed()
        << " frames/s" << (session.loops() ? ", loop" : "");
  }
  out << '\n';
  if (const FilmStep* step = session.filmStep()) {
    out << session.main().method << ", step " << session.settings.film_step + 1
        << " of " << session.film().steps.size() << ": " << step->title << '\n'
        << step->note << '\n';
    return out.str();
  }
  describe(out, session.main());
  out << std::fixed << std::setprecision(1);
  for (const auto& stage : session.main().stage_ms)
    out << "  " << stage.first << ' ' << stage.second << '\n';
  return out.str();
}

std::string comparisonText(const Session& session)
{
  std::ostringstream out;
  describe(out, session.other());
  return out.str();
}

std::string selectionText(const Session& session)
{
  const ViewSettings& settings = session.settings;
  const SegmentedView& view = session.main();
  std::ostringstream out;
  out << std::fixed << std::setprecision(3);
  const bool picked = settings.picked_point >= 0;
  const auto point = static_cast<std::size_t>(picked ? settings.picked_point : 0);
  if (picked)
    out << "point " << point << ": depth " << session.frame().points.depth(point)
        << " m\n";
  if (settings.selected == 0 || settings.selected > view.planes.size())
    return picked ? out.str() + "on no plane\n" : std::string();
  const ViewPlane& plane = view.planes[settings.selected - 1u];
  out << "plane " << settings.selected << ": a b c d = " << plane.normal.x() << ' '
      << plane.normal.y() << ' ' << plane.normal.z() << ' ' << plane.d << '\n'
      << plane.points << " points, " << plane.area << " m2, rms " << 1000.0 * plane.rms
      << " mm\n";
  if (view.deviations)
    describe(out, view.deviations().at(settings.selected - 1u));
  if (picked) {
    out << "distance " << 1000.0 * distanceToPlane(session.frame(), view, point)
        << " mm";
    if (view.confidence)
      out << ", confidence " << view.confidence().at(point);
    out << '\n';
  }
  return out.str();
}

std::string stateLine(const Session& session)
{
  std::ostringstream out;
  out << "frame " << session.frameIndex() + 1 << '/' << session.frameCount() << ' '
      << session.main().method << " planes " << session.main().planes.size() << " mode "
      << static_cast<int>(session.settings.mode) << " selected "
      << session.settings.selected << " hidden " << session.settings.hidden.size()
      << " film " << (session.settings.film ? session.settings.film_step : -1)
      << " playing " << session.playing();
  if (!session.message().empty())
    out << " message " << session.message();
  return out.str();
}

} // namespace pcl_mrf_planes::viewer
