// SPDX-License-Identifier: BSD-3-Clause
/** \file A session's frames in the course of time. */
#include "session.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double FASTEST = 60.0; // frames a second
constexpr double SLOWEST = 0.25;

} // namespace

bool Session::performSequence(Action action)
{
  switch (action) {
  case Action::PLAY:
    playing_ = !playing_ && (frames_.size() > 1 || settings.film);
    waited_ = 0.0;
    if (playing_ && !settings.film)
      lookAhead((index_ + 1) % frames_.size());
    if (!playing_ && frames_.size() == 1 && !settings.film)
      message_ = "there is one frame only; open a folder to play";
    return true;
  case Action::NEXT_FRAME:
    step(1);
    return true;
  case Action::PREVIOUS_FRAME:
    step(-1);
    return true;
  case Action::FASTER:
    speed_ = std::min(FASTEST, speed_ * 2.0);
    return true;
  case Action::SLOWER:
    speed_ = std::max(SLOWEST, speed_ / 2.0);
    return true;
  case Action::LOOP:
    loop_ = !loop_;
    return true;
  default:
    return false;
  }
}

bool Session::advance(double seconds)
{
  if (!playing_)
    return false;
  waited_ += seconds;
  const double period = 1.0 / speed_;
  if (waited_ < period)
    return false;
  // Frames that could not be shown in time are not caught up with.
  waited_ = std::min(waited_ - period, period);
  if (settings.film) {
    const int count = static_cast<int>(film_.steps.size());
    playing_ = loop_ || settings.film_step + 1 < count;
    if (playing_ && count > 0)
      settings.film_step = (settings.film_step + 1) % count;
    return true;
  }
  if (!loop_ && index_ + 1 == frames_.size()) {
    playing_ = false;
    return true;
  }
  step(1);
  return true;
}

void Session::step(int by)
{
  const auto count = static_cast<long>(frames_.size());
  const long wanted = static_cast<long>(index_) + by;
  if (!loop_ && (wanted < 0 || wanted >= count))
    return;
  const auto next = static_cast<std::size_t>((wanted + count) % count);
  if (next != index_ && !showFrame(next))
    index_ = next; // a broken frame is passed over, and does not stop the others
}

bool Session::showFrame(std::size_t index)
{
  const std::size_t count = frames_.size();
  const bool back = count > 2 && (index + 1) % count == index_;
  const bool shown = loadFrame(index);
  lookAhead((index + (back ? count - 1 : 1)) % count);
  return shown;
}

void Session::lookAhead(std::size_t index)
{
  if (index == index_ || ahead_.isFor(index))
    return;
  // Copies: the session may move and change meanwhile.
  ahead_.begin(index, [source = frames_.at(index), wanted = choice()] {
    return segmentFrame(source, wanted);
  });
}

bool Session::loadFrame(std::size_t index)
{
  try {
    SegmentedFrame loaded =
        ahead_.isFor(index) ? ahead_.take() : segmentFrame(frames_.at(index), choice());
    frame_ = std::move(loaded.frame);
    main_ = std::move(loaded.main);
    other_ = std::move(loaded.other);
    index_ = index;
    forgetPlanes();
    colour();
    return true;
  }
  catch (const std::exception& error) {
    message_ = error.what();
    return false;
  }
}

} // namespace pcl_mrf_planes::viewer
