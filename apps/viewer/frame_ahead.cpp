// SPDX-License-Identifier: BSD-3-Clause
#include "frame_ahead.h"

#include "peer_segmentation.h"

#include <utility>

namespace pcl_mrf_planes::viewer {

namespace {

std::string nameOf(Profile profile)
{
  return "profile " + profileName(profile);
}

Profile profileOf(Comparison comparison)
{
  return comparison == Comparison::PAPER  ? Profile::PAPER
         : comparison == Comparison::FAST ? Profile::FAST
                                          : Profile::DEFAULT;
}

} // namespace

std::string profileName(Profile profile)
{
  return profile == Profile::PAPER  ? "paper"
         : profile == Profile::FAST ? "fast"
                                    : "default";
}

SegmentedView segmentMain(const ViewFrame& frame, const Choice& choice)
{
  return segmentView(frame, choice.parameters, nameOf(choice.profile));
}

SegmentedView segmentOther(const ViewFrame& frame, Comparison comparison)
{
  if (comparison == Comparison::OFF)
    return {};
  if (comparison == Comparison::PCL)
    return segmentByPcl(frame);
  const Profile profile = profileOf(comparison);
  return segmentView(frame, Parameters::fromProfile(profile), nameOf(profile));
}

SegmentedFrame segmentFrame(const io::FrameSource& source, const Choice& choice)
{
  SegmentedFrame result;
  result.frame = readFrame(source);
  result.main = segmentMain(result.frame, choice);
  result.other = segmentOther(result.frame, choice.comparison);
  return result;
}

void FrameAhead::begin(std::size_t index, Work work)
{
  index_ = index;
  work_ = std::async(std::launch::async, std::move(work));
}

void FrameAhead::forget()
{
  work_ = {};
}

} // namespace pcl_mrf_planes::viewer
